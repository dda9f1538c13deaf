//! The command line: which study to run, on what, and how to report it.

use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;

use clap::{CommandFactory, Parser};

use crate::combinations::combinations;
use crate::command_error::CommandError;
use crate::form::Form;
use crate::listing::{parameter_list, study_list};
use crate::nearest::suggestion;
use crate::overrides::Overrides;
use crate::report::{Delivery, Report, ReportError};
use crate::study::{Study, StudyError};

/// Numerical experiments on the failure of materials.
///
/// Each study is one experiment with its own parameters. Units are SI, angles are in
/// degrees. A study reports one row per combination of its parameters' values.
#[derive(Debug, Parser)]
#[command(
    name = "fissure-studies",
    version,
    override_usage = "fissure-studies [--list] [STUDY] [--params] [--set NAME=VALUE]... \
                      [--json] [--out DIR] [--quick | --full]"
)]
struct CommandLine {
    /// The study to run
    study: Option<String>,
    /// List the studies
    #[arg(long, conflicts_with = "study")]
    list: bool,
    /// Print the study's parameters with units, defaults and permitted values
    #[arg(long, requires = "study")]
    params: bool,
    /// Override a parameter; a comma list runs every combination
    #[arg(long, value_name = "NAME=VALUE", requires = "study")]
    set: Vec<String>,
    /// Print one JSON object per result row on standard output and nothing else there
    #[arg(long)]
    json: bool,
    /// Write the rows, and the study's pictures and tables, to this directory
    #[arg(long, value_name = "DIR", requires = "study")]
    out: Option<PathBuf>,
    /// Run a small form of the study
    #[arg(long, requires = "study")]
    quick: bool,
    /// Run the study in full, which may take days; few studies have such a form
    #[arg(long, requires = "study", conflicts_with = "quick")]
    full: bool,
}

impl CommandLine {
    fn form(&self) -> Form {
        match (self.quick, self.full) {
            (true, _) => Form::Quick,
            (_, true) => Form::Full,
            _ => Form::Standard,
        }
    }
}

/// Obeys a command line and returns the exit code: 0, 1 for a failed study, 2 for bad
/// input.
///
/// Results go to `output`; progress and errors, the latter with what caused them, go to
/// `messages`.
pub fn execute<I, T>(
    studies: &[Box<dyn Study>],
    arguments: I,
    output: &mut (dyn Write + Send),
    messages: &mut (dyn Write + Send),
) -> u8
where
    I: IntoIterator<Item = T>,
    T: Into<OsString> + Clone,
{
    let command_line = match CommandLine::try_parse_from(arguments) {
        Ok(command_line) => command_line,
        Err(error) => {
            // Help and version come as errors too; nothing is left to do if the text
            // cannot be written.
            let text = error.render().to_string();
            let _ = if error.use_stderr() {
                messages.write_all(text.as_bytes())
            } else {
                output.write_all(text.as_bytes())
            };
            return u8::try_from(error.exit_code()).unwrap_or(2);
        }
    };
    match obey(studies, &command_line, output, messages) {
        Ok(()) => 0,
        // A reader such as `head` that has seen enough is not a failure.
        Err(error) if error.is_reader_gone() => 0,
        Err(error) => {
            let _ = error.write_chain(messages);
            error.exit_code()
        }
    }
}

fn obey(
    studies: &[Box<dyn Study>],
    command_line: &CommandLine,
    output: &mut (dyn Write + Send),
    messages: &mut (dyn Write + Send),
) -> Result<(), CommandError> {
    let Some(name) = &command_line.study else {
        let list = study_list(studies, command_line.json).map_err(ReportError::Json)?;
        let usage = if command_line.list || command_line.json {
            String::new()
        } else {
            format!("\n{}\n", CommandLine::command().render_usage())
        };
        write!(output, "{list}{usage}").map_err(ReportError::Output)?;
        return Ok(());
    };
    let study = find(studies, name)?;
    let settings = Overrides::from_settings(name, &study.parameters(), &command_line.set)?;
    let failed = |source| CommandError::Study {
        name: study.name(),
        source: Box::new(source),
    };
    if command_line.params {
        let list = parameter_list(study, command_line.json, command_line.form()).map_err(failed)?;
        output
            .write_all(list.as_bytes())
            .map_err(ReportError::Output)?;
        return Ok(());
    }
    let delivery = Delivery {
        json: command_line.json,
        out: command_line.out.clone(),
        form: command_line.form(),
    };
    run(study, &settings, &delivery, output, messages).map_err(failed)
}

fn run(
    study: &dyn Study,
    settings: &Overrides,
    delivery: &Delivery,
    output: &mut (dyn Write + Send),
    messages: &mut (dyn Write + Send),
) -> Result<(), StudyError> {
    let cases = combinations(study, settings, delivery.form)?;
    let mut report = Report::new(&cases, delivery, output, messages)?;
    if !delivery.json {
        report.note(&format!("{}: {}\n", study.name(), study.about()))?;
    }
    let outcome = study.run(&cases, &mut report);
    // The rows of a study that failed half-way are results too.
    let finished = report.finish();
    outcome?;
    Ok(finished?)
}

fn find<'a>(studies: &'a [Box<dyn Study>], name: &str) -> Result<&'a dyn Study, CommandError> {
    let names = || studies.iter().map(|study| study.name());
    studies
        .iter()
        .find(|study| study.name() == name)
        .map(AsRef::as_ref)
        .ok_or_else(|| CommandError::UnknownStudy {
            name: name.to_owned(),
            suggestion: suggestion(name, names()),
            known: if studies.is_empty() {
                "none yet".to_owned()
            } else {
                names().collect::<Vec<_>>().join(", ")
            },
        })
}
