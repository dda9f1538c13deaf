//! What steps keep: mass, momentum and, with APIC on splines, angular momentum.

#![allow(
    missing_docs,
    clippy::neg_cmp_op_on_partial_ord,
    clippy::panic,
    clippy::print_stdout,
    clippy::result_large_err,
    clippy::unwrap_used
)]

mod angular;
mod momentum;
