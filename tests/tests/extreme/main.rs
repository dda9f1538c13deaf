//! Extreme input ends well or in a typed error; never in a silent NaN.

#![allow(
    missing_docs,
    clippy::neg_cmp_op_on_partial_ord,
    clippy::panic,
    clippy::print_stdout,
    clippy::result_large_err,
    clippy::unwrap_used
)]

mod empty;
mod faces;
mod far;
mod light_nodes;
mod long_steps;
mod twins;
