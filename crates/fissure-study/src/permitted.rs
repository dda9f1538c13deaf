//! The values a parameter accepts, and the reading of a value from text.

use std::fmt;
use std::ops::{Bound, RangeBounds};

use crate::nearest::suggestion;
use crate::parameter_error::ParameterError;
use crate::value::Value;

/// The values a parameter accepts; it also decides the kind of the values.
#[derive(Debug, Clone, PartialEq)]
pub enum Permitted {
    /// Finite real numbers between two bounds.
    Numbers(Bound<f64>, Bound<f64>),
    /// Whole numbers between two bounds.
    Counts(Bound<u64>, Bound<u64>),
    /// One of these names.
    OneOf(&'static [&'static str]),
    /// This word, or what else is permitted: for values that depend on another choice.
    WordOr(&'static str, &'static Permitted),
    /// Any text without a comma, such as the name of a file.
    Text,
}

impl Permitted {
    /// Real numbers in a range such as `0.0..=1.0` or `..`.
    pub fn numbers(range: impl RangeBounds<f64>) -> Self {
        Self::Numbers(range.start_bound().cloned(), range.end_bound().cloned())
    }

    /// Real numbers strictly above `bound`.
    pub fn above(bound: f64) -> Self {
        Self::Numbers(Bound::Excluded(bound), Bound::Unbounded)
    }

    /// Real numbers not below `bound`.
    pub fn at_least(bound: f64) -> Self {
        Self::Numbers(Bound::Included(bound), Bound::Unbounded)
    }

    /// Real numbers strictly between two bounds.
    pub fn between(lower: f64, upper: f64) -> Self {
        Self::Numbers(Bound::Excluded(lower), Bound::Excluded(upper))
    }

    /// Whole numbers in a range such as `1..` or `1..=64`.
    pub fn counts(range: impl RangeBounds<u64>) -> Self {
        Self::Counts(range.start_bound().cloned(), range.end_bound().cloned())
    }

    /// The kind of the values, for error messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Numbers(..) => "number",
            Self::Counts(..) => "count",
            Self::OneOf(_) => "choice",
            Self::WordOr(_, other) => other.kind(),
            Self::Text => "text",
        }
    }

    /// Reads one value of the parameter `name` from what the user typed.
    ///
    /// # Errors
    ///
    /// Names the parameter, the text and the permitted values when the text is not
    /// one of them.
    pub fn parse(&self, name: &str, text: &str) -> Result<Value, ParameterError> {
        let value = match self {
            Self::Numbers(..) => match text.parse::<f64>() {
                // Adding zero turns -0 into 0, which are one value but two texts.
                Ok(number) if number.is_finite() => Value::Number(number + 0.0),
                _ => return Err(self.unreadable(name, text, "a finite number")),
            },
            Self::Counts(..) => match text.parse::<u64>() {
                Ok(count) => Value::Count(count),
                Err(_) => return Err(self.unreadable(name, text, "a whole number")),
            },
            Self::WordOr(word, other) if text != *word => return other.parse(name, text),
            Self::OneOf(_) | Self::WordOr(..) | Self::Text => Value::Choice(text.to_owned()),
        };
        self.refuse_unless_permitted(name, &value, text)?;
        Ok(value)
    }

    /// Checks a value that a study itself supplies for the parameter `name`.
    ///
    /// # Errors
    ///
    /// Names the parameter, the value and the permitted values.
    pub fn check(&self, name: &str, value: &Value) -> Result<(), ParameterError> {
        self.refuse_unless_permitted(name, value, &value.to_string())
    }

    fn refuse_unless_permitted(
        &self,
        name: &str,
        value: &Value,
        text: &str,
    ) -> Result<(), ParameterError> {
        let within = match (self, value) {
            (Self::Numbers(lower, upper), Value::Number(number)) => {
                number.is_finite() && (*lower, *upper).contains(number)
            }
            (Self::Counts(lower, upper), Value::Count(count)) => (*lower, *upper).contains(count),
            (Self::OneOf(names), Value::Choice(choice)) => {
                if names.contains(&choice.as_str()) {
                    return Ok(());
                }
                return Err(ParameterError::NotAChoice {
                    name: name.to_owned(),
                    value: text.to_owned(),
                    suggestion: suggestion(text, names.iter().copied()),
                    permitted: self.to_string(),
                });
            }
            (Self::WordOr(word, _), Value::Choice(choice)) if choice == word => true,
            (Self::WordOr(_, other), _) => {
                return other.refuse_unless_permitted(name, value, text);
            }
            (Self::Text, Value::Choice(_)) => true,
            _ => {
                return Err(ParameterError::WrongKind {
                    name: name.to_owned(),
                    declared: self.kind(),
                    used: value.kind(),
                });
            }
        };
        if within {
            Ok(())
        } else {
            Err(ParameterError::OutOfRange {
                name: name.to_owned(),
                value: text.to_owned(),
                permitted: self.to_string(),
            })
        }
    }

    fn unreadable(&self, name: &str, text: &str, expected: &'static str) -> ParameterError {
        ParameterError::Unreadable {
            name: name.to_owned(),
            value: text.to_owned(),
            expected,
            permitted: self.to_string(),
        }
    }
}

impl fmt::Display for Permitted {
    /// An interval such as `(-1, 0.5)` or `[1, inf)`, or the list of names.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Numbers(lower, upper) => interval(
                formatter,
                &lower.map(Value::Number),
                &upper.map(Value::Number),
            ),
            Self::Counts(lower, upper) => interval(formatter, lower, upper),
            Self::OneOf(names) => formatter.write_str(&names.join(", ")),
            Self::WordOr(word, other) => write!(formatter, "{word}, {other}"),
            Self::Text => formatter.write_str("any text without a comma"),
        }
    }
}

fn interval<T: fmt::Display>(
    formatter: &mut fmt::Formatter<'_>,
    lower: &Bound<T>,
    upper: &Bound<T>,
) -> fmt::Result {
    match lower {
        Bound::Included(bound) => write!(formatter, "[{bound}, ")?,
        Bound::Excluded(bound) => write!(formatter, "({bound}, ")?,
        Bound::Unbounded => formatter.write_str("(-inf, ")?,
    }
    match upper {
        Bound::Included(bound) => write!(formatter, "{bound}]"),
        Bound::Excluded(bound) => write!(formatter, "{bound})"),
        Bound::Unbounded => formatter.write_str("inf)"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(permitted: &Permitted, name: &str, text: &str) -> String {
        permitted.parse(name, text).unwrap_err().to_string()
    }

    #[test]
    fn refusals_name_parameter_value_and_range() {
        let poisson = Permitted::between(-1.0, 0.5);
        assert_eq!(
            refusal(&poisson, "poisson", "0.6"),
            "parameter 'poisson': 0.6 is not in the permitted range (-1, 0.5)"
        );
        assert_eq!(
            refusal(&poisson, "poisson", "0.5"),
            "parameter 'poisson': 0.5 is not in the permitted range (-1, 0.5)"
        );
        for text in ["steel", "", "nan", "inf"] {
            assert_eq!(
                refusal(&poisson, "poisson", text),
                format!(
                    "parameter 'poisson': '{text}' is not a finite number; \
                     the permitted range is (-1, 0.5)"
                )
            );
        }
    }

    #[test]
    fn counts_and_choices() {
        let threads = Permitted::counts(1..=64);
        assert_eq!(threads.parse("threads", "2").unwrap(), Value::Count(2));
        assert_eq!(
            refusal(&threads, "threads", "0"),
            "parameter 'threads': 0 is not in the permitted range [1, 64]"
        );
        assert_eq!(
            refusal(&threads, "threads", "1.5"),
            "parameter 'threads': '1.5' is not a whole number; the permitted range is [1, 64]"
        );
        assert_eq!(
            refusal(
                &Permitted::OneOf(&["explicit", "implicit"]),
                "solver",
                "implict"
            ),
            "parameter 'solver': 'implict' is not one of explicit, implicit \
             (did you mean 'implicit'?)"
        );
    }

    #[test]
    fn intervals_show_which_ends_are_open() {
        assert_eq!(Permitted::above(0.0).to_string(), "(0, inf)");
        assert_eq!(Permitted::at_least(0.0).to_string(), "[0, inf)");
        assert_eq!(Permitted::numbers(0.0..=90.0).to_string(), "[0, 90]");
        assert_eq!(Permitted::numbers(..).to_string(), "(-inf, inf)");
        assert_eq!(Permitted::counts(1..).to_string(), "[1, inf)");
    }

    #[test]
    fn a_word_stands_beside_numbers() {
        const NUMBERS: Permitted = Permitted::Numbers(Bound::Excluded(0.0), Bound::Unbounded);
        let own = Permitted::WordOr("own", &NUMBERS);
        assert_eq!(own.parse("young", "own").unwrap(), Value::from("own"));
        assert_eq!(own.parse("young", "2e9").unwrap(), Value::Number(2e9));
        assert_eq!(own.to_string(), "own, (0, inf)");
        for text in ["-1", "owm"] {
            assert!(own.parse("young", text).is_err());
        }
        assert!(own.check("young", &Value::from("other")).is_err());
    }

    #[test]
    fn negative_zero_is_zero() {
        let any = Permitted::numbers(..);
        assert_eq!(any.parse("angle", "-0").unwrap().to_string(), "0");
    }
}
