//! What a displacement leaves unbalanced in a step, and how that changes along a direction.

use fissure_grid::Shape;
use fissure_materials::Tangent;
use fissure_scene::{Scene, SolveError, SweepTotals};
use nalgebra::SVector;

use super::newton::Attempt;
use crate::checks::outside;
use crate::equilibrium::balance::{At, internal_forces, strain};
use crate::equilibrium::choice::{Iterative, LinearSolver, Product};
use crate::equilibrium::system::System;
use crate::linear::norm;
use crate::nodes::NodeSums;

/// Failure forces below this share of `m u c` are round-off.
const ROUND_OFF: f64 = 1e-14;

/// What a displacement leaves unbalanced.
pub(super) struct Residual {
    pub totals: SweepTotals,
    /// On every active node, component by component, N.
    pub force: Vec<f64>,
    /// Norm of what is not held of it, N.
    pub size: f64,
    /// What it is measured by, N.
    pub scale: f64,
    /// Norm below which it is round-off, N.
    floor: f64,
}

impl Residual {
    pub(super) fn relative(&self) -> f64 {
        let relative = self.size / if self.scale > 0.0 { self.scale } else { 1.0 };
        if self.scale.is_finite() {
            relative
        } else {
            f64::INFINITY
        }
    }

    pub(super) fn within(&self, tolerance: f64) -> bool {
        self.relative() <= tolerance || self.size <= self.floor
    }
}

impl<S: Shape<D>, const D: usize> Attempt<'_, S, D> {
    /// Strains the particles and sums what is left of the forces.
    pub(super) fn residual(
        &self,
        scene: &mut Scene<D>,
        system: &System<D>,
        sums: &mut NodeSums<D>,
        tangents: Option<&mut [Vec<Tangent>]>,
        displacement: &[SVector<f64, D>],
    ) -> Result<Residual, SolveError> {
        let differences = matches!(
            self.settings.linear,
            LinearSolver::Iterative(Iterative {
                product: Product::Differences,
                ..
            })
        );
        let tangents = if differences { None } else { tangents };
        let (band, dt) = (self.settings.band, self.dt);
        let totals = strain(
            scene,
            &self.transfers,
            displacement,
            band,
            dt,
            &system.links,
            tangents,
        )?;
        internal_forces(&self.transfers, scene, sums, At::End)
            .map_err(|(body, index)| outside(scene, body, index))?;
        let (start, end) = self.scheme.force_shares();
        let rate = self.scheme.inertia(dt);
        let active = &system.links.active;
        let mut force = Vec::with_capacity(D * active.len());
        let (mut internal, mut external, mut inertial, mut moved) = (0.0, 0.0, 0.0, 0.0);
        for &node in active {
            let node = node as usize;
            let inner = self.internal_start[node] * start + sums.internal_force(node) * end;
            let outer = self.external_start[node] * start + self.external_end[node] * end;
            let mass = self.masses[node];
            let inertia = self.end(node, &displacement[node]).balanced * mass;
            internal += inner.norm_squared();
            external += outer.norm_squared();
            inertial += inertia.norm_squared();
            moved += (displacement[node] * (mass * rate)).norm_squared();
            force.extend((inner + outer - inertia).iter());
        }
        let mut free = force.clone();
        system.freedoms.turn(&mut free);
        let scale = [internal, external, inertial].map(f64::sqrt);
        let largest = scale
            .into_iter()
            .fold(0.0, |a: f64, b| if b.is_nan() { b } else { a.max(b) });
        Ok(Residual {
            totals,
            force,
            size: norm(&free),
            scale: self.force_scale.max(largest),
            floor: self.round_off.max(ROUND_OFF * moved.sqrt()),
        })
    }

    /// The Jacobian times `x` as a difference of residuals [Sanchez 2010, eq. A.1.5].
    #[allow(clippy::too_many_arguments)] // A residual is made of all of them.
    pub(super) fn difference(
        &self,
        scene: &mut Scene<D>,
        system: &System<D>,
        sums: &mut NodeSums<D>,
        displacement: &[SVector<f64, D>],
        now: &Residual,
        x: &[f64],
        y: &mut [f64],
    ) -> Result<(), SolveError> {
        let square: f64 = x.iter().map(|c| c * c).sum();
        if square == 0.0 {
            y.fill(0.0);
            return Ok(());
        }
        let parts = system.links.active.iter().zip(x.chunks_exact(D));
        let along: f64 = parts
            .map(|(&node, x)| displacement[node as usize].dot(&SVector::from_column_slice(x)))
            .sum();
        let absolute = x.iter().copied().map(f64::abs).sum();
        let typical = self.transfers.grid.spacing();
        let length = difference_length(square, along, absolute, typical);
        let mut displaced = displacement.to_vec();
        system.links.add(x, length, &mut displaced);
        let then = self.residual(scene, system, sums, None, &displaced)?;
        for ((y, then), now) in y.iter_mut().zip(&then.force).zip(&now.force) {
            *y = (now - then) / length;
        }
        Ok(())
    }
}

/// How far along a direction residuals are differenced [Brown and Saad 1990, eq. 2.12], so that the change is neither lost in
/// rounding nor out of the linear range: `√ε max(|u·x|, ū |x|₁)/|x|²` from the `square` `|x|²`, `u·x` (`along`), `|x|₁`
/// (`absolute`) and a typical size `ū` of the unknowns.
fn difference_length(square: f64, along: f64, absolute: f64, typical: f64) -> f64 {
    f64::EPSILON.sqrt() / square * along.abs().max(typical * absolute)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a cubic the difference is good to half the digits, however long the direction, whatever the unit of the unknowns,
    /// at rest and far from it.
    #[test]
    fn differences_are_good_to_half_the_digits() {
        for unit in [1e-9, 1.0, 1e6] {
            for size in [1e-12, 1.0, 1e12] {
                for displaced in [0.0, 1.0, 1e3] {
                    let u = [0.3, -1.0, 0.7].map(|c| c * displaced * unit);
                    let x = [1.0, 0.2, -0.5].map(|c: f64| c * size);
                    let force = |u: [f64; 3]| u.map(|c| c + c * c * c / (unit * unit));
                    let dot = |a: [f64; 3], b: [f64; 3]| -> f64 {
                        a.iter().zip(&b).map(|(a, b)| a * b).sum()
                    };
                    let absolute = x.iter().copied().map(f64::abs).sum();
                    let length = difference_length(dot(x, x), dot(u, x), absolute, unit);
                    let ahead = std::array::from_fn(|k| u[k] + length * x[k]);
                    let (now, then) = (force(u), force(ahead));
                    for k in 0..3 {
                        let exact = (1.0 + 3.0 * (u[k] / unit).powi(2)) * x[k];
                        let found = (then[k] - now[k]) / length;
                        // Rounding takes more where the values are large beside the slope.
                        let bound = 2e-7 * (1.0 + displaced);
                        assert!(
                            (found / exact - 1.0).abs() <= bound,
                            "{unit} {size} {displaced}: {found} {exact}"
                        );
                    }
                }
            }
        }
    }
}
