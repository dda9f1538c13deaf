//! Values that replace parameters' defaults, from a study or from `--set`.

use crate::nearest::suggestion;
use crate::parameter::Parameter;
use crate::parameter_error::ParameterError;
use crate::value::Value;

/// Lists of values by parameter name; a list of several values is a sweep.
///
/// A study's default cases are such sets, and so are the user's settings.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Overrides {
    entries: Vec<(String, Vec<Value>)>,
}

impl Overrides {
    /// Overrides nothing: every parameter keeps its default.
    // Compilers before 1.97 may take two of these that are moved for one, and free it twice (rust-lang/rust#155241). The
    // result of a call they tell apart.
    #[inline(never)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Gives the parameter `name` one value.
    #[must_use]
    pub fn set(self, name: &str, value: impl Into<Value>) -> Self {
        self.sweep(name, [value])
    }

    /// Gives the parameter `name` several values.
    #[must_use]
    pub fn sweep<V: Into<Value>>(
        mut self,
        name: &str,
        values: impl IntoIterator<Item = V>,
    ) -> Self {
        self.entries.retain(|(known, _)| known != name);
        let values = values.into_iter().map(Into::into).collect();
        self.entries.push((name.to_owned(), values));
        self
    }

    /// The values given for the parameter `name`.
    pub fn get(&self, name: &str) -> Option<&[Value]> {
        self.entries
            .iter()
            .find(|(known, _)| known == name)
            .map(|(_, values)| values.as_slice())
    }

    /// Every name with its values, in the order given.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[Value])> {
        self.entries
            .iter()
            .map(|(name, values)| (name.as_str(), values.as_slice()))
    }

    /// Reads the `name=value,value,...` settings of a command line.
    ///
    /// # Errors
    ///
    /// A setting that is malformed, unknown, given twice or not permitted.
    pub fn from_settings(
        study: &str,
        parameters: &[Parameter],
        settings: &[String],
    ) -> Result<Self, ParameterError> {
        let mut overrides = Self::new();
        for setting in settings {
            let (name, list) = match setting.split_once('=') {
                Some((name, list)) if !name.trim().is_empty() => (name.trim(), list),
                _ => return Err(ParameterError::Malformed(setting.clone())),
            };
            let parameter = find(study, parameters, name)?;
            if overrides.get(name).is_some() {
                return Err(ParameterError::SetTwice(name.to_owned()));
            }
            let values = list
                .split(',')
                .map(|text| parameter.permitted.parse(name, text.trim()))
                .collect::<Result<Vec<Value>, ParameterError>>()?;
            overrides.entries.push((name.to_owned(), values));
        }
        Ok(overrides)
    }

    /// Checks that a study's own overrides are of declared parameters and permitted.
    pub(crate) fn check(
        &self,
        study: &str,
        parameters: &[Parameter],
    ) -> Result<(), ParameterError> {
        self.iter()
            .try_for_each(|(name, values)| find(study, parameters, name)?.check(values))
    }
}

fn find<'a>(
    study: &str,
    parameters: &'a [Parameter],
    name: &str,
) -> Result<&'a Parameter, ParameterError> {
    let names = || parameters.iter().map(|parameter| parameter.name);
    parameters
        .iter()
        .find(|parameter| parameter.name == name)
        .ok_or_else(|| ParameterError::Unknown {
            study: study.to_owned(),
            name: name.to_owned(),
            suggestion: suggestion(name, names()),
            permitted: names().collect::<Vec<_>>().join(", "),
        })
}
