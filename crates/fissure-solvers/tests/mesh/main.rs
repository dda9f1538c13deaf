//! Meshes of quadrilaterals under every solver.

#![allow(missing_docs, clippy::panic, clippy::print_stdout, clippy::unwrap_used)]

mod bar;
mod limits;
mod meshes;
mod motion;
mod patch;
mod same_as_grid;
