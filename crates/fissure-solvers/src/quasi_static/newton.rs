//! Newton's method at a given load.

use fissure_grid::Shape;
use fissure_scene::NewtonStop;
use nalgebra::SVector;

use super::trial::{Equilibrium, LEAST_DAMPING, Trial};
use crate::equilibrium::failure::Failure;

/// What the damping may grow to in a step whose residual rises.
const MOST_DAMPING: f64 = 1e-1;

/// Balances a trial at its load time.
pub(super) fn balanced<S: Shape<D>, const D: usize>(
    trial: &mut Trial<'_, S, D>,
) -> Result<Equilibrium<D>, Failure> {
    let loads = trial.loads(trial.load_step)?;
    let mut held = trial.held_changes()?;
    let masses = trial.active_masses();
    let jacobian = trial.jacobian(&masses);
    let mut before: Vec<SVector<f64, D>> = Vec::new();
    let (mut last, mut damping) = (f64::INFINITY, LEAST_DAMPING);
    for iteration in 0.. {
        let balance = trial.balance(&loads, true)?;
        let error = balance.error;
        trial.statistics.residuals.push(error);
        let placed = iteration > 0 || held.iter().all(|change| change.amax() == 0.0);
        if placed && error <= trial.settings.tolerance {
            return Ok(trial.equilibrium(&balance, &loads, iteration));
        }
        trial.ended(iteration, error)?;
        // Where a crack is open the tangent is next to nothing, and a full step runs far into
        // the other side: go back and stiffen the system, as Levenberg and Marquardt do.
        if error > last && damping < MOST_DAMPING && !trial.faces.changed {
            damping = (damping * 1e2).clamp(1e-6, MOST_DAMPING);
            trial.displacement.clone_from(&before);
            continue;
        }
        if error < last {
            damping = (damping * 0.1).max(LEAST_DAMPING);
        }
        last = if placed { error } else { f64::INFINITY };
        before.clone_from(trial.displacement);
        let (system, transfers) = (&mut *trial.system, &trial.transfers);
        let rights = [(balance.force, held.as_slice())];
        let [correction] = system
            .correct(
                trial.scene,
                transfers,
                trial.tangents,
                jacobian,
                rights,
                damping,
            )
            .map_err(|_| Failure::at(NewtonStop::Linear, error))?;
        trial.statistics.negative_pivots = system.negative_pivots();
        system.links.add(&correction, 1.0, trial.displacement);
        for (u, change) in trial.displacement.iter_mut().zip(&mut held) {
            *u += *change;
            *change = SVector::zeros();
        }
    }
    // Not reached: the loop has no end of its own.
    Err(Failure::at(NewtonStop::Iterations, f64::NAN))
}
