//! Where a study's results go.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::form::Form;
use crate::parameters::Parameters;
use crate::row::Row;
use crate::row_files::RowFiles;
use crate::table::Table;

/// How a study's results are delivered.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Delivery {
    /// JSON rows instead of a table.
    pub json: bool,
    /// The directory for files; none are written without it.
    pub out: Option<PathBuf>,
    /// How large the run is.
    pub form: Form,
}

enum Layout {
    JsonLines,
    Table(Table),
}

/// Receives a study's rows and prints each as soon as it comes.
pub struct Report<'a> {
    output: &'a mut (dyn Write + Send),
    messages: &'a mut (dyn Write + Send),
    layout: Layout,
    files: Option<RowFiles>,
    quick: bool,
}

impl<'a> Report<'a> {
    /// A report on these cases: results to `output`, messages to `messages`.
    ///
    /// # Errors
    ///
    /// The directory for files cannot be used.
    pub fn new(
        cases: &[Parameters],
        delivery: &Delivery,
        output: &'a mut (dyn Write + Send),
        messages: &'a mut (dyn Write + Send),
    ) -> Result<Self, ReportError> {
        Ok(Self {
            output,
            messages,
            layout: if delivery.json {
                Layout::JsonLines
            } else {
                Layout::Table(Table::new(cases))
            },
            files: delivery.out.as_deref().map(RowFiles::create).transpose()?,
            quick: delivery.form == Form::Quick,
        })
    }

    /// Reports one result row.
    ///
    /// # Errors
    ///
    /// The row cannot be written.
    pub fn row(&mut self, row: impl Into<Row>) -> Result<(), ReportError> {
        let row = row.into();
        let json = serde_json::to_string(&row)?;
        let lines = match &mut self.layout {
            Layout::JsonLines => format!("{json}\n"),
            Layout::Table(table) => table.lines(&row),
        };
        // The file first: a reader that has gone away must not cost the recorded row.
        if let Some(files) = &mut self.files {
            files.row(&row, &json)?;
        }
        self.print(&lines)
    }

    /// Says something about the results that no row holds.
    ///
    /// It follows the table on standard output; with JSON rows it goes to standard
    /// error, because the rows are alone on standard output.
    ///
    /// # Errors
    ///
    /// It cannot be written.
    pub fn note(&mut self, text: &str) -> Result<(), ReportError> {
        match self.layout {
            Layout::JsonLines => {
                self.progress(text);
                Ok(())
            }
            Layout::Table(_) => self.print(&format!("{text}\n")),
        }
    }

    /// Says on standard error how far the study is.
    pub fn progress(&mut self, text: &str) {
        // A closed standard error is no reason to give up a computation.
        let _ = writeln!(self.messages, "{text}");
    }

    /// The directory for pictures and tables, if the user asked for files.
    pub fn out_dir(&self) -> Option<&Path> {
        self.files.as_ref().map(RowFiles::directory)
    }

    /// Whether the user asked for the small form.
    pub fn quick(&self) -> bool {
        self.quick
    }

    /// Completes the files.
    ///
    /// # Errors
    ///
    /// A file cannot be written.
    pub fn finish(self) -> Result<(), ReportError> {
        match &self.files {
            Some(files) => files.finish(),
            None => Ok(()),
        }
    }

    fn print(&mut self, text: &str) -> Result<(), ReportError> {
        self.output.write_all(text.as_bytes())?;
        self.output.flush()?;
        Ok(())
    }
}

/// A result could not be delivered.
#[derive(Debug, Error)]
pub enum ReportError {
    /// Standard output does not accept it.
    #[error("cannot write to standard output")]
    Output(#[from] io::Error),
    /// The row has no JSON form.
    #[error("cannot write a row as JSON")]
    Json(#[from] serde_json::Error),
    /// A file or directory does not accept it.
    #[error("cannot write {}", path.display())]
    File {
        /// The file or directory.
        path: PathBuf,
        /// What went wrong.
        source: io::Error,
    },
    /// A table does not accept it.
    #[error("cannot write {}", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        source: csv::Error,
    },
}

impl ReportError {
    /// Names the file in an input or output error; for use with `map_err`.
    pub fn file(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::File { path, source }
    }

    pub(crate) fn table(path: &Path) -> impl FnOnce(csv::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Table { path, source }
    }
}
