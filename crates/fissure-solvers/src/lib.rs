//! Material-point solvers: transfers between particles and grid, explicit and quasi-static steps.
//!
//! A solver owns its discretisation, a grid and a shape function, and moves a
//! [`Scene`](fissure_scene::Scene). The files follow the step: `placement` sorts the particles
//! into tiles and runs, `explicit::step` names the phases, `grid_update` moves the nodes, `kernels` bring
//! the motion to the particles and what they make of it back to the nodes, with the law called in
//! between; `transfers` sums particles to nodes without it.

mod band;
mod bonds;
mod checks;
mod constraints;
mod crack_motion;
#[allow(clippy::needless_range_loop)] // Numbers name the components of matrices.
mod eight;
#[cfg(feature = "implicit")]
mod equilibrium;
mod explicit;
mod groups;
#[cfg(feature = "implicit")]
mod implicit;
#[cfg(feature = "implicit")]
pub mod linear;
mod loads;
mod nodes;
mod placement;
#[cfg(feature = "implicit")]
mod quasi_static;
mod release;
mod splits;
mod transfers;
mod window;

pub use band::BandSource;
#[cfg(feature = "implicit")]
pub use equilibrium::choice::{Iterative, LinearSolver, Method, Preconditioning, Product};
#[cfg(feature = "implicit")]
pub use equilibrium::statistics::StepStatistics;
pub use explicit::{Explicit, ExplicitSettings, StressUpdate, Transfer};
#[cfg(feature = "implicit")]
pub use fissure_scene::NewtonStop;
#[cfg(feature = "implicit")]
pub use implicit::{Implicit, ImplicitSettings, Integration};
pub use placement::Placement;
#[cfg(feature = "implicit")]
pub use quasi_static::{
    Averaging, EmbeddedCrack, EmbeddedForm, EmbeddedJump, LoadControl, QuasiStatic,
    QuasiStaticSettings, Safeguard,
};
