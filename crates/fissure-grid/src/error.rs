//! What can be wrong with a grid.

use thiserror::Error;

/// Why a grid was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum GridError {
    /// The cell width is no positive number.
    #[error("grid spacing is {spacing} m, must be finite and > 0")]
    Spacing {
        /// The width given, m.
        spacing: f64,
    },
    /// A bound is infinite or not a number.
    #[error("grid bounds along axis {axis} are {min} m to {max} m, must be finite")]
    NotFinite {
        /// The axis, from 0.
        axis: usize,
        /// Lower bound, m.
        min: f64,
        /// Upper bound, m.
        max: f64,
    },
    /// The upper bound is not above the lower one.
    #[error(
        "grid bounds along axis {axis} are {min} m to {max} m, the upper must exceed the lower"
    )]
    Empty {
        /// The axis, from 0.
        axis: usize,
        /// Lower bound, m.
        min: f64,
        /// Upper bound, m.
        max: f64,
    },
    /// Positions so far from zero cannot be told apart finely enough within a cell.
    #[error(
        "coordinate {coordinate} m along axis {axis} is too far from zero for a spacing of {spacing} m, must be within \
         ±{limit} m: use local coordinates"
    )]
    TooFar {
        /// The axis, from 0.
        axis: usize,
        /// The bound farther from zero, m.
        coordinate: f64,
        /// Cell width, m.
        spacing: f64,
        /// Largest distance from zero allowed for this spacing, m.
        limit: f64,
    },
    /// More cells along an axis than are addressed.
    #[error("grid would have {cells} cells along axis {axis}, must be at most {limit}")]
    TooManyCells {
        /// The axis, from 0.
        axis: usize,
        /// Cells needed; a float, since it may exceed any integer.
        cells: f64,
        /// Cells allowed.
        limit: i32,
    },
}
