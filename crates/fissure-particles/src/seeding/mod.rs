//! Seeding: where the particles of a region go.

mod aligned;
mod error;
mod in_cell;
mod lattice;
mod seeds;
mod turned;

use crate::region::Region;

pub use aligned::{PerCell, Spacing};
pub use error::SeedError;
pub use in_cell::InCell;
pub use seeds::Seeds;
pub use turned::Turned;

/// A rule by which a region is filled with particles.
pub trait Seeding<const D: usize> {
    /// The particles of `region`, in an order which depends on the rule and the region alone.
    ///
    /// # Errors
    /// [`SeedError`] if the rule's or the region's numbers are not usable, or if no particle would
    /// come of it, or more than a body can hold.
    fn seed(&self, region: &dyn Region<D>) -> Result<Seeds<D>, SeedError>;
}
