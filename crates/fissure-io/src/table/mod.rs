//! Tables of numbers and words as CSV, with units in the header: `delta [m],force [N],law`.
//!
//! Numbers are written in the shortest form that reads back as the same `f64`. Lines that begin with `#` are comments when
//! reading, so reference data can say where it comes from.

mod cell;
mod header;
mod whole;
mod writer;

use std::path::PathBuf;

pub use cell::Cell;
pub use whole::Table;
pub use writer::TableWriter;

use crate::FileError;

/// Why a table could not be written, read or asked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The operating system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is no CSV: a row with more or fewer fields than the header, or bytes that are not UTF-8.
    #[error("'{}' is not a table", path.display())]
    Csv {
        /// The file, or the label the text was given.
        path: PathBuf,
        /// What the csv crate says, with the line.
        #[source]
        source: csv::Error,
    },
    /// A header without columns, or a column without a name.
    #[error("column {column} of a table has no name")]
    Unnamed {
        /// Number of the column, from 1.
        column: usize,
    },
    /// Two columns have one name; it would be unclear which is meant.
    #[error("two columns of a table are named '{column}'")]
    Duplicate {
        /// The name, without the unit.
        column: String,
    },
    /// A row has not one cell per column.
    #[error("a row of {found} cells for {expected} columns")]
    Width {
        /// Cells of the row.
        found: usize,
        /// Columns of the table.
        expected: usize,
    },
    /// Columns that are to be a table have not the same length.
    #[error("column '{column}' has {found} rows, the first has {expected}")]
    Length {
        /// The column's name.
        column: String,
        /// Rows it has.
        found: usize,
        /// Rows the first column has.
        expected: usize,
    },
    /// There is no column of that name.
    #[error("'{}' has no column '{column}'; it has {}", path.display(), present.join(", "))]
    Missing {
        /// The file, or the label the text was given.
        path: PathBuf,
        /// The name asked for.
        column: String,
        /// The names there are.
        present: Vec<String>,
    },
    /// A cell that was to be a number is none.
    #[error("'{}', line {line}, column '{column}': {found:?} is not a number", path.display())]
    NotANumber {
        /// The file, or the label the text was given.
        path: PathBuf,
        /// Line in the file, from 1.
        line: u64,
        /// The column's name.
        column: String,
        /// What is there.
        found: String,
    },
}
