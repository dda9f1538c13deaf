//! Why a measure could not be taken.

use thiserror::Error;

/// Why a measure of a scene could not be taken.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MeasureError {
    /// No body has this name.
    #[error("no body is called '{name}'")]
    UnknownBody {
        /// The name asked for.
        name: String,
    },
    /// The law of the body has no value of this name.
    #[error("the law of body '{body}' has no value '{value}'; it has {present:?}")]
    UnknownValue {
        /// The body.
        body: String,
        /// The name asked for.
        value: String,
        /// The names there are.
        present: &'static [&'static str],
    },
    /// A number is outside its permitted range.
    #[error("'{parameter}' is {value}; permitted: {permitted}")]
    Parameter {
        /// What it is.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The permitted range.
        permitted: &'static str,
    },
    /// The measure is not defined in this kind of scene.
    #[error("{measure} is not defined in this kind of scene")]
    Kinematics {
        /// What was asked for.
        measure: &'static str,
    },
    /// The particles do not fill the domain of an integral.
    #[error("the particles cover {coverage} of the domain; permitted: 0.95 to 1.05")]
    Coverage {
        /// Weighted area of the particles over that of the domain.
        coverage: f64,
    },
    /// A measure is not finite.
    #[error("{measure} is not finite")]
    NotFinite {
        /// Which.
        measure: &'static str,
    },
    /// No particle of the body reaches into the section's slab.
    #[error("no particle of body '{body}' lies in the slab of the section")]
    EmptySection {
        /// The body.
        body: String,
    },
}

/// Refuses a length or an area that is not a positive number.
pub(crate) fn check_positive(parameter: &'static str, value: f64) -> Result<(), MeasureError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(MeasureError::Parameter {
        parameter,
        value,
        permitted: "finite and > 0",
    })
}

/// Why sampled curves could not be compared or fitted.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CurveError {
    /// The columns differ in length, or there are fewer than two points.
    #[error("{x} abscissae and {y} ordinates do not make a curve of two points or more")]
    Length {
        /// Number of abscissae.
        x: usize,
        /// Number of ordinates.
        y: usize,
    },
    /// A number that is needed is not finite.
    #[error("{what} is not finite (point {point})")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// Which point, counted from 0.
        point: usize,
    },
    /// A number has no logarithm.
    #[error("{what} is {value} at point {point}; permitted: > 0")]
    NotPositive {
        /// Which number.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Which point, counted from 0.
        point: usize,
    },
    /// The abscissae fall somewhere.
    #[error("the abscissa falls at point {point}")]
    Falling {
        /// Which point, counted from 0.
        point: usize,
    },
    /// All abscissae are the same: no line has that slope.
    #[error("all abscissae are the same")]
    OneAbscissa,
    /// The samples do not reach over the range.
    #[error("the curve reaches from {first} to {last}, the range from {from} to {to}")]
    Range {
        /// First abscissa.
        first: f64,
        /// Last abscissa.
        last: f64,
        /// Start of the range.
        from: f64,
        /// End of the range.
        to: f64,
    },
    /// The exact curve is zero over the whole range, so that nothing is relative to it.
    #[error("the exact curve is zero over the range")]
    ZeroCurve,
}
