//! The parameters of laws: declared once, set on the command line, with a default per law.

use std::ops::Bound;

use super::registry::{Entry, LAWS};
use fissure_study::{Parameter, Parameters, Permitted, StudyError, Value};

/// What a parameter is set to where the law's own default holds.
pub const OWN: &str = "own";

/// A value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// A number, in the parameter's unit.
    Number(f64),
    /// One of the permitted names.
    Choice(&'static str),
}

/// A parameter of a law.
#[derive(Clone, Debug, PartialEq)]
pub struct LawParameter {
    /// The name that `--set` uses; laws that share it share meaning and unit.
    pub name: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// The unit; `1` for a pure number, empty for a choice.
    pub unit: &'static str,
    /// The law's own value.
    pub default: Setting,
    /// What may be asked for; the law's `check` has the last word.
    pub permitted: Permitted,
}

/// What a parameter is set to for which no value is published: there is no default.
pub const NONE: &str = "none";

/// Any number.
const ANY: Permitted = Permitted::Numbers(Bound::Unbounded, Bound::Unbounded);

/// Numbers above zero.
pub const POSITIVE: Permitted = Permitted::Numbers(Bound::Excluded(0.0), Bound::Unbounded);

impl LawParameter {
    /// A number above zero.
    pub const fn positive(
        name: &'static str,
        meaning: &'static str,
        unit: &'static str,
        default: f64,
    ) -> Self {
        Self {
            name,
            meaning,
            unit,
            default: Setting::Number(default),
            permitted: POSITIVE,
        }
    }

    /// A number of zero or more.
    pub const fn not_negative(
        name: &'static str,
        meaning: &'static str,
        unit: &'static str,
        default: f64,
    ) -> Self {
        Self {
            permitted: Permitted::Numbers(Bound::Included(0.0), Bound::Unbounded),
            ..Self::positive(name, meaning, unit, default)
        }
    }

    /// Any number.
    pub const fn number(
        name: &'static str,
        meaning: &'static str,
        unit: &'static str,
        default: f64,
    ) -> Self {
        Self {
            permitted: ANY,
            ..Self::positive(name, meaning, unit, default)
        }
    }

    /// A number without a published value, and so without a default: it has to be given where it is used.
    pub const fn unpublished(
        name: &'static str,
        meaning: &'static str,
        unit: &'static str,
    ) -> Self {
        Self {
            name,
            meaning,
            unit,
            default: Setting::Choice(NONE),
            permitted: Permitted::WordOr(NONE, &ANY),
        }
    }

    /// One of some names.
    pub const fn choice(
        name: &'static str,
        meaning: &'static str,
        default: &'static str,
        names: &'static [&'static str],
    ) -> Self {
        Self {
            name,
            meaning,
            unit: "",
            default: Setting::Choice(default),
            permitted: Permitted::OneOf(names),
        }
    }
}

/// Mass density.
pub const fn density(default: f64) -> LawParameter {
    LawParameter::positive("density", "mass density", "kg/m3", default)
}

/// Young's modulus.
pub const fn young(default: f64) -> LawParameter {
    LawParameter::positive("young", "Young's modulus", "Pa", default)
}

/// Poisson's ratio.
pub const fn poisson(default: f64) -> LawParameter {
    LawParameter {
        name: "poisson",
        meaning: "Poisson's ratio",
        unit: "1",
        default: Setting::Number(default),
        permitted: Permitted::Numbers(Bound::Excluded(-1.0), Bound::Excluded(0.5)),
    }
}

/// Tensile strength.
pub const fn strength(default: f64) -> LawParameter {
    LawParameter::positive("strength", "tensile strength", "Pa", default)
}

/// Fracture energy in opening.
pub const fn toughness(default: f64) -> LawParameter {
    LawParameter::positive("toughness", "fracture energy in opening", "J/m2", default)
}

/// The values of one law's parameters.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a> {
    entry: &'static Entry,
    set: Option<&'a Parameters>,
}

impl Values<'static> {
    /// The law's own values.
    pub fn own(entry: &'static Entry) -> Self {
        Self { entry, set: None }
    }
}

impl<'a> Values<'a> {
    /// Those of a case, with the law's own where the case has none.
    ///
    /// # Errors
    /// The case sets a parameter that the law does not have.
    pub fn of(entry: &'static Entry, case: &'a Parameters) -> Result<Self, StudyError> {
        let known = |name: &str| entry.parameters.iter().any(|p| p.name == name);
        let own = Value::from(OWN);
        for parameter in all() {
            let set = case.get(parameter.name).is_some_and(|value| *value != own);
            if set && !known(parameter.name) {
                let names: Vec<_> = entry.parameters.iter().map(|p| p.name).collect();
                let reason = format!("this law's parameters are {}", names.join(", "));
                let concerned = ["law", parameter.name];
                return Err(StudyError::combination(case, &concerned, reason));
            }
        }
        Ok(Self {
            entry,
            set: Some(case),
        })
    }

    /// A number; NaN, which every law refuses, if the law does not declare it as one.
    pub fn number(&self, name: &str) -> f64 {
        match (self.set.and_then(|set| set.get(name)), self.default(name)) {
            (Some(Value::Number(number)), _) => *number,
            (_, Some(Setting::Number(number))) => number,
            _ => f64::NAN,
        }
    }

    /// A choice; empty if the law does not declare it as one.
    pub fn choice(&self, name: &str) -> &str {
        match (self.set.and_then(|set| set.get(name)), self.default(name)) {
            (Some(Value::Choice(choice)), _) if choice != OWN => choice,
            (_, Some(Setting::Choice(choice))) => choice,
            _ => "",
        }
    }

    /// Every parameter with its value and unit, as text.
    pub fn told(&self) -> String {
        let told = self.entry.parameters.iter().map(|parameter| {
            let number = self.number(parameter.name);
            let value = match parameter.default {
                Setting::Choice(_) if number.is_nan() => Value::from(self.choice(parameter.name)),
                _ => Value::Number(number),
            };
            let unit = match parameter.unit {
                "" | "1" => String::new(),
                unit => format!(" {unit}"),
            };
            format!("{} = {value}{unit}", parameter.name)
        });
        told.collect::<Vec<_>>().join(", ")
    }

    fn default(&self, name: &str) -> Option<Setting> {
        let mut parameters = self.entry.parameters.iter();
        parameters.find(|p| p.name == name).map(|p| p.default)
    }
}

/// Every parameter that some law has, each name once.
fn all() -> Vec<&'static LawParameter> {
    let mut all: Vec<&LawParameter> = Vec::new();
    for parameter in LAWS.iter().flat_map(|entry| entry.parameters) {
        if all.iter().all(|known| known.name != parameter.name) {
            all.push(parameter);
        }
    }
    all
}

/// The parameters of every law as those of a study: each stays the law's own unless it is set.
pub fn study_parameters() -> Vec<Parameter> {
    let declared = all().into_iter().map(|parameter| Parameter {
        name: parameter.name,
        meaning: parameter.meaning,
        unit: parameter.unit,
        default: vec![Value::from(OWN)],
        permitted: Permitted::WordOr(OWN, &parameter.permitted),
        selects: false,
    });
    declared.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_that_share_a_name_share_its_meaning() {
        let shared = all();
        for parameter in LAWS.iter().flat_map(|entry| entry.parameters) {
            let first = shared.iter().find(|p| p.name == parameter.name).unwrap();
            assert_eq!(
                (parameter.meaning, parameter.unit, &parameter.permitted),
                (first.meaning, first.unit, &first.permitted)
            );
            let own = match parameter.default {
                Setting::Number(number) => Value::Number(number),
                Setting::Choice(choice) => Value::from(choice),
            };
            assert!(parameter.permitted.check(parameter.name, &own).is_ok());
        }
    }
}
