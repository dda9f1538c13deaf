//! The force through a section of a body.

use fissure_particles::Particles;
use fissure_scene::{Body, Scene};
use nalgebra::SVector;

use crate::MeasureError;
use crate::error::check_positive;

/// The force that the part of a body ahead of a section exerts on the part behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionForce<const D: usize> {
    /// The force, N; in axisymmetry that of the full 2π.
    pub force: SVector<f64, D>,
    /// Its component along the section's normal, N; positive in tension.
    pub normal: f64,
    /// Number of particles in the slab, cut ones included.
    pub particles: usize,
}

/// Force through the section of a body at `point` (m) with `normal` (any length), by virtual work.
///
/// A virtual displacement that rises linearly across a slab of thickness `l` (m) about the section
/// and is rigid on both sides does the work `∫ σ·n dV / l` in the slab: the mean of the force over
/// its sections, and in equilibrium the force through each. Over particles,
///
/// ```text
/// P = (1/l) Σ V_p σ_p·n,   n·P = (1/l) Σ V_p n·σ_p·n,   V_p = V_p0 det F
/// ```
///
/// with the share of `V_p` that is in the slab. A particle's domain counts as an interval along
/// the normal, so for lattices along the normal, turned with the body or not, the slab may be of
/// any thickness and lie anywhere inside the body; for others it should span several particles.
/// Unlike a sum of nodal forces over a line of nodes, it does not ask that the section follows the
/// grid. The slab must lie wholly inside the body; in a moving body the result is its mean over the
/// slab, which differs from section to section by what is accelerated between them.
///
/// # Errors
/// [`MeasureError::UnknownBody`]; [`MeasureError::Parameter`] for a thickness or a normal that is
/// not positive and finite; [`MeasureError::EmptySection`].
///
/// ```
/// use fissure_diagnostics::section_force;
/// use fissure_materials::Isotropic;
/// use fissure_particles::{Block, Spacing};
/// use fissure_scene::{Plane, Scene};
/// use fissure_tensor::Sym;
/// use nalgebra::Vector2;
///
/// let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.3 };
/// let mut scene = Scene::plane(Plane::Strain { thickness: 0.01 });
/// scene.fill("bar", steel, &Block::new([0.0, 0.0], [0.2, 0.06]), &Spacing(5e-3))?;
/// scene.bodies_mut()[0].particles_mut().motion.stress.fill(Sym::diagonal(1e6, 0.0, 0.0));
///
/// let section = section_force(&scene, "bar", Vector2::new(0.1, 0.03), Vector2::x(), 7e-3)?;
/// assert!((section.normal - 1e6 * 0.06 * 0.01).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn section_force<const D: usize>(
    scene: &Scene<D>,
    body: &str,
    point: SVector<f64, D>,
    normal: SVector<f64, D>,
    slab: f64,
) -> Result<SectionForce<D>, MeasureError> {
    check_positive("thickness of the slab", slab)?;
    check_positive("length of the normal", normal.norm())?;
    let name = body;
    let body = scene.body(name).ok_or_else(|| MeasureError::UnknownBody {
        name: name.to_owned(),
    })?;
    let normal = normal.normalize();
    let Particles { volume, motion, .. } = body.particles();
    let (mut force, mut particles) = (SVector::zeros(), 0);
    for (i, x) in motion.position.iter().enumerate() {
        let f = &motion.deformation_gradient[i];
        let edges = Body::<D>::in_space(f) * body.half_edges();
        let reach: f64 = edges.column_iter().map(|e| e.dot(&normal).abs()).sum();
        let share = overlap((x - point).dot(&normal), reach, 0.5 * slab);
        if share > 0.0 {
            particles += 1;
            let traction = motion.stress[i].to_matrix() * in_three(&normal);
            let volume = share * volume[i] * f.determinant();
            force += SVector::from_fn(|k, _| traction[k]) * (volume / slab);
        }
    }
    if particles == 0 {
        return Err(MeasureError::EmptySection {
            body: name.to_owned(),
        });
    }
    Ok(SectionForce {
        force,
        normal: force.dot(&normal),
        particles,
    })
}

/// Share of the interval `centre ± reach` that lies in `±half`.
fn overlap(centre: f64, reach: f64, half: f64) -> f64 {
    if reach > 0.0 {
        let inside = (centre + reach).min(half) - (centre - reach).max(-half);
        (inside / (2.0 * reach)).max(0.0)
    } else {
        f64::from(u8::from(centre.abs() <= half))
    }
}

/// A direction of the scene's space as one of its tensors'.
fn in_three<const D: usize>(n: &SVector<f64, D>) -> SVector<f64, 3> {
    SVector::from_fn(|i, _| if i < D { n[i] } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::overlap;

    #[test]
    fn the_share_in_the_slab() {
        assert_eq!(overlap(0.0, 1.0, 2.0), 1.0);
        assert_eq!(overlap(2.0, 1.0, 2.0), 0.5);
        assert_eq!(overlap(0.5, 2.0, 0.25), 0.125);
        assert_eq!(
            (overlap(4.0, 1.0, 2.0), overlap(-4.0, 1.0, 2.0)),
            (0.0, 0.0)
        );
        assert_eq!((overlap(1.0, 0.0, 2.0), overlap(3.0, 0.0, 2.0)), (1.0, 0.0));
    }
}
