//! From default cases and the user's settings to the combinations that are run.

use std::collections::HashSet;

use crate::form::Form;
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
/// the default run as it is, and the cases that thereby become equal are run once. A parameter that
/// [`selects`](Parameter::selecting) narrows the cases instead: those of other values are left out.
///
/// # Errors
///
/// The study's own definition is inconsistent, or it has no full form; the settings are taken as checked.
pub fn combinations(
    study: &dyn Study,
    settings: &Overrides,
    form: Form,
) -> Result<Vec<Parameters>, StudyError> {
    let parameters = study.parameters();
    check_declarations(&parameters).map_err(StudyError::Definition)?;
    let mut seen = HashSet::new();
    let mut combinations = Vec::new();
    let mut cases = match form {
        Form::Full => study
            .full_cases(settings)
            .ok_or(StudyError::NoFullForm(study.name()))?,
        _ => study.default_cases(settings, form == Form::Quick),
    };
    for case in &cases {
        case.check(study.name(), &parameters)
            .map_err(StudyError::Definition)?;
    }
    cases.extend(cases_left(&parameters, &cases, settings));
    for case in &cases {
        for combination in product(&parameters, case, settings) {
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

/// Cases of nothing but those values of selecting parameters that are asked for and that no default case has.
fn cases_left(
    parameters: &[Parameter],
    cases: &[Overrides],
    settings: &Overrides,
) -> Vec<Overrides> {
    let selecting = parameters.iter().filter(|parameter| parameter.selects);
    let left = selecting.filter_map(|parameter| {
        let known: Vec<&Value> = cases
            .iter()
            .flat_map(|case| values(parameter, case, settings))
            .collect();
        let asked = settings.get(parameter.name)?.iter();
        let left: Vec<Value> = asked.filter(|v| !known.contains(v)).cloned().collect();
        (!left.is_empty()).then(|| Overrides::new().sweep(parameter.name, left))
    });
    left.collect()
}

/// The values of a parameter in a case: the user's, else the case's own, else the default ones; of a
/// parameter that selects, those of the case that the user asks for.
fn values<'a>(
    parameter: &'a Parameter,
    case: &'a Overrides,
    settings: &'a Overrides,
) -> Vec<&'a Value> {
    let own = case.get(parameter.name).unwrap_or(&parameter.default);
    match settings.get(parameter.name) {
        None => own.iter().collect(),
        Some(asked) if parameter.selects => own.iter().filter(|v| asked.contains(v)).collect(),
        Some(asked) => asked.iter().collect(),
    }
}

/// Every combination of one case; the parameter declared last changes fastest.
fn product(parameters: &[Parameter], case: &Overrides, settings: &Overrides) -> Vec<Parameters> {
    let mut partial: Vec<Vec<(&'static str, Value)>> = vec![Vec::new()];
    for parameter in parameters {
        let values = values(parameter, case, settings);
        partial = partial
            .into_iter()
            .flat_map(|chosen| {
                let extended = |value: &&Value| {
                    let mut extended = chosen.clone();
                    extended.push((parameter.name, (*value).clone()));
                    extended
                };
                values.iter().map(extended).collect::<Vec<_>>()
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
