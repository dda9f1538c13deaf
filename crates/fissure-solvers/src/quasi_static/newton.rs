//! Newton's method at a given load.

use fissure_grid::Shape;
use fissure_scene::NewtonStop;
use nalgebra::SVector;

use super::settings::Safeguard;
use super::trial::{Balance, Equilibrium, LEAST_DAMPING, Trial};
use crate::equilibrium::descent::{LEAST_SHARE, falls};
use crate::equilibrium::failure::Failure;

/// What the damping may grow to in a step whose residual rises.
const MOST_DAMPING: f64 = 1e-1;

/// The correction that led to the present iterate.
struct Stride<const D: usize> {
    before: Vec<SVector<f64, D>>,
    correction: Vec<f64>,
    share: f64,
    /// Relative residual before it, infinite if what is held was not in place yet.
    error: f64,
    damping: f64,
}

/// Balances a trial at its load time.
pub(super) fn balanced<S: Shape<D>, const D: usize>(
    trial: &mut Trial<'_, S, D>,
) -> Result<Equilibrium<D>, Failure> {
    let loads = trial.loads(trial.load_step)?;
    let mut held = trial.held_changes()?;
    let masses = trial.active_masses();
    let jacobian = trial.jacobian(&masses);
    let mut stride = Stride {
        before: Vec::new(),
        correction: Vec::new(),
        share: 1.0,
        error: f64::INFINITY,
        damping: LEAST_DAMPING,
    };
    for iteration in 0.. {
        let tried = trial.balance(&loads, true);
        if let Ok(balance) = &tried {
            trial.statistics.residuals.push(balance.error);
            let placed = iteration > 0 || held.iter().all(|change| change.amax() == 0.0);
            if placed && balance.is_balanced {
                if trial.is_let_go(balance)? {
                    stride.error = f64::INFINITY;
                    continue;
                }
                return Ok(trial.equilibrium(balance, &loads, iteration));
            }
            trial.ended(iteration, balance.error)?;
        }
        if stride.is_taken_back(trial, &tried)? {
            continue;
        }
        let Balance { error, force, .. } = tried?;
        if error < stride.error {
            stride.damping = (stride.damping * 0.1).max(LEAST_DAMPING);
        }
        let (system, transfers) = (&mut *trial.system, &trial.transfers);
        let [correction] = system
            .correct(
                trial.scene,
                transfers,
                trial.tangents,
                jacobian,
                [(force, held.as_slice())],
                stride.damping,
            )
            .map_err(|_| Failure::at(NewtonStop::Linear, error))?;
        trial.statistics.negative_pivots = system.negative_pivots();
        // The first correction also moves what is held: the residual before it is no measure.
        let in_place = held.iter().all(|change| change.amax() == 0.0);
        stride.error = if in_place { error } else { f64::INFINITY };
        for (u, change) in trial.displacement.iter_mut().zip(&mut held) {
            *u += *change;
            *change = SVector::zeros();
        }
        stride.before.clone_from(trial.displacement);
        (stride.correction, stride.share) = (correction, 1.0);
        stride.take(trial);
    }
    // Not reached: the loop has no end of its own.
    Err(Failure::at(NewtonStop::Iterations, f64::NAN))
}

impl<const D: usize> Stride<D> {
    /// Moves the trial by the share of the correction.
    fn take<S: Shape<D>>(&self, trial: &mut Trial<'_, S, D>) {
        trial.displacement.clone_from(&self.before);
        let links = &trial.system.links;
        links.add(&self.correction, self.share, trial.displacement);
    }

    /// Whether the trial was sent back, to a shorter stride or to a stiffer system, for what the stride led to.
    fn is_taken_back<S: Shape<D>>(
        &mut self,
        trial: &mut Trial<'_, S, D>,
        tried: &Result<Balance, Failure>,
    ) -> Result<bool, Failure> {
        // Residuals with other faces in touch are not to be compared.
        if trial.faces.changed {
            return Ok(false);
        }
        match (trial.settings.safeguard, tried) {
            (Safeguard::LineSearch, Ok(balance))
                if !falls(balance.error, self.error, self.share) =>
            {
                if self.share <= LEAST_SHARE {
                    return Err(Failure::at(NewtonStop::LineSearch, balance.error));
                }
            }
            // A law that refuses leaves the most; the first state is not a stride's.
            (Safeguard::LineSearch, Err(_))
                if !self.before.is_empty() && self.share > LEAST_SHARE => {}
            // Where a crack is open the tangent is next to nothing, and a full step runs far into
            // the other side: go back and stiffen the system, as Levenberg and Marquardt do.
            (Safeguard::Stiffening, Ok(balance))
                if balance.error > self.error && self.damping < MOST_DAMPING =>
            {
                self.damping = (self.damping * 1e2).clamp(1e-6, MOST_DAMPING);
                self.share = 0.0;
            }
            _ => return Ok(false),
        }
        self.share *= 0.5;
        self.take(trial);
        Ok(true)
    }
}
