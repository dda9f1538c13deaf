//! One result row: named fields in a fixed order.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::parameters::Parameters;
use crate::value::Value;

/// The value of one field of a row.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Field {
    /// A real number; one that is not finite becomes `null` in JSON.
    Number(f64),
    /// A whole number.
    Count(u64),
    /// A word or a sentence.
    Text(String),
    /// Yes or no.
    Flag(bool),
    /// A list of real numbers.
    Numbers(Vec<f64>),
    /// Points of a curve.
    Pairs(Vec<[f64; 2]>),
    /// Named fields inside this one.
    Group(Fields),
}

/// Named fields in the order in which they were added.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fields {
    entries: Vec<(String, Field)>,
}

impl Fields {
    /// No fields.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a field, or replaces the one of that name where it stands.
    pub fn insert(&mut self, name: impl Into<String>, field: impl Into<Field>) {
        let (name, field) = (name.into(), field.into());
        match self.entries.iter_mut().find(|(known, _)| *known == name) {
            Some((_, value)) => *value = field,
            None => self.entries.push((name, field)),
        }
    }

    /// Adds a field and returns the fields, for writing them in one expression.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, field: impl Into<Field>) -> Self {
        self.insert(name, field);
        self
    }

    /// The field of that name.
    pub fn get(&self, name: &str) -> Option<&Field> {
        self.iter()
            .find(|(known, _)| *known == name)
            .map(|(_, field)| field)
    }

    /// Every name with its field, in order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Field)> {
        self.entries
            .iter()
            .map(|(name, field)| (name.as_str(), field))
    }
}

/// One result row of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Row {
    fields: Fields,
}

impl Row {
    /// A row that carries the study's name and whatever fields are added.
    ///
    /// A simulation's row is a [`SimulationRow`](crate::SimulationRow) instead.
    pub fn other(study: &str) -> Self {
        Self {
            fields: Fields::new().with("study", study),
        }
    }

    /// Adds a field.
    #[must_use]
    pub fn field(mut self, name: impl Into<String>, field: impl Into<Field>) -> Self {
        self.fields.insert(name, field);
        self
    }

    /// Adds the value of every parameter as the group `parameters`.
    ///
    /// The table shows only those of them that vary and that are no column already.
    #[must_use]
    pub fn parameters(self, parameters: &Parameters) -> Self {
        self.field("parameters", Field::from(parameters))
    }

    /// The fields of the row.
    pub fn fields(&self) -> &Fields {
        &self.fields
    }
}

impl Serialize for Fields {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.entries.len()))?;
        for (name, field) in self.iter() {
            map.serialize_entry(name, field)?;
        }
        map.end()
    }
}

impl From<f64> for Field {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Field {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<u32> for Field {
    fn from(count: u32) -> Self {
        Self::Count(u64::from(count))
    }
}

impl From<usize> for Field {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<bool> for Field {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl From<&str> for Field {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Field {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<Vec<f64>> for Field {
    fn from(numbers: Vec<f64>) -> Self {
        Self::Numbers(numbers)
    }
}

impl From<Vec<[f64; 2]>> for Field {
    fn from(pairs: Vec<[f64; 2]>) -> Self {
        Self::Pairs(pairs)
    }
}

impl From<Fields> for Field {
    fn from(fields: Fields) -> Self {
        Self::Group(fields)
    }
}

impl From<&Value> for Field {
    fn from(value: &Value) -> Self {
        match value {
            Value::Number(number) => Self::Number(*number),
            Value::Count(count) => Self::Count(*count),
            Value::Choice(name) => Self::Text(name.clone()),
        }
    }
}

impl From<&Parameters> for Field {
    fn from(parameters: &Parameters) -> Self {
        let mut fields = Fields::new();
        for (name, value) in parameters.iter() {
            fields.insert(name, value);
        }
        Self::Group(fields)
    }
}
