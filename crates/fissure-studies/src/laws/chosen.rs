//! Which law a case asks for.

use fissure_laws::{Entry, Law, NAMES, OWN, Space, Values, entry, study_parameters};
use fissure_study::{Parameter, ParameterError, Parameters, StudyError, Value};

/// The parameters that say which law: its name, where it is used, and its own parameters.
pub fn parameters(default: &'static str) -> Vec<Parameter> {
    let mut parameters = vec![
        Parameter::choice("law", "constitutive law", default, NAMES),
        Parameter::choice(
            "space",
            "three dimensions (and plane strain), or plane stress",
            Space::NAMES[0],
            Space::NAMES,
        ),
    ];
    parameters.extend(study_parameters());
    parameters
}

/// The law of a case.
pub struct Chosen<'a> {
    /// Where it is listed.
    pub entry: &'static Entry,
    /// Where it is used.
    pub space: Space,
    /// Its parameters.
    pub values: Values<'a>,
    /// The law.
    pub law: Box<dyn Law>,
}

impl<'a> Chosen<'a> {
    /// The law that a case asks for.
    ///
    /// # Errors
    /// A parameter that the law does not have or refuses.
    pub fn of(case: &'a Parameters) -> Result<Self, StudyError> {
        let name = case.choice("law")?;
        let Some(entry) = entry(name) else {
            let reason = "there is no such law";
            return Err(StudyError::combination(case, &["law"], reason));
        };
        let values = Values::of(entry, case)?;
        let space = Space::of(case.choice("space")?);
        if !entry.is_for(space) {
            let reason = "this law is not offered in plane stress";
            return Err(StudyError::combination(case, &["law", "space"], reason));
        }
        let law = (entry.build)(&values, space);
        law.check()
            .map_err(|error| StudyError::combination(case, &["law", "space"], error.to_string()))?;
        Ok(Self {
            entry,
            space,
            values,
            law,
        })
    }

    /// Name of the law, and the space if it is not the whole.
    pub fn name(&self) -> String {
        match self.space {
            Space::Solid => self.entry.name.to_owned(),
            Space::PlaneStress => format!("{}-plane-stress", self.entry.name),
        }
    }
}

/// Without the cases of a sweep that ask for a law where it is not offered. A single case stays, and
/// is refused.
///
/// # Errors
/// The study does not declare law and space.
pub fn offered(cases: &[Parameters]) -> Result<Vec<&Parameters>, ParameterError> {
    let mut offered = Vec::new();
    for case in cases {
        let space = Space::of(case.choice("space")?);
        let known = entry(case.choice("law")?);
        if cases.len() == 1 || known.is_none_or(|entry| entry.is_for(space)) {
            offered.push(case);
        }
    }
    Ok(offered)
}

/// A number of a case, or `own` where the case leaves it to the law.
///
/// # Errors
/// The study does not declare it as a number or that word.
pub fn number_or(case: &Parameters, name: &str, own: f64) -> Result<f64, ParameterError> {
    match case.value(name)? {
        Value::Choice(word) if word == OWN => Ok(own),
        _ => case.number(name),
    }
}
