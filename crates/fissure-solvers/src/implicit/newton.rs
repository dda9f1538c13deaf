//! Newton's method on the displacement increments of the nodes.
//!
//! The residual is `R(u) = (1 − s) f + s f'(u) − m a(u)` with the shares and accelerations of the scheme
//! [Sanchez 2010, eq. A.1.2, with the displacement in place of the momentum and over Δt], its derivative
//! `−(s K + c m)`. A correction that does not lower `|R|` is halved (line search); of iterative linear solvers
//! only the accuracy is asked that the residual's fall can use [Eisenstat and Walker 1996].

use fissure_grid::Shape;
use fissure_materials::Tangent;
use fissure_scene::{NewtonStop, Scene, SweepTotals};
use nalgebra::SVector;

use super::residual::Residual;
use super::scheme::{End, Scheme, Start};
use super::settings::ImplicitSettings;
use crate::constraints::Constraints;
use crate::equilibrium::choice::{LinearSolver, Preconditioning, Product};
use crate::equilibrium::descent::{LEAST_SHARE, falls};
use crate::equilibrium::failure::Failure;
use crate::equilibrium::statistics::StepStatistics;
use crate::equilibrium::stiffness::times;
use crate::equilibrium::system::{Jacobian, Multiply, NoCorrection, System};
use crate::linear::{Identity, Preconditioner};
use crate::nodes::NodeSums;
use crate::transfers::Transfers;

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
    /// What rounding leaves of the internal forces, N.
    pub round_off: f64,
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
            while share >= LEAST_SHARE {
                displacement.clone_from(&base);
                system.links.add(&correction, share, displacement);
                for (u, change) in displacement.iter_mut().zip(&held) {
                    *u += change;
                }
                let tried = self.residual(scene, system, sums, Some(&mut *tangents), displacement);
                // The first correction also moves what is held: its residual is no measure.
                let lowers = |new: &Residual| {
                    moving
                        || falls(new.size, now.size, share)
                        || new.within(self.settings.tolerance)
                };
                if let Some(new) = tried.ok().filter(|new| new.size.is_finite() && lowers(new)) {
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
}
