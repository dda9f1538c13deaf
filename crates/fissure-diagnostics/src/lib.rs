//! Measures of a scene: energies, section forces, failed zones, histories.
//!
//! A measure borrows the scene and returns numbers; a history is a
//! [`Watch`](fissure_scene::Watch) that keeps them step by step.
//!
//! | item | answers |
//! |---|---|
//! | [`Record`] | columns of any numbers, a row per step |
//! | [`EnergyBalance`], [`EnergyHistory`] | where the work went and how well the ledger closes |
//! | [`EnergyGuard`] | whether a run makes energy out of nothing, because its step is too long |
//! | [`section_force`] | the force through any section of a body |
//! | [`FailedZone`] | how large the failed part of a body is |
//! | [`LoadDisplacement`], [`LoadCurve`] | load over displacement, its work and its peak |
//! | [`curve_error`], [`fit_slope`] | how far a curve is from the exact one, and the order of convergence |
//! | [`fracture`] | J and K of a crack tip, where and when it grows, cracks among failed particles |
//! | [`state_hash`] | whether two scenes are the same to the last bit |
//!
//! All is in SI units. Histories are no part of a checkpoint: they go on from where they are given.

mod curve;
mod energy;
mod energy_guard;
mod energy_history;
mod error;
mod failed_zone;
pub mod fracture;
mod label;
mod load_curve;
mod load_displacement;
mod record;
mod section;
mod state_hash;

pub use curve::{PowerLaw, curve_error, fit_slope};
pub use energy::EnergyBalance;
pub use energy_guard::EnergyGuard;
pub use energy_history::EnergyHistory;
pub use error::{CurveError, MeasureError};
pub use failed_zone::FailedZone;
pub use load_curve::LoadCurve;
pub use load_displacement::LoadDisplacement;
pub use record::Record;
pub use section::{SectionForce, section_force};
pub use state_hash::state_hash;
