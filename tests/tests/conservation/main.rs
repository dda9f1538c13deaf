//! What steps keep: mass, momentum and, with APIC on splines, angular momentum.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod angular;
mod momentum;
