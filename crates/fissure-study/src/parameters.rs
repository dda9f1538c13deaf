//! The value of every parameter in one run of a study.

use std::fmt;

use crate::parameter_error::ParameterError;
use crate::value::Value;

/// One combination: a value for every parameter of the study.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameters {
    values: Vec<(&'static str, Value)>,
    varying: Vec<&'static str>,
}

impl Parameters {
    pub(crate) fn new(values: Vec<(&'static str, Value)>) -> Self {
        Self {
            values,
            varying: Vec::new(),
        }
    }

    pub(crate) fn set_varying(&mut self, varying: &[&'static str]) {
        self.varying = varying.to_vec();
    }

    /// The value of a parameter that the study declared as a number.
    ///
    /// # Errors
    ///
    /// The study does not declare it, or not as a number.
    pub fn number(&self, name: &str) -> Result<f64, ParameterError> {
        match self.value(name)? {
            Value::Number(number) => Ok(*number),
            other => Err(wrong_kind(name, other, "number")),
        }
    }

    /// The value of a parameter that the study declared as a count.
    ///
    /// # Errors
    ///
    /// The study does not declare it, or not as a count.
    pub fn count(&self, name: &str) -> Result<u64, ParameterError> {
        match self.value(name)? {
            Value::Count(count) => Ok(*count),
            other => Err(wrong_kind(name, other, "count")),
        }
    }

    /// A count as a length or an index.
    ///
    /// # Errors
    ///
    /// As [`count`](Self::count), or the count does not fit this machine's addresses.
    pub fn size(&self, name: &str) -> Result<usize, ParameterError> {
        let count = self.count(name)?;
        usize::try_from(count).map_err(|_| ParameterError::OutOfRange {
            name: name.to_owned(),
            value: count.to_string(),
            permitted: format!("[0, {}]", usize::MAX),
        })
    }

    /// The value of a parameter that the study declared as a choice.
    ///
    /// # Errors
    ///
    /// The study does not declare it, or not as a choice.
    pub fn choice(&self, name: &str) -> Result<&str, ParameterError> {
        match self.value(name)? {
            Value::Choice(choice) => Ok(choice),
            other => Err(wrong_kind(name, other, "choice")),
        }
    }

    /// The value of any declared parameter.
    ///
    /// # Errors
    ///
    /// The study does not declare it.
    pub fn value(&self, name: &str) -> Result<&Value, ParameterError> {
        self.get(name)
            .ok_or_else(|| ParameterError::NotDeclared(name.to_owned()))
    }

    /// The value of a parameter, or nothing where the study has no such parameter.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.values
            .iter()
            .find(|(known, _)| *known == name)
            .map(|(_, value)| value)
    }

    /// Every parameter with its value, in the order of declaration.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &Value)> {
        self.values.iter().map(|(name, value)| (*name, value))
    }

    /// The names of the parameters that differ between the combinations of this run.
    pub fn varying(&self) -> &[&'static str] {
        &self.varying
    }

    /// What sets this combination apart from the others of the run, such as
    /// `h=0.01 solver=explicit`; `default` where nothing does.
    pub fn label(&self) -> String {
        self.label_without(&[])
    }

    /// As [`label`](Self::label), leaving out parameters that are told elsewhere.
    pub fn label_without(&self, told: &[&str]) -> String {
        let parts: Vec<String> = self
            .iter()
            .filter(|(name, _)| self.varying.contains(name) && !told.contains(name))
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        if parts.is_empty() {
            "default".to_owned()
        } else {
            parts.join(" ")
        }
    }
}

impl fmt::Display for Parameters {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, (name, value)) in self.iter().enumerate() {
            let separator = if position == 0 { "" } else { " " };
            write!(formatter, "{separator}{name}={value}")?;
        }
        Ok(())
    }
}

fn wrong_kind(name: &str, value: &Value, used: &'static str) -> ParameterError {
    ParameterError::WrongKind {
        name: name.to_owned(),
        declared: value.kind(),
        used,
    }
}
