//! Why a region could not be filled.

use crate::region::RegionError;

/// A refused filling.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SeedError {
    /// The region's own numbers are not usable.
    #[error("the region cannot be filled")]
    Region(#[from] RegionError),
    /// A length is zero, negative, infinite or not a number.
    #[error("{quantity} is {value} m; it must be finite and greater than 0")]
    Length {
        /// What the length is.
        quantity: &'static str,
        /// The length, m.
        value: f64,
    },
    /// A coordinate or angle is infinite or not a number.
    #[error("{quantity} is {value}; it must be finite")]
    NotFinite {
        /// What the number is, with its unit.
        quantity: &'static str,
        /// The number.
        value: f64,
    },
    /// No particles per cell.
    #[error("particles per cell and axis are {value}; there must be at least 1")]
    PerAxis {
        /// The number asked for.
        value: u32,
    },
    /// The region is empty, or has no end.
    #[error(
        "along axis {axis} the region reaches from {min} m to {max} m; both must be finite and the first be less"
    )]
    Bounds {
        /// Axis, from 0.
        axis: usize,
        /// Least coordinate, m.
        min: f64,
        /// Greatest coordinate, m.
        max: f64,
    },
    /// The spacing is lost in the rounding of the coordinates.
    #[error(
        "particle spacing is {spacing} m at a coordinate of {coordinate} m; it must be at least {least} m there to be told from rounding"
    )]
    Unresolved {
        /// Spacing of the particles, m.
        spacing: f64,
        /// Greatest distance of the region from the origin of coordinates or of the lattice along
        /// an axis, m.
        coordinate: f64,
        /// Least permitted spacing, m.
        least: f64,
    },
    /// The lattice over the region's box has more points than ids can tell apart.
    #[error(
        "the box about the region has {asked:e} particle places; there must be at most {limit}"
    )]
    TooMany {
        /// Places in the box.
        asked: f64,
        /// Greatest permitted number.
        limit: u32,
    },
    /// No place of the lattice lies in the region.
    #[error(
        "none of the places spaced by {spacing} m lies in the region; there must be at least 1"
    )]
    NoParticles {
        /// Spacing of the particles, m.
        spacing: f64,
    },
}
