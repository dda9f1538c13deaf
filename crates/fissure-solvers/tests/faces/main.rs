//! Laws between the faces of cracks.

mod bar;
mod cantilever;
mod flight;
