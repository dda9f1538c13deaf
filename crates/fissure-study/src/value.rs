//! One value of one parameter.

use std::fmt;

use serde::{Serialize, Serializer};

/// A parameter's value, typed when it enters the program.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A finite real number, in the parameter's unit.
    Number(f64),
    /// A whole number.
    Count(u64),
    /// One of a fixed list of names.
    Choice(String),
}

impl Value {
    /// What kind of value this is, for error messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "number",
            Self::Count(_) => "count",
            Self::Choice(_) => "choice",
        }
    }
}

impl fmt::Display for Value {
    /// Writes the shortest text that reads back as the same value, so the text of
    /// two values is equal exactly when the values are.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => {
                let size = number.abs();
                if size == 0.0 || (1e-4..1e6).contains(&size) {
                    write!(formatter, "{number}")
                } else {
                    write!(formatter, "{number:e}")
                }
            }
            Self::Count(count) => write!(formatter, "{count}"),
            Self::Choice(name) => formatter.write_str(name),
        }
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => serializer.serialize_f64(*number),
            Self::Count(count) => serializer.serialize_u64(*count),
            Self::Choice(name) => serializer.serialize_str(name),
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Value {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<&str> for Value {
    fn from(name: &str) -> Self {
        Self::Choice(name.to_owned())
    }
}

/// Writes values as the comma list that `--set` reads.
pub(crate) fn comma_list(values: &[Value]) -> String {
    let texts: Vec<String> = values.iter().map(Value::to_string).collect();
    texts.join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_print_short_and_read_back() {
        for (number, text) in [
            (0.0025, "0.0025"),
            (0.0, "0"),
            (-45.0, "-45"),
            (2.1e11, "2.1e11"),
            (1e-7, "1e-7"),
        ] {
            assert_eq!(Value::Number(number).to_string(), text);
            assert_eq!(text.parse::<f64>().unwrap(), number);
        }
    }
}
