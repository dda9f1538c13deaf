//! Exact solutions and identities: what the explicit solver must reproduce, shape by shape and
//! transfer by transfer.

#![allow(
    missing_docs,
    clippy::neg_cmp_op_on_partial_ord,
    clippy::panic,
    clippy::print_stdout,
    clippy::result_large_err,
    clippy::unwrap_used
)]

mod axisymmetric;
mod bar;
mod convected;
mod disc;
mod energy;
mod gravity;
mod patch;
mod rigid_motion;
mod rollers;
mod sections;
mod turned_point;
