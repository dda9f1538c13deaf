//! Files a simulation leaves: ParaView series, tables, plots, checkpoints, progress.

mod file;

pub mod checkpoint;
pub mod vtk;

pub use file::FileError;
