//! One volume change for all particles of a patch, against locking of what hardly changes its volume
//! [Hughes 1980; de Souza Neto et al. 1996].
//!
//! With `f = 1 + ∇u` the increment of deformation, `j = det f` in the scene's dimensions `d`, the weights `w = V det F_old`
//! and the mean `j̄ = Σ w j/Σ w` over the particles of a patch (with linear functions those of a cell),
//!
//! ```text
//! f̄ = (j̄/j)^{1/d} f,   F = f̄ F_old                                                          (1)
//! δf̄ f̄⁻¹ = Σ_i δu_i ⊗ g_i + (1/d) Σ_i δu_i·(ḡ_i − g_i) 1,   g = f⁻ᵀ∇N,   ḡ = Σ w j g/Σ w j     (2)
//! f_i = −Σ V det F (σ·g_i + (tr σ/d) (ḡ_i − g_i))                                              (3)
//! ```
//!
//! Traces are those of the `d` dimensions: two in plane strain, three in space and in axisymmetry, where the hoop stretch is
//! one of them and `g_i` in (ḡ − g) has `N_i/r` added along the radius. (3) does on `δu` the work of the stress on (2), so stored energies
//! balance; the tangent takes (2) for the strain and leaves out how `g` and `ḡ` turn in its correction, which
//! is of the order of the strain.

use fissure_grid::SUMS;
use fissure_scene::{Kinematics, Scene};
use nalgebra::{SMatrix, SVector};

use super::balance::At;
use super::links::Links;
use super::stiffness::inverse_radius;
use crate::nodes::NodeSums;

/// The means of all patches.
#[derive(Debug, Default)]
pub(crate) struct Averages<const D: usize> {
    /// `(j̄/j)^{1/D}` of every particle of every body.
    pub factors: Vec<Vec<f64>>,
    /// `ḡ` of the nodes of every patch, patch by patch.
    pub means: Vec<SVector<f64, D>>,
}

/// `f⁻ᵀ` and `det f` of a particle of a patch, and one over its radius at the end of the step.
struct Moved<const D: usize> {
    turned: SMatrix<f64, D, D>,
    ratio: f64,
    inverse_radius: f64,
}

/// How many stretches make a volume.
pub(super) fn stretches<const D: usize>(scene: &Scene<D>) -> f64 {
    match scene.kinematics() {
        Kinematics::Axisymmetric => 3.0,
        _ => D as f64,
    }
}

/// A gradient at the end of a step with what the hoop stretch adds to the rate of the volume.
#[inline]
pub(super) fn volumetric<const D: usize>(
    mut gradient: SVector<f64, D>,
    weight: f64,
    inverse_radius: f64,
) -> SVector<f64, D> {
    gradient[0] += weight * inverse_radius;
    gradient
}

impl<const D: usize> Links<D> {
    /// Finds the means for displacements of the nodes.
    pub(crate) fn average(&mut self, scene: &Scene<D>, displacement: &[SVector<f64, D>]) {
        let mut averages = self.averages.take().unwrap_or_default();
        let power = stretches(scene).recip();
        let axial = scene.kinematics() == Kinematics::Axisymmetric;
        averages.factors.resize(scene.bodies().len(), Vec::new());
        for (factors, body) in averages.factors.iter_mut().zip(scene.bodies()) {
            factors.clear();
            factors.resize(body.particles().len(), 1.0);
        }
        averages.means.clear();
        for patch in (0..self.patches()).map(|patch| self.patch(patch)) {
            let first = averages.means.len();
            averages
                .means
                .resize(first + patch.nodes.len(), SVector::zeros());
            let (mut before, mut after) = (0.0, 0.0);
            let mut ratios = Vec::with_capacity(patch.members.len());
            for member in patch.members {
                let particles = scene.bodies()[member.body as usize].particles();
                let row = member.index as usize;
                let f_old = &particles.motion.deformation_gradient[row];
                let weight = particles.volume[row] * f_old.determinant();
                let links = patch.links(member);
                let mut gradient = SMatrix::<f64, D, D>::identity();
                let mut radial = 0.0;
                for (link, &node) in links.iter().zip(patch.nodes) {
                    let u = &displacement[self.active[node as usize] as usize];
                    gradient += u * link.gradient.transpose();
                    radial += u[0] * link.weight;
                }
                let radius = particles.motion.position[row][0];
                let moved = Moved::of(&gradient, axial.then_some((radius, radius + radial)));
                ratios.push(moved.ratio);
                before += weight;
                after += weight * moved.ratio;
                for (mean, link) in averages.means[first..].iter_mut().zip(links) {
                    let gradient = moved.turned * link.gradient;
                    *mean += volumetric(gradient, link.weight, moved.inverse_radius)
                        * (weight * moved.ratio);
                }
            }
            let mean = after / before;
            averages.means[first..]
                .iter_mut()
                .for_each(|gradient| *gradient /= after);
            for (member, ratio) in patch.members.iter().zip(ratios) {
                let factor = (mean / ratio).powf(power);
                // A particle turned inside out is the law's to refuse.
                if ratio > 0.0 && factor.is_finite() {
                    averages.factors[member.body as usize][member.index as usize] = factor;
                }
            }
        }
        self.averages = Some(averages);
    }

    /// Internal forces of the stresses on the nodes by the links: (3), or those of the gradients alone without means.
    pub(crate) fn patch_forces(&self, scene: &Scene<D>, sums: &mut NodeSums<D>, at: At) {
        sums.clear(sums.len());
        let stretches = stretches(scene);
        for patch in (0..self.patches()).map(|patch| self.patch(patch)) {
            for member in patch.members {
                let particles = scene.bodies()[member.body as usize].particles();
                let row = member.index as usize;
                let f_old = &particles.motion.deformation_gradient[row];
                let (motion, turned) = match at {
                    At::Start => (&particles.motion, SMatrix::identity()),
                    At::End => (&particles.trial, patch.relative(member, scene)),
                };
                let f_new = match at {
                    At::Start => f_old,
                    At::End => &particles.trial.deformation_gradient[row],
                };
                let volume = particles.volume[row] * f_new.determinant();
                let full = motion.stress[row].to_matrix();
                let stress = SMatrix::<f64, D, D>::from_fn(|i, j| full[(i, j)] * volume);
                let inverse_radius = inverse_radius(scene, &motion.position[row]);
                let hoop = match inverse_radius {
                    0.0 => 0.0,
                    _ => full[(2, 2)] * volume,
                };
                let mean_stress = (stress.trace() + hoop) / stretches;
                let links = patch.links(member).iter();
                for (place, (link, &node)) in links.zip(patch.nodes).enumerate() {
                    let gradient = turned * link.gradient;
                    let mut force = stress * gradient;
                    force[0] += hoop * link.weight * inverse_radius;
                    if let Some(mean) = patch.means.get(place) {
                        let own = volumetric(gradient, link.weight, inverse_radius);
                        force += (mean - own) * mean_stress;
                    }
                    let mut numbers = [0.0; SUMS];
                    for axis in 0..D {
                        numbers[NodeSums::<D>::FORCE + axis] = -force[axis];
                    }
                    sums.add(self.active[node as usize] as usize, &numbers);
                }
            }
        }
    }
}

impl<const D: usize> Moved<D> {
    /// Of the gradient of a motion and, in axisymmetry, the radii before and after it.
    fn of(gradient: &SMatrix<f64, D, D>, radii: Option<(f64, f64)>) -> Self {
        let f = nalgebra::Matrix3::from_fn(|i, j| match i < D && j < D {
            true => gradient[(i, j)],
            false => f64::from(u8::from(i == j)),
        });
        let inverse = f.try_inverse().unwrap_or_else(nalgebra::Matrix3::identity);
        Self {
            turned: SMatrix::from_fn(|i, j| inverse[(j, i)]),
            ratio: f.determinant() * radii.map_or(1.0, |(before, after)| after / before),
            inverse_radius: radii.map_or(0.0, |(_, after)| after.recip()),
        }
    }
}
