//! One strain for all particles of a patch: with linear functions, those of a cell.
//!
//! The jump of a crack that runs obliquely through a cell is not constant in it: particles of the cell see different
//! strains, and some unload where all should fail. With the mean gradients
//!
//! ```text
//! G_i = Σ w ∇N_i/Σ w,   w = V det F_old,   F = f F_old,   f = 1 + Σ_i u_i ⊗ G_i                (1)
//! f_i = −Σ V det F σ·(f⁻ᵀ G_i)                                                                (2)
//! ```
//!
//! they see one. (2) does on `u` the work of the stress, and has the tangent of a particle with the gradients `G`. The mean
//! does not see motions that bend a cell like an hourglass. They are held by a spring in what the gradient of each
//! particle would differ by from the mean, `H`, since the particle was where it is seen from first:
//!
//! ```text
//! H = H_old + Σ_i u_i ⊗ a_i,   a_i = H_oldᵀ G_i + (F_old + H_old)ᵀ (∇N_i − G_i)              (3)
//! φ = ½ k V |H|²,   f_i = −k V H a_i                                                          (4)
//! k = θ ⟨Σ w σ:e⟩/Σ w e:e,   e = ½ (1 − F_old⁻ᵀ F_old⁻¹),   at most θ M                        (5)
//! ```
//!
//! `H` turns with the body, and (4) is quadratic in a step. (5) is the share `θ` of the secant stiffness that the patch had
//! at the start of the step, no more than the modulus `M = ρ c²` of fast waves: it falls with the stress where the
//! material fails, and goes with it.

use fissure_grid::SUMS;
use fissure_scene::Scene;
use nalgebra::{Matrix3, SMatrix, SVector};

use super::links::Links;
use crate::nodes::NodeSums;

/// Squares of strains below this are nothing to take a secant by.
const NO_STRAIN: f64 = 1e-24;

/// `H` of every particle: body by body, by the particles' ids.
#[derive(Debug, Default)]
pub(crate) struct Deviations<const D: usize> {
    of: Vec<Vec<SMatrix<f64, D, D>>>,
}

/// What a patch holds against an hourglass.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Firm<'a, const D: usize> {
    /// `k`, Pa.
    pub stiffness: f64,
    /// `a` of all links.
    pub arms: &'a [SVector<f64, D>],
}

impl<const D: usize> Deviations<D> {
    fn at(&self, body: usize, id: u32) -> SMatrix<f64, D, D> {
        let body = self.of.get(body);
        let known = body.and_then(|of| of.get(id as usize));
        known.copied().unwrap_or_else(SMatrix::zeros)
    }

    /// Takes up the displacements of an accepted step.
    pub(crate) fn keep(
        &mut self,
        links: &Links<D>,
        scene: &Scene<D>,
        displacement: &[SVector<f64, D>],
    ) {
        if links.arms.is_empty() {
            return;
        }
        self.of.resize(scene.bodies().len(), Vec::new());
        for patch in (0..links.patches()).map(|patch| links.patch(patch)) {
            for member in patch.members {
                let arms = patch.arms(member);
                let id = scene.bodies()[member.body as usize].particles().id[member.index as usize];
                let of = &mut self.of[member.body as usize];
                if of.len() <= id.0 as usize {
                    of.resize(id.0 as usize + 1, SMatrix::zeros());
                }
                for (arm, &node) in arms.iter().zip(patch.nodes) {
                    let u = &displacement[links.active[node as usize] as usize];
                    of[id.0 as usize] += u * arm.transpose();
                }
            }
        }
    }

    /// What a restarted run needs: how many bodies, and of each how many particles and their `H`.
    pub(crate) fn memory(&self) -> Vec<f64> {
        let mut memory = vec![self.of.len() as f64];
        for body in &self.of {
            memory.push(body.len() as f64);
            memory.extend(body.iter().flat_map(|h| h.iter()));
        }
        memory
    }

    /// Takes back what [`memory`](Self::memory) gave, and leaves what follows it.
    pub(crate) fn recall<'m>(&mut self, memory: &'m [f64]) -> &'m [f64] {
        self.of.clear();
        let Some((&bodies, mut rest)) = memory.split_first() else {
            return memory;
        };
        for _ in 0..bodies as usize {
            let Some((&count, numbers)) = rest.split_first() else {
                return rest;
            };
            let (body, left) = numbers.split_at(numbers.len().min(count as usize * D * D));
            let matrices = body.chunks_exact(D * D);
            self.of
                .push(matrices.map(SMatrix::from_column_slice).collect());
            rest = left;
        }
        rest
    }
}

impl<const D: usize> Links<D> {
    /// Replaces the gradients by their means over the patches; `hourglass` is `θ` of (5).
    pub(crate) fn one_strain(
        &mut self,
        scene: &Scene<D>,
        deviations: &Deviations<D>,
        hourglass: f64,
    ) {
        let moduli: Vec<f64> = scene
            .bodies()
            .iter()
            .map(|body| body.law().density() * body.wave_speed().powi(2))
            .collect();
        self.arms.clear();
        self.arms.resize(self.links.len(), SVector::zeros());
        self.firmness.clear();
        for patch in 0..self.patches() {
            let members =
                self.member_starts[patch] as usize..self.member_starts[patch + 1] as usize;
            let count = (self.node_starts[patch + 1] - self.node_starts[patch]) as usize;
            let mut means = vec![SVector::<f64, D>::zeros(); count];
            let (mut weights, mut work, mut strains) = (0.0, 0.0, 0.0);
            for member in &self.members[members.clone()] {
                let particles = scene.bodies()[member.body as usize].particles();
                let row = member.index as usize;
                let f_old = &particles.motion.deformation_gradient[row];
                let weight = particles.volume[row] * f_old.determinant();
                weights += weight;
                for (mean, link) in means.iter_mut().zip(&self.links[member.links(count)]) {
                    *mean += link.gradient * weight;
                }
                let strain = spatial_strain(f_old);
                let stress = particles.motion.stress[row].to_matrix();
                work += weight * stress.dot(&strain);
                strains += weight * strain.norm_squared();
            }
            means.iter_mut().for_each(|mean| *mean /= weights);
            let modulus = self.members[members.clone()]
                .first()
                .map_or(0.0, |member| moduli[member.body as usize]);
            let secant = if strains > NO_STRAIN * weights {
                (work / strains).clamp(0.0, modulus)
            } else {
                modulus
            };
            self.firmness.push(hourglass * secant);
            for member in &self.members[members] {
                let particles = scene.bodies()[member.body as usize].particles();
                let row = member.index as usize;
                let f_old = &particles.motion.deformation_gradient[row];
                let h = deviations.at(member.body as usize, particles.id[row].0);
                let seen = SMatrix::<f64, D, D>::from_fn(|i, j| f_old[(i, j)]) + h;
                let places = member.links(count);
                let arms = self.arms[places.clone()].iter_mut();
                for ((arm, link), mean) in arms.zip(&mut self.links[places]).zip(&means) {
                    *arm = h.tr_mul(mean) + seen.tr_mul(&(link.gradient - mean));
                    link.gradient = *mean;
                }
            }
        }
    }

    /// Forces (4) on the nodes, and the work that they take from `u = 0` on, J.
    pub(crate) fn add_hourglass(
        &self,
        scene: &Scene<D>,
        deviations: &Deviations<D>,
        displacement: &[SVector<f64, D>],
        sums: &NodeSums<D>,
    ) -> f64 {
        let mut taken = 0.0;
        if self.arms.is_empty() {
            return taken;
        }
        for patch in (0..self.patches()).map(|patch| self.patch(patch)) {
            for member in patch.members {
                let particles = scene.bodies()[member.body as usize].particles();
                let row = member.index as usize;
                let stiffness = patch.firm.stiffness * particles.volume[row];
                let before = deviations.at(member.body as usize, particles.id[row].0);
                let mut h = before;
                let arms = patch.arms(member);
                for (arm, &node) in arms.iter().zip(patch.nodes) {
                    let u = &displacement[self.active[node as usize] as usize];
                    h += u * arm.transpose();
                }
                taken += 0.5 * stiffness * (h.norm_squared() - before.norm_squared());
                for (arm, &node) in arms.iter().zip(patch.nodes) {
                    let force = h * arm * -stiffness;
                    let mut numbers = [0.0; SUMS];
                    numbers[NodeSums::<D>::FORCE..NodeSums::<D>::FORCE + D]
                        .copy_from_slice(force.as_slice());
                    sums.add(self.active[node as usize] as usize, &numbers);
                }
            }
        }
        taken
    }
}

/// Almansi's strain, `½ (1 − F⁻ᵀ F⁻¹)`.
fn spatial_strain(f: &Matrix3<f64>) -> Matrix3<f64> {
    let inverse = f.try_inverse().unwrap_or_else(Matrix3::identity);
    (Matrix3::identity() - inverse.transpose() * inverse) * 0.5
}
