//! Material-point solvers: transfers between particles and grid, explicit and quasi-static steps.
//!
//! A solver owns its discretisation, a grid and a shape function, and moves a
//! [`Scene`](fissure_scene::Scene). The files follow the step: `placement` sorts the particles
//! into tiles and runs, `to_grid` sums them to the nodes, `grid_update` moves the nodes,
//! `to_particles` brings the motion back; the law is called per run in between.

mod band;
mod constraints;
mod explicit;
mod loads;
mod nodes;
mod placement;
mod quasi_static;
mod transfers;
mod window;

pub use band::BandSource;
pub use explicit::{Explicit, ExplicitSettings, StressUpdate, Transfer};
pub use placement::Placement;
pub use quasi_static::{QuasiStatic, QuasiStaticSettings};
