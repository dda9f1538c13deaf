//! Files a simulation leaves: ParaView series, tables, plots, checkpoints, progress.

mod file;

pub mod checkpoint;
#[cfg(feature = "progress")]
pub mod progress;
pub mod table;
pub mod vtk;

pub use file::FileError;
