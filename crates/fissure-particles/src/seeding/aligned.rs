//! Particles on lattices along the axes.

use nalgebra::SVector;

use super::lattice::{Lattice, finite_bounds, length};
use super::{SeedError, Seeding, Seeds};
use crate::region::Region;

/// Particles spaced by this length (m) along the axes, the first half a spacing inside the lower
/// corner of the region's box.
///
/// Each stands for spacingᴰ. Where the box is an integer multiple of the spacing along each axis,
/// the particles fill a block exactly: their volumes sum to the block's to the relative deviation
/// from that multiple, which should be below 1e-6. Elsewhere the particles are spaced by exactly
/// this length all the same; those whose position lies in the region are kept with their whole
/// volume, and the sum differs from the region's volume by part of a layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spacing(pub f64);

impl<const D: usize> Seeding<D> for Spacing {
    fn seed(&self, region: &dyn Region<D>) -> Result<Seeds<D>, SeedError> {
        let (origin, _) = finite_bounds(region)?;
        let spacing = self.0;
        Lattice { origin, spacing }.fill(region)
    }
}

/// `per_axis` particles per grid cell and axis, at (k + ½)/`per_axis` of the cell: a lattice which
/// is aligned with the grid wherever the region lies.
///
/// Those whose position lies in the region are kept, each with the whole volume (cell/`per_axis`)ᴰ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerCell<const D: usize> {
    /// A node of the grid, m.
    pub origin: [f64; D],
    /// Edge of a cell, m.
    pub cell: f64,
    /// Particles per cell and axis, at least 1.
    pub per_axis: u32,
}

impl<const D: usize> PerCell<D> {
    pub(super) fn lattice(&self) -> Result<Lattice<D>, SeedError> {
        length("edge of a cell", self.cell)?;
        if self.per_axis == 0 {
            let value = self.per_axis;
            return Err(SeedError::PerAxis { value });
        }
        Ok(Lattice {
            origin: SVector::from(self.origin),
            spacing: self.cell / f64::from(self.per_axis),
        })
    }
}

impl<const D: usize> Seeding<D> for PerCell<D> {
    fn seed(&self, region: &dyn Region<D>) -> Result<Seeds<D>, SeedError> {
        self.lattice()?.fill(region)
    }
}
