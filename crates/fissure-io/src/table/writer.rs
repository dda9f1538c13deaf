//! A table written row by row while a simulation runs.

use std::fs::File;
use std::path::{Path, PathBuf};

use super::header::Header;
use super::{Cell, TableError};
use crate::FileError;

/// Streams rows to a CSV file. Rows wait in a buffer until [`flush`](Self::flush), [`finish`](Self::finish) or until it is
/// full; what was flushed survives the end of the process.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("curve.csv");
/// use fissure_io::table::{Table, TableWriter};
///
/// let mut curve = TableWriter::create(&path, &["delta [m]", "force [N]"])?;
/// curve.row([1e-6, 120.0])?;
/// curve.row([2e-6, 235.5])?;
/// curve.finish()?;
///
/// assert_eq!(Table::read(&path)?.numbers("force")?, [120.0, 235.5]);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct TableWriter {
    path: PathBuf,
    header: Header,
    out: csv::Writer<File>,
}

impl TableWriter {
    /// Creates or empties the file and writes the header. The folder must exist.
    ///
    /// # Errors
    /// [`TableError::Unnamed`] or [`TableError::Duplicate`] for the columns, [`TableError::File`] if the operating system
    /// refuses.
    pub fn create(path: impl AsRef<Path>, columns: &[&str]) -> Result<Self, TableError> {
        let path = path.as_ref().to_owned();
        let header = Header::new(columns)?;
        let file = File::create(&path).map_err(FileError::on("create", &path))?;
        let mut out = csv_writer(file);
        out.write_record(header.labels()).map_err(refused(&path))?;
        Ok(Self { path, header, out })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`TableError::Width`] if it has not one cell per column, [`TableError::File`] if the operating system refuses.
    pub fn row<C: Into<Cell>>(
        &mut self,
        cells: impl IntoIterator<Item = C>,
    ) -> Result<(), TableError> {
        let cells: Vec<Cell> = cells.into_iter().map(Into::into).collect();
        if cells.len() != self.header.width() {
            return Err(TableError::Width {
                found: cells.len(),
                expected: self.header.width(),
            });
        }
        self.out
            .write_record(cells.iter().map(|cell| cell.field().into_owned()))
            .map_err(refused(&self.path))
    }

    /// Hands what is buffered to the operating system, so that others can read it.
    ///
    /// # Errors
    /// [`TableError::File`] if the operating system refuses.
    pub fn flush(&mut self) -> Result<(), TableError> {
        Ok(self
            .out
            .flush()
            .map_err(FileError::on("write", &self.path))?)
    }

    /// Flushes and closes. Dropping does so too but cannot report a full disk.
    ///
    /// # Errors
    /// [`TableError::File`] if the operating system refuses.
    pub fn finish(mut self) -> Result<(), TableError> {
        self.flush()
    }
}

/// The one dialect of this crate; a cell that could be mistaken for a comment is quoted.
pub(super) fn csv_writer<W: std::io::Write>(out: W) -> csv::Writer<W> {
    csv::WriterBuilder::new()
        .comment(Some(b'#'))
        .from_writer(out)
}

/// The csv crate's error on writing: nearly always the operating system's inside.
fn refused(path: &Path) -> impl Fn(csv::Error) -> TableError {
    move |error| match error.is_io_error() {
        true => FileError::on("write", path)(error.into()).into(),
        false => TableError::Csv {
            path: path.to_owned(),
            source: error,
        },
    }
}
