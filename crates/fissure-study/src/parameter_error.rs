//! What can be wrong with a parameter's name or value.

use thiserror::Error;

/// A parameter's name or value was refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ParameterError {
    /// No parameter has that name.
    #[error("study '{study}' has no parameter '{name}'{suggestion}; permitted: {permitted}")]
    Unknown {
        /// The study asked.
        study: String,
        /// The name that was given.
        name: String,
        /// A clause that names the nearest parameter, or nothing.
        suggestion: String,
        /// The study's parameters.
        permitted: String,
    },
    /// The value is a number outside the permitted range.
    #[error("parameter '{name}': {value} is not in the permitted range {permitted}")]
    OutOfRange {
        /// The parameter.
        name: String,
        /// The value that was given.
        value: String,
        /// The permitted range.
        permitted: String,
    },
    /// The text cannot be read as a number of the parameter's kind.
    #[error("parameter '{name}': '{value}' is not {expected}; the permitted range is {permitted}")]
    Unreadable {
        /// The parameter.
        name: String,
        /// The text that was given.
        value: String,
        /// What it should have been.
        expected: &'static str,
        /// The permitted range.
        permitted: String,
    },
    /// The value is none of the names the parameter knows.
    #[error("parameter '{name}': '{value}' is not one of {permitted}{suggestion}")]
    NotAChoice {
        /// The parameter.
        name: String,
        /// The name that was given.
        value: String,
        /// A clause that names the nearest choice, or nothing.
        suggestion: String,
        /// The permitted names.
        permitted: String,
    },
    /// A setting without a name or without an equals sign.
    #[error("'--set {0}' is not of the form name=value or name=value,value,...")]
    Malformed(
        /// The setting as typed.
        String,
    ),
    /// Two settings of one parameter, which could mean either a list or a correction.
    #[error("parameter '{0}' is set twice; give several values as one list, {0}=first,second")]
    SetTwice(
        /// The parameter.
        String,
    ),
    /// A study's own mistake: it uses a parameter that it does not declare.
    #[error("parameter '{0}' is used but not declared")]
    NotDeclared(
        /// The parameter.
        String,
    ),
    /// A study's own mistake: it declares two parameters of one name.
    #[error("parameter '{0}' is declared twice")]
    DeclaredTwice(
        /// The parameter.
        String,
    ),
    /// A study's own mistake: a list of values without any value.
    #[error("parameter '{0}' has an empty list of values")]
    NoValues(
        /// The parameter.
        String,
    ),
    /// A study's own mistake: it uses a parameter as another kind than it declared.
    #[error("parameter '{name}' is declared as a {declared} but used as a {used}")]
    WrongKind {
        /// The parameter.
        name: String,
        /// The kind declared.
        declared: &'static str,
        /// The kind used.
        used: &'static str,
    },
}
