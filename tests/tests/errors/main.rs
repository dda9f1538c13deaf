//! Bad input gets a typed error before the first step, and a particle that fails in a run leaves
//! the scene as it was.

#![allow(
    missing_docs,
    clippy::neg_cmp_op_on_partial_ord,
    clippy::panic,
    clippy::print_stdout,
    clippy::result_large_err,
    clippy::unwrap_used
)]

mod input;
mod mid_run;
