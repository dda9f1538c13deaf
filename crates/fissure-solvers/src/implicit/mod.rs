//! Implicit dynamics of material points [Sanchez 2010, ch. 4.2 and app. A].
//!
//! The nodes' displacement increments over the step are the unknowns; forces, strains and the tangent
//! are those of the quasi-static step, to which inertia is added. `scheme` says how displacement,
//! velocity and acceleration go together, `residual` says what is left unbalanced, `newton` iterates, `step` cuts steps that fail and books those
//! that do not.

mod newton;
mod particles;
mod residual;
mod scheme;
mod settings;
mod step;

pub use settings::{ImplicitSettings, Integration};
pub use step::Implicit;
