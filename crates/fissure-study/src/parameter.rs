//! The declaration of one parameter of a study.

use crate::parameter_error::ParameterError;
use crate::permitted::Permitted;
use crate::value::Value;

/// A parameter that a study declares and `--set` can override.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// The name `--set` uses.
    pub name: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// The unit of its values; `1` for a pure number, empty for a choice.
    pub unit: &'static str,
    /// The values run when nothing sets it; several values are a sweep.
    pub default: Vec<Value>,
    /// The values it accepts.
    pub permitted: Permitted,
    /// Whether asking for values of it chooses among the default cases, instead of changing them all.
    pub selects: bool,
}

impl Parameter {
    /// Declares a real number with one default value.
    pub fn number(
        name: &'static str,
        meaning: &'static str,
        unit: &'static str,
        default: f64,
        permitted: Permitted,
    ) -> Self {
        Self {
            name,
            meaning,
            unit,
            default: vec![Value::Number(default)],
            permitted,
            selects: false,
        }
    }

    /// Declares a whole number with one default value.
    pub fn count(
        name: &'static str,
        meaning: &'static str,
        default: u64,
        permitted: Permitted,
    ) -> Self {
        Self {
            name,
            meaning,
            unit: "1",
            default: vec![Value::Count(default)],
            permitted,
            selects: false,
        }
    }

    /// Declares a choice among names with one default.
    pub fn choice(
        name: &'static str,
        meaning: &'static str,
        default: &'static str,
        names: &'static [&'static str],
    ) -> Self {
        Self {
            name,
            meaning,
            unit: "",
            default: vec![Value::from(default)],
            permitted: Permitted::OneOf(names),
            selects: false,
        }
    }

    /// Replaces the default by a sweep over several values.
    #[must_use]
    pub fn sweep<V: Into<Value>>(mut self, values: impl IntoIterator<Item = V>) -> Self {
        self.default = values.into_iter().map(Into::into).collect();
        self
    }

    /// Makes it the name of a default case: who asks for some of its values gets the default cases of those values, each with
    /// what else it sets, and for a value without a default case the parameters' defaults.
    #[must_use]
    pub fn selecting(mut self) -> Self {
        self.selects = true;
        self
    }

    /// Checks values that the study itself supplies.
    pub(crate) fn check(&self, values: &[Value]) -> Result<(), ParameterError> {
        if values.is_empty() {
            return Err(ParameterError::NoValues(self.name.to_owned()));
        }
        values
            .iter()
            .try_for_each(|value| self.permitted.check(self.name, value))
    }
}
