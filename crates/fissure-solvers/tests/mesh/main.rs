//! Meshes of quadrilaterals under every solver.

#![allow(missing_docs, clippy::panic, clippy::unwrap_used)]
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod bar;
mod limits;
mod meshes;
mod motion;
mod patch;
mod same_as_grid;
