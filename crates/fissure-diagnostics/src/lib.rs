//! Measures of a scene: energies, section forces, failed zones, histories.
//!
//! A measure borrows the scene and returns numbers; a history is a
//! [`Watch`](fissure_scene::Watch) that keeps them step by step.
//!
//! | item | answers |
//! |---|---|
//! | [`Record`] | columns of any numbers, a row per step |
//! | [`EnergyBalance`], [`EnergyHistory`] | where the work went and how well the ledger closes |
//!
//! All is in SI units. Histories are no part of a checkpoint: they go on from where they are given.

mod energy;
mod energy_history;
mod label;
mod record;

pub use energy::EnergyBalance;
pub use energy_history::EnergyHistory;
pub use record::Record;
