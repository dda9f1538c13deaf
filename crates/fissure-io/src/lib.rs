//! Files a simulation leaves: ParaView series, tables, plots, checkpoints, progress.
//!
//! | module | writes | feature |
//! |---|---|---|
//! | [`vtk`] | particles as `.vtu` frames under a `.pvd`, for ParaView | |
//! | [`table`] | named columns with units as CSV, and reads them | |
//! | [`checkpoint`] | named sections that come back bit for bit or are refused | |
//! | [`gmsh`] | nothing: reads meshes of quadrilaterals and their named groups | |
//! | `plot` | curves and coloured particles as PNG or SVG | `plots` |
//! | `progress` | a bar on the terminal | `progress` |
//!
//! Each works on plain slices, in SI units; [`vtk::ParticleSeries`], [`checkpoint::Checkpoint`],
//! [`checkpoint::AutoCheckpoint`] and `progress::Progress` do the same for a running scene, as watches. Nothing is written
//! unless asked. Files are replaced in one piece, except the table that is streamed, and every error names the file and
//! what in it is wrong.
//!
//! ```
//! use fissure_io::checkpoint::{CheckpointReader, CheckpointWriter};
//! use fissure_io::table::TableWriter;
//! use fissure_io::vtk::{Compression, PointCloud, Series};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = tempfile::tempdir()?;
//! # let out = folder.path();
//! let mut positions = vec![[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]]; // m
//! let damage = vec![0.0, 0.75];
//! let mut frames = Series::new(out, "bar", Compression::Lz4)?;
//! let mut curve = TableWriter::create(out.join("curve.csv"), &["time [s]", "opening [m]"])?;
//!
//! for step in 1..=3_u32 {
//!     let time = 1e-6 * f64::from(step);
//!     positions[1][0] += 1e-7;
//!     frames.write(time, PointCloud::new(&positions).scalar("damage", &damage))?;
//!     curve.row([time, positions[1][0] - 0.1])?;
//! }
//! curve.finish()?;
//!
//! let mut checkpoint = CheckpointWriter::new();
//! checkpoint.put("positions", &positions)?.put_value("clock", &(3_u64, 3e-6))?;
//! checkpoint.write(out.join("bar.checkpoint"))?;
//!
//! let checkpoint = CheckpointReader::open(out.join("bar.checkpoint"))?;
//! assert_eq!(checkpoint.get::<[f64; 3]>("positions")?, positions);
//! # Ok(())
//! # }
//! ```

mod file;

pub mod checkpoint;
pub mod gmsh;
#[cfg(feature = "plots")]
pub mod plot;
#[cfg(feature = "progress")]
pub mod progress;
pub mod table;
pub mod vtk;

pub use file::FileError;
