//! Why a crack was refused.

use thiserror::Error;

/// Why a crack, or a change of one, was refused. Vertices and segments are counted from 0.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum CrackError {
    /// Fewer than two vertices.
    #[error("{vertices} vertices do not make a line; permitted: 2 or more")]
    TooShort {
        /// Their number.
        vertices: usize,
    },
    /// A vertex is not finite.
    #[error("vertex {vertex} is not finite")]
    NotFinite {
        /// Which.
        vertex: usize,
    },
    /// A segment has no length.
    #[error("segment {segment} has no length")]
    NoLength {
        /// Which.
        segment: usize,
    },
    /// Two segments cross, touch away from the vertex they share, or fold back on one another.
    #[error("segments {first} and {second} of the crack meet")]
    NotSimple {
        /// The one with the lower number.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A number is outside its range.
    #[error("'{parameter}' is {value}; permitted: {permitted}")]
    Parameter {
        /// What it is.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The permitted range.
        permitted: &'static str,
    },
    /// The end cannot grow: it is a mouth or arrested.
    #[error("the end is no tip")]
    NoTip,
    /// There is no crack of this number.
    #[error("there is no crack {crack}; the scene has {cracks}")]
    Unknown {
        /// The number asked for.
        crack: usize,
        /// How many there are.
        cracks: usize,
    },
}
