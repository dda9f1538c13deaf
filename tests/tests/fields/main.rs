//! Nodes with several fields: impact, friction, bonds, cracks, conservation, bits.

#![allow(
    missing_docs,
    clippy::neg_cmp_op_on_partial_ord,
    clippy::panic,
    clippy::print_stdout,
    clippy::result_large_err,
    clippy::unwrap_used
)]

mod bits;
mod bond;
mod conservation;
mod crack;
mod crack_statics;
mod friction;
mod impact;
