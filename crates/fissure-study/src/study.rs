//! What a study is.

use std::error::Error as StandardError;

use thiserror::Error;

use crate::overrides::Overrides;
use crate::parameter::Parameter;
use crate::parameter_error::ParameterError;
use crate::parameters::Parameters;
use crate::report::{Report, ReportError};

/// One sub-command: an experiment with declared parameters that reports rows.
pub trait Study: Sync {
    /// The name on the command line, in lower case with hyphens.
    fn name(&self) -> &'static str;

    /// What the study shows, in one line.
    fn about(&self) -> &'static str;

    /// The parameters; all of them can be overridden.
    fn parameters(&self) -> Vec<Parameter>;

    /// The sets of values to run when the user sets nothing.
    ///
    /// Each set is expanded to the product of its lists, with the parameters' defaults
    /// for what it leaves out; duplicates among the results are run once. A study whose
    /// default run is the plain product of its defaults returns one empty set. `quick`
    /// asks for a form small enough for a test. `settings` are the user's: a study whose
    /// sub-studies differ in their sweeps chooses by them; they replace values in any case.
    fn default_cases(&self, settings: &Overrides, quick: bool) -> Vec<Overrides>;

    /// As [`default_cases`](Self::default_cases), of a form that may take days; `None` if the default run is all there is.
    fn full_cases(&self, _settings: &Overrides) -> Option<Vec<Overrides>> {
        None
    }

    /// Runs every case and hands each result row to the report as soon as it is known.
    ///
    /// # Errors
    ///
    /// Whatever keeps the study from finishing.
    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError>;
}

/// Why a study did not finish.
#[derive(Debug, Error)]
pub enum StudyError {
    /// The study used a parameter other than it declared it.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The study's declared parameters or default cases contradict each other.
    #[error("the study's own definition is wrong")]
    Definition(#[source] ParameterError),
    /// Each value is permitted, but not together with the others.
    #[error("{combination}: {reason}")]
    Combination {
        /// The values concerned.
        combination: String,
        /// Why they do not go together.
        reason: String,
    },
    /// The full form of a study that has none was asked for.
    #[error("study '{0}' has no full form: its default run is all there is; --set refines it")]
    NoFullForm(&'static str),
    /// A row could not be reported.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A computation failed.
    #[error("{doing}")]
    Failed {
        /// What was being done.
        doing: String,
        /// What went wrong.
        source: Box<dyn StandardError + Send + Sync>,
    },
}

impl StudyError {
    /// Says what was being done when `source` stopped it; for use with `map_err`.
    pub fn failed<E>(doing: impl Into<String>) -> impl FnOnce(E) -> Self
    where
        E: Into<Box<dyn StandardError + Send + Sync>>,
    {
        let doing = doing.into();
        move |source| Self::Failed {
            doing,
            source: source.into(),
        }
    }

    /// Refuses a combination of values that are each permitted.
    pub fn combination(parameters: &Parameters, names: &[&str], reason: impl Into<String>) -> Self {
        let values: Vec<String> = parameters
            .iter()
            .filter(|(name, _)| names.contains(name))
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        Self::Combination {
            combination: values.join(" "),
            reason: reason.into(),
        }
    }

    /// Whether the user's values are at fault rather than the computation.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::Combination { .. } | Self::NoFullForm(_))
    }
}
