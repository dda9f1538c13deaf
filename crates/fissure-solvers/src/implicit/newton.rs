//! Newton's method on the displacement increments of the nodes.
//!
//! The residual is `R(u) = (1 − s) f + s f'(u) − m a(u)` with the shares and accelerations of the scheme
//! [Sanchez 2010, eq. A.1.2, with the displacement in place of the momentum and over Δt], its derivative
//! `−(s K + c m)`. A correction that does not lower `|R|` is halved (line search); of iterative linear solvers
//! only the accuracy is asked that the residual's fall can use [Eisenstat and Walker 1996].

use fissure_grid::Shape;
use fissure_materials::Tangent;
use fissure_scene::{NewtonStop, Scene, SolveError, SweepTotals};
use nalgebra::SVector;

use super::scheme::{End, Scheme, Start};
use super::settings::ImplicitSettings;
use crate::checks::outside;
use crate::constraints::Constraints;
use crate::equilibrium::balance::{At, internal_forces, strain};
use crate::equilibrium::choice::{Iterative, LinearSolver, Preconditioning, Product};
use crate::equilibrium::failure::Failure;
use crate::equilibrium::statistics::StepStatistics;
use crate::equilibrium::stiffness::times;
use crate::equilibrium::system::{Jacobian, Multiply, NoCorrection, System};
use crate::linear::{Identity, Preconditioner, norm};
use crate::nodes::NodeSums;
use crate::transfers::Transfers;

/// Most halvings of a correction.
const HALVINGS: usize = 8;
/// Share of the expected fall of the residual that a correction must bring (Armijo).
const ARMIJO: f64 = 1e-4;
/// Failure forces below this share of `m u c` are round-off.
const ROUND_OFF: f64 = 1e-14;

/// A step of given length from a given state.
pub(super) struct Attempt<'a, S, const D: usize> {
    pub transfers: Transfers<'a, S, D>,
    pub constraints: &'a Constraints<D>,
    /// Prescribed speeds at the start of the step, in the order of the held nodes.
    pub start_speeds: Vec<[f64; D]>,
    pub settings: &'a ImplicitSettings,
    pub scheme: Scheme,
    pub dt: f64,
    /// Masses, velocities and accelerations of all nodes.
    pub masses: Vec<f64>,
    pub starts: Vec<Start<D>>,
    /// Forces at the start and at the end, N.
    pub internal_start: Vec<SVector<f64, D>>,
    pub external_start: Vec<SVector<f64, D>>,
    pub external_end: Vec<SVector<f64, D>>,
    /// Largest force so far, N: what residuals are measured by.
    pub force_scale: f64,
}

/// What a displacement leaves unbalanced.
struct Residual {
    totals: SweepTotals,
    /// On every active node, component by component, N.
    force: Vec<f64>,
    /// Norm of what is not held of it, N.
    size: f64,
    /// What it is measured by, N.
    scale: f64,
    /// Norm below which it is round-off, N.
    floor: f64,
}

impl Residual {
    fn relative(&self) -> f64 {
        let relative = self.size / if self.scale > 0.0 { self.scale } else { 1.0 };
        if self.scale.is_finite() {
            relative
        } else {
            f64::INFINITY
        }
    }

    fn within(&self, tolerance: f64) -> bool {
        self.relative() <= tolerance || self.size <= self.floor
    }
}

/// A balanced end of the step; the trial motion of the scene holds it.
pub(super) struct Balanced {
    pub totals: SweepTotals,
    pub force_scale: f64,
    pub iterations: usize,
}

impl<S: Shape<D>, const D: usize> Attempt<'_, S, D> {
    /// Iterates from `displacement`, which holds the balanced one afterwards.
    pub(super) fn solve(
        &self,
        scene: &mut Scene<D>,
        system: &mut System<D>,
        sums: &mut NodeSums<D>,
        tangents: &mut [Vec<Tangent>],
        displacement: &mut Vec<SVector<f64, D>>,
        statistics: &mut StepStatistics,
    ) -> Result<Balanced, Failure> {
        let mut held = self.held_changes(displacement);
        let mut moving = held.iter().any(|change| change.amax() != 0.0);
        let evaluated = self.residual(scene, system, sums, Some(tangents), displacement);
        let mut now = evaluated.map_err(|error| Failure {
            stop: NewtonStop::Refused,
            residual: f64::NAN,
            refused: Some(error),
        })?;
        let (mut forcing, mut last) = (0.1, f64::INFINITY);
        for iteration in 0.. {
            let error = now.relative();
            statistics.residuals.push(error);
            let ended = |stop, refused| Failure {
                stop,
                residual: error,
                refused,
            };
            if !moving && now.within(self.settings.tolerance) {
                return Ok(Balanced {
                    totals: now.totals,
                    force_scale: now.scale,
                    iterations: iteration,
                });
            }
            if !error.is_finite() {
                return Err(ended(NewtonStop::NotFinite, None));
            }
            if iteration == self.settings.max_iterations {
                return Err(ended(NewtonStop::Iterations, None));
            }
            forcing = self.accuracy(forcing, error, last);
            last = error;
            let base = displacement.clone();
            let found = self.correction(
                scene, system, sums, tangents, &base, &now, &held, forcing, statistics,
            );
            let correction = found.map_err(|failure| match failure {
                NoCorrection::Linear => ended(NewtonStop::Linear, None),
                NoCorrection::Refused(error) => ended(NewtonStop::Refused, Some(error)),
            })?;
            let mut share = 1.0;
            let mut accepted = None;
            for _ in 0..=HALVINGS {
                displacement.clone_from(&base);
                system.links.add(&correction, share, displacement);
                for (u, change) in displacement.iter_mut().zip(&held) {
                    *u += change;
                }
                let tried = self.residual(scene, system, sums, Some(&mut *tangents), displacement);
                // The first correction also moves what is held: its residual is no measure.
                let falls = |new: &Residual| {
                    moving
                        || new.size <= (1.0 - ARMIJO * share) * now.size
                        || new.within(self.settings.tolerance)
                };
                if let Some(new) = tried.ok().filter(|new| new.size.is_finite() && falls(new)) {
                    accepted = Some(new);
                    break;
                }
                share *= 0.5;
            }
            now = accepted.ok_or_else(|| ended(NewtonStop::LineSearch, None))?;
            held.fill(SVector::zeros());
            moving = false;
        }
        // Not reached: the loop has no end of its own.
        Err(Failure {
            stop: NewtonStop::Iterations,
            residual: f64::NAN,
            refused: None,
        })
    }

    /// What held components have to change by.
    fn held_changes(&self, displacement: &[SVector<f64, D>]) -> Vec<SVector<f64, D>> {
        let mut held = vec![SVector::zeros(); displacement.len()];
        for (node, start) in self.constraints.held.iter().zip(&self.start_speeds) {
            for (k, start) in start.iter().enumerate().take(node.count) {
                let direction = &node.directions[k];
                let wanted = self.scheme.held(*start, node.speeds[k], self.dt);
                let change = wanted - direction.dot(&displacement[node.node]);
                held[node.node] += direction * change;
            }
        }
        held
    }

    /// Relative residual that the next linear solution has to reach.
    fn accuracy(&self, before: f64, error: f64, last: f64) -> f64 {
        if !last.is_finite() {
            return before;
        }
        let mut forcing = 0.9 * (error / last).powi(2);
        let safe = 0.9 * before * before;
        if safe > 0.1 {
            forcing = forcing.max(safe);
        }
        forcing
            .max(0.1 * self.settings.tolerance / error)
            .clamp(1e-10, 0.5)
    }

    /// A node at the end of the step.
    pub(super) fn end(&self, node: usize, displacement: &SVector<f64, D>) -> End<D> {
        let mut end = self.scheme.end(&self.starts[node], displacement, self.dt);
        if let Ok(found) = self
            .constraints
            .held
            .binary_search_by_key(&node, |held| held.node)
        {
            // What is held has the prescribed velocity and the mean acceleration.
            let held = &self.constraints.held[found];
            let Start { velocity, .. } = self.starts[node];
            for k in 0..held.count {
                let direction = &held.directions[k];
                let mean = (held.speeds[k] - direction.dot(&velocity)) / self.dt;
                end.velocity += direction * (held.speeds[k] - direction.dot(&end.velocity));
                end.acceleration += direction * (mean - direction.dot(&end.acceleration));
                end.balanced += direction * (mean - direction.dot(&end.balanced));
            }
        }
        end
    }

    /// Strains the particles and sums what is left of the forces.
    fn residual(
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
            floor: ROUND_OFF * moved.sqrt(),
        })
    }

    /// Newton's correction of the free components, active node by active node.
    #[allow(clippy::too_many_arguments)] // A correction is made of all of them.
    fn correction(
        &self,
        scene: &mut Scene<D>,
        system: &mut System<D>,
        sums: &mut NodeSums<D>,
        tangents: &[Vec<Tangent>],
        displacement: &[SVector<f64, D>],
        now: &Residual,
        held: &[SVector<f64, D>],
        accuracy: f64,
        statistics: &mut StepStatistics,
    ) -> Result<Vec<f64>, NoCorrection> {
        let active = system.links.active.iter();
        let masses: Vec<f64> = active.map(|&node| self.masses[node as usize]).collect();
        let jacobian = Jacobian {
            stiffness: self.scheme.force_shares().1,
            inertia: self.scheme.inertia(self.dt),
            masses: &masses,
        };
        let force = now.force.clone();
        let iterative = match self.settings.linear {
            LinearSolver::Direct => {
                let transfers = &self.transfers;
                let rights = [(force, held)];
                let [solved] = system.correct(scene, transfers, tangents, jacobian, rights, 0.0)?;
                statistics.negative_pivots = system.negative_pivots();
                return Ok(solved);
            }
            LinearSolver::Iterative(iterative) => iterative,
        };
        let product = iterative.product;
        let (correction, outcome) = if product == Product::Assembled {
            system
                .iterate_assembled(scene, tangents, jacobian, force, held, &iterative, accuracy)?
        } else {
            let preconditioner: Box<dyn Preconditioner> = match iterative.preconditioner {
                Preconditioning::NodeBlocks => {
                    Box::new(system.node_blocks(scene, tangents, jacobian)?)
                }
                Preconditioning::Mass => Box::new(jacobian.mass_preconditioner::<D>()),
                Preconditioning::None | Preconditioning::Incomplete => Box::new(Identity),
            };
            let system = &*system;
            let mut by_differences;
            let mut by_tangent;
            let product: &mut Multiply<'_> = if product == Product::Differences {
                by_differences = |x: &[f64], y: &mut [f64]| {
                    self.difference(scene, system, sums, displacement, now, x, y)
                };
                &mut by_differences
            } else {
                let scene = &*scene;
                by_tangent = move |x: &[f64], y: &mut [f64]| {
                    y.copy_from_slice(&times(&system.links, scene, tangents, x));
                    jacobian.complete_product::<D>(x, y);
                    Ok(())
                };
                &mut by_tangent
            };
            system.iterate(force, held, &iterative, accuracy, &*preconditioner, product)?
        };
        statistics.products.push(outcome.iterations);
        statistics.linear_stop = Some(outcome.stop);
        // What was reached may still lower the residual: the line search decides.
        Ok(correction)
    }

    /// The Jacobian times `x` as a difference of residuals [Sanchez 2010, eq. A.1.5].
    #[allow(clippy::too_many_arguments)] // A residual is made of all of them.
    fn difference(
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
