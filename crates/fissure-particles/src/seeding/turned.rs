//! Particles on lattices which are turned against the axes.

use nalgebra::{Rotation2, Vector2};

use super::lattice::finite;
use super::{SeedError, Seeding, Seeds};
use crate::region::Region;

/// The particles which another rule gives, turned about a point together with their domains
/// (Sanchez 2010, fig. 5.4).
///
/// The region to hand to it is the one that is *not* turned: what comes out fills
/// [`region.rotated(angle, centre)`](crate::Compose::rotated) with as many particles, of the same
/// volumes.
///
/// ```
/// use fissure_particles::{Block, Seeding, Spacing, Turned};
///
/// let bar = Block::new([0.0, 0.0], [1.0, 0.2]);
/// let turned = Turned { inner: Spacing(0.05), angle: 0.3, centre: [0.0, 0.0] };
/// assert_eq!(turned.seed(&bar)?.len(), Spacing(0.05).seed(&bar)?.len());
/// # Ok::<(), fissure_particles::SeedError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned<S> {
    /// The rule for the region before it is turned.
    pub inner: S,
    /// Angle, rad, counter-clockwise.
    pub angle: f64,
    /// The point which stays, m.
    pub centre: [f64; 2],
}

impl<S: Seeding<2>> Seeding<2> for Turned<S> {
    fn seed(&self, region: &dyn Region<2>) -> Result<Seeds<2>, SeedError> {
        finite("angle, rad,", &[self.angle])?;
        finite("centre of the rotation, m,", &self.centre)?;
        let rotation = Rotation2::new(self.angle);
        let centre = Vector2::from(self.centre);
        let mut seeds = self.inner.seed(region)?;
        for x in &mut seeds.position {
            *x = centre + rotation * (*x - centre);
        }
        seeds.half_edges = rotation.into_inner() * seeds.half_edges;
        Ok(seeds)
    }
}
