//! Exact solutions and identities: what the explicit solver must reproduce, shape by shape and
//! transfer by transfer.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::print_stdout)]

mod axisymmetric;
mod bar;
mod convected;
mod disc;
mod energy;
mod gravity;
mod patch;
mod rigid_motion;
mod sections;
