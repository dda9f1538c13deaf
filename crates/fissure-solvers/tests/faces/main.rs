//! Laws between the faces of cracks.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests")]

mod bar;
mod cantilever;
mod closed;
mod flight;
