//! Names and units of columns.

use super::TableError;

/// A checked header.
#[derive(Debug, Clone)]
pub(super) struct Header {
    columns: Vec<Column>,
}

#[derive(Debug, Clone)]
struct Column {
    /// As in the file: `delta [m]`.
    label: String,
    name: String,
    unit: Option<String>,
}

impl Header {
    pub fn new<L: AsRef<str>>(labels: impl IntoIterator<Item = L>) -> Result<Self, TableError> {
        let mut columns: Vec<Column> = Vec::new();
        for label in labels {
            let column = Column::parse(label.as_ref());
            if column.name.is_empty() {
                return Err(TableError::Unnamed {
                    column: columns.len() + 1,
                });
            }
            if columns.iter().any(|earlier| earlier.name == column.name) {
                return Err(TableError::Duplicate {
                    column: column.name,
                });
            }
            columns.push(column);
        }
        match columns.is_empty() {
            true => Err(TableError::Unnamed { column: 1 }),
            false => Ok(Self { columns }),
        }
    }

    pub fn width(&self) -> usize {
        self.columns.len()
    }

    pub fn labels(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|column| column.label.as_str())
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|column| column.name.as_str())
    }

    /// The column of a name; with its unit, `delta [m]`, the unit has to be the file's.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.columns
            .iter()
            .position(|column| column.name == name || column.label == name)
    }

    pub fn unit(&self, index: usize) -> Option<&str> {
        self.columns.get(index)?.unit.as_deref()
    }
}

impl Column {
    fn parse(label: &str) -> Self {
        let label = label.trim();
        let parts = label
            .strip_suffix(']')
            .and_then(|rest| rest.rsplit_once('['));
        let (name, unit) = match parts {
            Some((name, unit)) => (name.trim_end(), Some(unit.trim().to_owned())),
            None => (label, None),
        };
        Self {
            label: label.to_owned(),
            name: name.to_owned(),
            unit,
        }
    }
}
