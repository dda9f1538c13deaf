//! Why a command line led to nothing, and the exit code for it.

use std::error::Error as StandardError;
use std::io::{self, Write};

use thiserror::Error;

use crate::parameter_error::ParameterError;
use crate::report::ReportError;
use crate::study::StudyError;

/// The exit code of a study that did not finish.
const FAILED: u8 = 1;
/// The exit code of a command line that cannot be obeyed.
const BAD_INPUT: u8 = 2;

/// Why a command line led to nothing.
#[derive(Debug, Error)]
pub(crate) enum CommandError {
    #[error("there is no study '{name}'{suggestion}; the studies are: {known}")]
    UnknownStudy {
        name: String,
        suggestion: String,
        known: String,
    },
    #[error(transparent)]
    Setting(#[from] ParameterError),
    #[error("study '{name}' failed")]
    Study {
        name: &'static str,
        // Boxed because it is far larger than the other variants.
        source: Box<StudyError>,
    },
    #[error(transparent)]
    Report(#[from] ReportError),
}

impl CommandError {
    /// Tells bad input from a study that failed.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::UnknownStudy { .. } | Self::Setting(_) => BAD_INPUT,
            Self::Study { source, .. } if source.is_bad_input() => BAD_INPUT,
            Self::Study { .. } | Self::Report(_) => FAILED,
        }
    }

    /// Whether the reader of standard output closed it, as `head` does.
    pub(crate) fn is_reader_gone(&self) -> bool {
        let report = match self {
            Self::Report(report) => report,
            Self::Study { source, .. } => match source.as_ref() {
                StudyError::Report(report) => report,
                _ => return false,
            },
            _ => return false,
        };
        matches!(report, ReportError::Output(source) if source.kind() == io::ErrorKind::BrokenPipe)
    }

    /// Writes the error and what caused it, one line each.
    pub(crate) fn write_chain(&self, messages: &mut dyn Write) -> io::Result<()> {
        writeln!(messages, "error: {self}")?;
        let mut cause = self.source();
        while let Some(error) = cause {
            writeln!(messages, "  caused by: {error}")?;
            cause = error.source();
        }
        Ok(())
    }
}
