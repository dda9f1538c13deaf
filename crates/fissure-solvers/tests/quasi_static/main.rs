//! Equilibrium followed past limits of load and displacement, and of what hardly changes its volume.

#![allow(missing_docs, clippy::panic, clippy::unwrap_used)]

mod implex;
mod locking;
mod snap_back;
