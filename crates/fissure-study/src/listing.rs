//! What `--list` and `--params` print.

use serde::Serialize;

use crate::combinations::combinations;
use crate::form::Form;
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
    form: Form,
) -> Result<String, StudyError> {
    let cases = combinations(study, &Overrides::new(), form)?;
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
            match parameter.selects {
                true => format!("{}; chooses among the default cases", parameter.meaning),
                false => parameter.meaning.to_owned(),
            },
        ]);
    }
    let plural = if cases.len() == 1 { "" } else { "s" };
    Ok(format!(
        "{}: {}\n\n{}\nthe {} run has {} combination{plural}\n",
        study.name(),
        study.about(),
        aligned(&lines),
        form.word(),
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

/// Widest a column gets before its cells go over several lines.
const WIDEST: usize = 40;

/// A table with the columns below one another; long cells go on in the lines below.
fn aligned<const COLUMNS: usize>(rows: &[[String; COLUMNS]]) -> String {
    let rows: Vec<[Vec<String>; COLUMNS]> = rows
        .iter()
        .map(|row| row.each_ref().map(|cell| broken(cell)))
        .collect();
    let mut widths = [0; COLUMNS];
    for row in &rows {
        for (width, lines) in widths.iter_mut().zip(row) {
            let widest = lines.iter().map(|line| line.chars().count()).max();
            *width = widest.unwrap_or_default().max(*width);
        }
    }
    let mut table = String::new();
    for row in &rows {
        let height = row.iter().map(Vec::len).max().unwrap_or_default();
        for line in 0..height {
            let cells = row.iter().zip(widths).map(|(lines, width)| {
                let text = lines.get(line).map_or("", String::as_str);
                format!("{text:<width$}")
            });
            table.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
            table.push('\n');
        }
    }
    table
}

/// A cell in lines that break after a comma or a blank where they would be too wide.
fn broken(cell: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in cell.split_inclusive([' ', ',']) {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].chars().count() + word.chars().count() > WIDEST {
            lines.push(String::new());
        }
        let last = lines.len() - 1;
        lines[last].push_str(word);
    }
    lines.iter().map(|line| line.trim().to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_cells_go_on_below_and_columns_stay_aligned() {
        let names = [
            "isotropic",
            "hencky",
            "neo-hookean",
            "orthotropic",
            "viscous-damage",
        ];
        let rows = [
            ["parameter", "permitted", "meaning"].map(String::from),
            ["law".into(), names.join(", "), "constitutive law".into()],
        ];
        let table = aligned(&rows);
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(lines.len(), 3);
        assert!(
            lines
                .iter()
                .all(|line| line.len() <= 9 + 2 + WIDEST + 2 + 16)
        );
        assert_eq!(lines[1].find("constitutive"), lines[0].find("meaning"));
        assert_eq!(lines[2].trim(), "orthotropic, viscous-damage");
        assert_eq!(lines[2].find("orthotropic"), lines[0].find("permitted"));
    }
}
