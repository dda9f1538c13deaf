//! Bad input gets a typed error before the first step, and a particle that fails in a run leaves
//! the scene as it was.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod input;
mod mid_run;
