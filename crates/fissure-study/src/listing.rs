//! What `--list` and `--params` print.

use serde::Serialize;

use crate::combinations::combinations;
use crate::overrides::Overrides;
use crate::parameter::Parameter;
use crate::parameters::Parameters;
use crate::permitted::Permitted;
use crate::report::ReportError;
use crate::study::{Study, StudyError};
use crate::value::{Value, comma_list};

#[derive(Serialize)]
struct StudyLine<'a> {
    study: &'a str,
    about: &'a str,
}

#[derive(Serialize)]
#[serde(untagged)]
enum OneOrMore<'a> {
    One(&'a Value),
    More(&'a [Value]),
}

#[derive(Serialize)]
#[serde(untagged)]
enum PermittedForm {
    Names(&'static [&'static str]),
    Interval(String),
}

#[derive(Serialize)]
struct ParameterLine<'a> {
    name: &'a str,
    meaning: &'a str,
    unit: &'a str,
    default: OneOrMore<'a>,
    permitted: PermittedForm,
}

/// The studies with what each is about.
pub(crate) fn study_list(
    studies: &[Box<dyn Study>],
    json: bool,
) -> Result<String, serde_json::Error> {
    let mut text = String::new();
    let width = studies.iter().map(|study| study.name().len()).max();
    for study in studies {
        let (name, about) = (study.name(), study.about());
        if json {
            text.push_str(&serde_json::to_string(&StudyLine { study: name, about })?);
            text.push('\n');
        } else {
            let width = width.unwrap_or_default();
            text.push_str(&format!("{name:<width$}  {about}\n"));
        }
    }
    Ok(text)
}

/// A study's parameters with units, defaults and permitted values.
///
/// The default of a parameter is shown as every value it takes when nothing is set,
/// which the default cases of the study decide.
pub(crate) fn parameter_list(
    study: &dyn Study,
    json: bool,
    quick: bool,
) -> Result<String, StudyError> {
    let cases = combinations(study, &Overrides::new(), quick)?;
    let parameters = study.parameters();
    let defaults: Vec<Vec<Value>> = parameters
        .iter()
        .map(|parameter| values_run(parameter, &cases))
        .collect();
    if json {
        let mut text = String::new();
        for (parameter, default) in parameters.iter().zip(&defaults) {
            let line = ParameterLine::new(parameter, default);
            text.push_str(&serde_json::to_string(&line).map_err(ReportError::Json)?);
            text.push('\n');
        }
        return Ok(text);
    }
    let mut lines =
        vec![["parameter", "unit", "default", "permitted", "meaning"].map(String::from)];
    for (parameter, default) in parameters.iter().zip(&defaults) {
        let unit = if parameter.unit.is_empty() {
            "-"
        } else {
            parameter.unit
        };
        lines.push([
            parameter.name.to_owned(),
            unit.to_owned(),
            comma_list(default),
            parameter.permitted.to_string(),
            parameter.meaning.to_owned(),
        ]);
    }
    let plural = if cases.len() == 1 { "" } else { "s" };
    let form = if quick {
        "the quick run"
    } else {
        "the default run"
    };
    Ok(format!(
        "{}: {}\n\n{}\n{form} has {} combination{plural}\n",
        study.name(),
        study.about(),
        aligned(&lines),
        cases.len(),
    ))
}

impl<'a> ParameterLine<'a> {
    fn new(parameter: &'a Parameter, default: &'a [Value]) -> Self {
        Self {
            name: parameter.name,
            meaning: parameter.meaning,
            unit: parameter.unit,
            default: match default {
                [one] => OneOrMore::One(one),
                more => OneOrMore::More(more),
            },
            permitted: match &parameter.permitted {
                Permitted::OneOf(names) => PermittedForm::Names(names),
                interval => PermittedForm::Interval(interval.to_string()),
            },
        }
    }
}

/// The distinct values a parameter takes, in the order in which they come.
fn values_run(parameter: &Parameter, cases: &[Parameters]) -> Vec<Value> {
    let mut values: Vec<Value> = Vec::new();
    for value in cases.iter().filter_map(|case| case.get(parameter.name)) {
        if !values.contains(value) {
            values.push(value.clone());
        }
    }
    values
}

fn aligned<const COLUMNS: usize>(lines: &[[String; COLUMNS]]) -> String {
    let mut widths = [0; COLUMNS];
    for line in lines {
        for (width, text) in widths.iter_mut().zip(line) {
            *width = text.chars().count().max(*width);
        }
    }
    let mut table = String::new();
    for line in lines {
        let padded: Vec<String> = line
            .iter()
            .zip(widths)
            .map(|(text, width)| format!("{text:<width$}"))
            .collect();
        table.push_str(padded.join("  ").trim_end());
        table.push('\n');
    }
    table
}
