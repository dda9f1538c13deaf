//! Particles at the same places in every cell of a region of any outline.

use fissure::nalgebra::SMatrix;
use fissure::prelude::*;

/// Two particles per cell and axis in a region of `area` m², volumes clipped at its edge.
///
/// Slivers in sub-cells whose centre is outside belong to nobody: they are shared out, so that the
/// volumes sum to the area.
///
/// # Errors
/// A region that is refused.
pub fn clipped(grid: &Grid<2>, region: &dyn Region<2>, area: f64) -> Result<Seeds<2>, SeedError> {
    fill(grid, region, area, true)
}

/// The same with particles that all have one volume, so that none is much lighter than others.
///
/// # Errors
/// A region that is refused.
pub fn whole(grid: &Grid<2>, region: &dyn Region<2>, area: f64) -> Result<Seeds<2>, SeedError> {
    fill(grid, region, area, false)
}

fn fill(
    grid: &Grid<2>,
    region: &dyn Region<2>,
    area: f64,
    clip: bool,
) -> Result<Seeds<2>, SeedError> {
    let places = InCell {
        origin: grid.origin().into(),
        cell: grid.spacing(),
        per_axis: 2,
        clip,
    };
    let mut seeds = places.seed(region)?;
    let missing = area / seeds.total_volume();
    for volume in &mut seeds.volume {
        *volume *= missing;
    }
    Ok(seeds)
}

/// Seeds that are already there.
pub struct Seeded(pub Seeds<2>);

impl Seeding<2> for Seeded {
    fn seed(&self, _region: &dyn Region<2>) -> Result<Seeds<2>, SeedError> {
        let half_edges: SMatrix<f64, 2, 2> = self.0.half_edges;
        Ok(Seeds {
            position: self.0.position.clone(),
            volume: self.0.volume.clone(),
            half_edges,
        })
    }
}
