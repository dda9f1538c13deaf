//! What can be wrong with a random field.

/// A random field or a marginal distribution that is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
    /// A parameter is outside its range.
    #[error("{parameter} is {value}; it must be {permitted}")]
    Parameter {
        /// Its name, with its unit.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The permitted range.
        permitted: &'static str,
    },
    /// The region of the field ends before it begins, or an end is not a number.
    #[error("along axis {axis} the field reaches from {min} m to {max} m; the first must be less")]
    Extent {
        /// Axis, from 0.
        axis: usize,
        /// Least coordinate, m.
        min: f64,
        /// Greatest coordinate, m.
        max: f64,
    },
    /// The lattice needs more points than are permitted.
    #[error(
        "the embedding needs {points} points; at most {limit} are permitted (a coarser spacing)"
    )]
    TooLarge {
        /// Points of the smallest embedding.
        points: f64,
        /// Greatest permitted number.
        limit: usize,
    },
    /// The correlation is too long for the region: no embedding within the limit is positive.
    #[error(
        "negative eigenvalues have {share:e} of the variance on the largest embedding tried, of \
         {points} points; at most {permitted:e} may be left out (a shorter correlation or a \
         rougher one, or permit more)"
    )]
    Negative {
        /// `Σ|λ⁻| / Σλ`.
        share: f64,
        /// What may be left out.
        permitted: f64,
        /// Points of the largest embedding tried.
        points: usize,
    },
}

/// Refuses a parameter that is not finite and positive.
pub(super) fn positive(parameter: &'static str, value: f64) -> Result<(), FieldError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(FieldError::Parameter {
        parameter,
        value,
        permitted: "finite and > 0",
    })
}
