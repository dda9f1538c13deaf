//! A table in memory: results to write in one piece, reference data to read.

use std::fs;
use std::path::{Path, PathBuf};

use super::header::Header;
use super::writer::csv_writer;
use super::{Cell, TableError};
use crate::FileError;
use crate::file::{self, Survive};

/// Rows under named columns.
///
/// ```
/// # fn main() -> Result<(), fissure_io::table::TableError> {
/// use fissure_io::table::Table;
///
/// let reference = Table::parse("Petersson 1981", "# digitised from figure 5.4\ndelta [m],force [N]\n1e-5, 310\n2e-5, 540\n")?;
/// assert_eq!(reference.numbers("delta")?, [1e-5, 2e-5]);
/// assert_eq!(reference.unit("force")?, Some("N"));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct Table {
    /// The file it was read from or the label it was given, for messages.
    label: PathBuf,
    header: Header,
    rows: Vec<Row>,
}

#[derive(Debug, Clone)]
struct Row {
    /// Line in the file, from 1.
    line: u64,
    cells: Vec<Cell>,
}

impl Table {
    /// An empty table with the columns' labels, units in brackets: `["delta [m]", "law"]`.
    ///
    /// # Errors
    /// [`TableError::Unnamed`] or [`TableError::Duplicate`].
    pub fn new(columns: &[&str]) -> Result<Self, TableError> {
        Ok(Self {
            label: PathBuf::from("table"),
            header: Header::new(columns)?,
            rows: Vec::new(),
        })
    }

    /// A table of numbers, column by column: what a history keeps. The columns are pairs of a label, with the unit in
    /// brackets, and numbers.
    ///
    /// ```
    /// # fn main() -> Result<(), fissure_io::table::TableError> {
    /// use fissure_io::table::Table;
    ///
    /// let (time, force) = ([1e-6, 2e-6], [120.0, 235.5]);
    /// let table = Table::from_columns([("time [s]", &time), ("force [N]", &force)])?;
    /// assert_eq!((table.len(), table.numbers("force")?), (2, force.to_vec()));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`TableError::Unnamed`], [`TableError::Duplicate`], and [`TableError::Length`] if a column is not as long as the
    /// first.
    pub fn from_columns<L: AsRef<str>, V: AsRef<[f64]>>(
        columns: impl IntoIterator<Item = (L, V)>,
    ) -> Result<Self, TableError> {
        let (labels, columns): (Vec<L>, Vec<V>) = columns.into_iter().unzip();
        let header = Header::new(&labels)?;
        let length = columns.first().map_or(0, |column| column.as_ref().len());
        for (name, column) in header.names().zip(&columns) {
            if column.as_ref().len() != length {
                return Err(TableError::Length {
                    column: name.to_owned(),
                    found: column.as_ref().len(),
                    expected: length,
                });
            }
        }
        let cell = |i: usize| move |column: &V| Cell::Number(column.as_ref()[i]);
        let row = |i: usize| Row {
            line: i as u64 + 2,
            cells: columns.iter().map(cell(i)).collect(),
        };
        Ok(Self {
            label: PathBuf::from("table"),
            header,
            rows: (0..length).map(row).collect(),
        })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`TableError::Width`] if it has not one cell per column.
    pub fn row<C: Into<Cell>>(
        &mut self,
        cells: impl IntoIterator<Item = C>,
    ) -> Result<&mut Self, TableError> {
        let cells: Vec<Cell> = cells.into_iter().map(Into::into).collect();
        if cells.len() != self.header.width() {
            return Err(TableError::Width {
                found: cells.len(),
                expected: self.header.width(),
            });
        }
        let line = self.rows.last().map_or(1, |row| row.line) + 1;
        self.rows.push(Row { line, cells });
        Ok(self)
    }

    /// Writes the table as CSV, replacing a file that is there in one piece. The folder must exist.
    ///
    /// # Errors
    /// [`TableError::File`] if the operating system refuses.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), TableError> {
        file::replace(path.as_ref(), Survive::Process, |out| {
            let mut csv = csv_writer(out);
            csv.write_record(self.header.labels())?;
            for row in &self.rows {
                csv.write_record(row.cells.iter().map(|cell| cell.field().into_owned()))?;
            }
            csv.flush()
        })?;
        Ok(())
    }

    /// Reads a CSV file with one header line. Lines that begin with `#` are skipped; all else waits as text until it is
    /// asked for as numbers.
    ///
    /// # Errors
    /// [`TableError::File`] if it cannot be read, [`TableError::Csv`] for ragged rows, [`TableError::Unnamed`] and
    /// [`TableError::Duplicate`] for the header.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, TableError> {
        let path = path.as_ref();
        let bytes = fs::read(path).map_err(FileError::on("read", path))?;
        Self::from_bytes(path, &bytes)
    }

    /// Reads CSV from text, for instance from `include_str!`; messages call it by the label.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(label: &str, text: &str) -> Result<Self, TableError> {
        Self::from_bytes(Path::new(label), text.as_bytes())
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The columns' names, without units.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.header.names()
    }

    /// The unit a column's header states. A column may be asked for by name, `delta`, or by label, `delta [m]`.
    ///
    /// # Errors
    /// [`TableError::Missing`].
    pub fn unit(&self, column: &str) -> Result<Option<&str>, TableError> {
        Ok(self.header.unit(self.find(column)?))
    }

    /// A column as numbers, in the unit of its header.
    ///
    /// # Errors
    /// [`TableError::Missing`], or [`TableError::NotANumber`] for the first cell that is none, an empty one included.
    pub fn numbers(&self, column: &str) -> Result<Vec<f64>, TableError> {
        let index = self.find(column)?;
        let number = |row: &Row| {
            row.cells[index]
                .number()
                .ok_or_else(|| TableError::NotANumber {
                    path: self.label.clone(),
                    line: row.line,
                    column: column.to_owned(),
                    found: row.cells[index].field().into_owned(),
                })
        };
        self.rows.iter().map(number).collect()
    }

    /// A column as text; numbers as they would be written.
    ///
    /// # Errors
    /// [`TableError::Missing`].
    pub fn texts(&self, column: &str) -> Result<Vec<String>, TableError> {
        let index = self.find(column)?;
        Ok(self
            .rows
            .iter()
            .map(|row| row.cells[index].field().into_owned())
            .collect())
    }

    fn from_bytes(label: &Path, bytes: &[u8]) -> Result<Self, TableError> {
        let spoilt = |source| TableError::Csv {
            path: label.to_owned(),
            source,
        };
        let mut csv = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(bytes);
        let header = Header::new(csv.headers().map_err(spoilt)?)?;
        let mut rows = Vec::new();
        for record in csv.records() {
            let record = record.map_err(spoilt)?;
            let line = record.position().map_or(0, csv::Position::line);
            rows.push(Row {
                line,
                cells: record.iter().map(Cell::from).collect(),
            });
        }
        Ok(Self {
            label: label.to_owned(),
            header,
            rows,
        })
    }

    fn find(&self, column: &str) -> Result<usize, TableError> {
        self.header.find(column).ok_or_else(|| TableError::Missing {
            path: self.label.clone(),
            column: column.to_owned(),
            present: self.names().map(str::to_owned).collect(),
        })
    }
}
