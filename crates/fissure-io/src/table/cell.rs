//! One field of a table.

use std::borrow::Cow;

/// A number or a word. Both convert by themselves: `writer.row([1.0, 2.0])`, `writer.row(["linear".into(), 0.5.into()])`.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// A number in the column's unit.
    Number(f64),
    /// Anything else.
    Text(String),
}

impl Cell {
    /// The field as written. Rust prints the shortest digits that read back as the same number; only very large and very
    /// small ones need the exponent form to stay short.
    pub(super) fn field(&self) -> Cow<'_, str> {
        let value = match self {
            Self::Text(text) => return Cow::Borrowed(text),
            Self::Number(value) => value,
        };
        let size = value.abs();
        if *value == 0.0 || (1e-4..1e15).contains(&size) || !value.is_finite() {
            Cow::Owned(format!("{value}"))
        } else {
            Cow::Owned(format!("{value:e}"))
        }
    }

    /// The number, also where it is still the text that was read.
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(value) => Some(*value),
            Self::Text(text) => text.trim().parse().ok(),
        }
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<&f64> for Cell {
    fn from(value: &f64) -> Self {
        Self::Number(*value)
    }
}

impl From<u32> for Cell {
    fn from(value: u32) -> Self {
        Self::Number(value.into())
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_read_back_as_the_same_bits() {
        let written = |value: f64| Cell::Number(value).field().into_owned();
        assert_eq!(written(0.1 + 0.2), "0.30000000000000004");
        assert_eq!(written(2.9e-7), "2.9e-7");
        assert_eq!(written(24.9e9), "24900000000");
        assert_eq!(written(812.0), "812");
        let awkward = [
            -0.0,
            5e-324,
            f64::MAX,
            1.0 / 3.0,
            1e15,
            123_456.789e-9,
            f64::INFINITY,
            f64::NEG_INFINITY,
        ];
        for value in awkward {
            let back = Cell::Text(written(value)).number().unwrap();
            assert_eq!(back.to_bits(), value.to_bits(), "{value}");
        }
        assert!(Cell::Text(written(f64::NAN)).number().unwrap().is_nan());
    }
}
