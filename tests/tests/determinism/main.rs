//! The same input gives the same bits: on any number of threads, after a restart, and elsewhere on
//! the grid.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod fragments;
mod restart;
mod threads;
mod translation;
