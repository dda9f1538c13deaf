//! Particles for ParaView: one `.vtu` per frame and a `.pvd` that lists them with their times.
//!
//! [`ParticleSeries`] writes a running scene; [`PointCloud`] and [`Series`] write columns from anywhere.
//!
//! Every particle is a `VTK_VERTEX` cell. Numbers are appended as raw bytes with 64-bit headers, `f64` throughout, so that
//! a frame holds the simulation's bits; [`Compression::Lz4`] packs them in blocks, which pays for columns that are mostly
//! constant (damage, ids of bodies) and little for noisy ones. Files are replaced in one piece, so a viewer that watches a
//! running simulation never meets half of one.

mod appended;
mod cloud;
mod document;
mod fields;
mod particles;
mod series;

use std::path::PathBuf;

pub use appended::Compression;
pub use cloud::PointCloud;
pub use particles::ParticleSeries;
pub use series::Series;

use crate::FileError;

/// Why a point cloud or a series could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VtkError {
    /// The operating system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// An array does not have one entry per point.
    #[error("'{}': array '{array}' has {found} entries for {points} points", path.display())]
    Length {
        /// The file that was to be written.
        path: PathBuf,
        /// The array's name.
        array: String,
        /// Entries it has.
        found: usize,
        /// Points there are.
        points: usize,
    },
    /// Two arrays have the same name, of which a viewer would show one.
    #[error("'{}': two arrays are named '{array}'", path.display())]
    Duplicate {
        /// The file that was to be written.
        path: PathBuf,
        /// The name.
        array: String,
    },
    /// A name XML cannot carry: empty, or with control characters.
    #[error("'{}': {array:?} is no name for an array", path.display())]
    ArrayName {
        /// The file that was to be written.
        path: PathBuf,
        /// The name.
        array: String,
    },
    /// The name of a series is a part of its files' names and cannot be empty or hold a separator or control character.
    #[error("{name:?} is no name for a series of files")]
    SeriesName {
        /// The name.
        name: String,
    },
    /// A frame's time is not a number, or lies before the last frame's.
    #[error("'{}': a frame at t = {time} s cannot follow one at t = {last} s", path.display())]
    Time {
        /// The series' `.pvd`.
        path: PathBuf,
        /// The refused time, s.
        time: f64,
        /// Time of the last frame, s; minus infinity before the first.
        last: f64,
    },
    /// The `.pvd` to go on from was not written by [`Series`].
    #[error("'{}': line {line} does not read as a series this crate wrote", path.display())]
    Unreadable {
        /// The `.pvd`.
        path: PathBuf,
        /// Line number, from 1.
        line: usize,
    },
}
