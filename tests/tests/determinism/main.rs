//! The same input gives the same bits: on any number of threads, after a restart, and elsewhere on
//! the grid.

#![allow(
    missing_docs,
    clippy::neg_cmp_op_on_partial_ord,
    clippy::panic,
    clippy::print_stdout,
    clippy::result_large_err,
    clippy::unwrap_used
)]

mod fragments;
mod restart;
mod sparse;
mod threads;
mod translation;
mod units;
