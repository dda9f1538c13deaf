//! From default cases and the user's settings to the combinations that are run.

use std::collections::HashSet;

use crate::overrides::Overrides;
use crate::parameter::Parameter;
use crate::parameter_error::ParameterError;
use crate::parameters::Parameters;
use crate::study::{Study, StudyError};
use crate::value::Value;

/// The combinations a study runs, in order and without duplicates.
///
/// What the user sets replaces the values in every default case; what is left of the
/// case is kept. So one setting narrows or widens one parameter and leaves the rest of
/// the default run as it is, and the cases that thereby become equal are run once.
///
/// # Errors
///
/// The study's own definition is inconsistent; the settings are taken as checked.
pub fn combinations(
    study: &dyn Study,
    settings: &Overrides,
    quick: bool,
) -> Result<Vec<Parameters>, StudyError> {
    let parameters = study.parameters();
    check_declarations(&parameters).map_err(StudyError::Definition)?;
    let mut seen = HashSet::new();
    let mut combinations = Vec::new();
    for case in study.default_cases(settings, quick) {
        case.check(study.name(), &parameters)
            .map_err(StudyError::Definition)?;
        for combination in product(&parameters, &case, settings) {
            if seen.insert(combination.to_string()) {
                combinations.push(combination);
            }
        }
    }
    let varying = varying_names(&combinations);
    for combination in &mut combinations {
        combination.set_varying(&varying);
    }
    Ok(combinations)
}

fn check_declarations(parameters: &[Parameter]) -> Result<(), ParameterError> {
    let mut names = HashSet::new();
    for parameter in parameters {
        parameter.check(&parameter.default)?;
        if !names.insert(parameter.name) {
            return Err(ParameterError::DeclaredTwice(parameter.name.to_owned()));
        }
    }
    Ok(())
}

/// Every combination of one case; the parameter declared last changes fastest.
fn product(parameters: &[Parameter], case: &Overrides, settings: &Overrides) -> Vec<Parameters> {
    let mut partial: Vec<Vec<(&'static str, Value)>> = vec![Vec::new()];
    for parameter in parameters {
        let values = settings
            .get(parameter.name)
            .or_else(|| case.get(parameter.name))
            .unwrap_or(&parameter.default);
        partial = partial
            .into_iter()
            .flat_map(|chosen| {
                values.iter().map(move |value| {
                    let mut extended = chosen.clone();
                    extended.push((parameter.name, value.clone()));
                    extended
                })
            })
            .collect();
    }
    partial.into_iter().map(Parameters::new).collect()
}

fn varying_names(combinations: &[Parameters]) -> Vec<&'static str> {
    let Some(first) = combinations.first() else {
        return Vec::new();
    };
    first
        .iter()
        .filter(|(name, value)| {
            combinations
                .iter()
                .any(|other| other.get(name) != Some(*value))
        })
        .map(|(name, _)| name)
        .collect()
}
