//! Equilibrium followed past limits of load and displacement.

#![allow(missing_docs, clippy::panic, clippy::unwrap_used)]

mod snap_back;
