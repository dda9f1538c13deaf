//! Implicit dynamics and the tangent it shares with quasi-static steps.

#![allow(missing_docs, clippy::panic, clippy::unwrap_used)]

mod bar;
mod explicit;
mod orders;
mod ring;
mod slow;
mod solvers;
mod stiff;
mod tangent;
