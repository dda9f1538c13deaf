//! Extreme input ends well or in a typed error; never in a silent NaN.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod empty;
mod faces;
mod far;
mod light_nodes;
mod twins;
