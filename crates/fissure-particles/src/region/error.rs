//! What can be wrong with the numbers that make a region.

/// A number which makes no region.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RegionError {
    /// A box ends before it begins, or an end is not a number.
    #[error("along axis {axis} the region reaches from {min} m to {max} m; the first must be less")]
    Extent {
        /// Axis, from 0.
        axis: usize,
        /// Least coordinate, m.
        min: f64,
        /// Greatest coordinate, m.
        max: f64,
    },
    /// A coordinate, angle or component is infinite or not a number.
    #[error("{quantity} is {value}; it must be finite")]
    NotFinite {
        /// What the number is, with its unit.
        quantity: &'static str,
        /// The number.
        value: f64,
    },
    /// A length is zero, negative, infinite or not a number.
    #[error("{quantity} is {value}; it must be finite and greater than 0")]
    NotPositive {
        /// What the number is, with its unit.
        quantity: &'static str,
        /// The number.
        value: f64,
    },
    /// A polygon needs three vertices at least.
    #[error("a polygon has {count} vertices; it must have at least 3")]
    TooFewVertices {
        /// Its number of vertices.
        count: usize,
    },
}

/// Refuses the first of `values` which is not finite.
pub(crate) fn finite<'a>(
    quantity: &'static str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), RegionError> {
    match values.into_iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(RegionError::NotFinite { quantity, value }),
        None => Ok(()),
    }
}

/// Refuses what is not finite and greater than 0.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<(), RegionError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(RegionError::NotPositive { quantity, value })
}

/// Refuses a box which is empty or not made of numbers. Ends may be infinite.
pub(crate) fn extent(min: &[f64], max: &[f64]) -> Result<(), RegionError> {
    for (axis, (&min, &max)) in min.iter().zip(max).enumerate() {
        // Written so that NaN is refused.
        let right = min < max;
        if !right {
            return Err(RegionError::Extent { axis, min, max });
        }
    }
    Ok(())
}
