//! Equilibrium followed past limits of load and displacement, and of what hardly changes its volume.

#![allow(missing_docs, clippy::panic, clippy::unwrap_used)]

mod embedded;
mod implex;
mod line_search;
mod locking;
mod one_strain;
mod snap_back;
mod tiny_toughness;
