//! Newton's method with the load time as an unknown.
//!
//! With `τ` the load time, `v` the speeds of what is held and `h` the rate of the loads, an iteration solves
//! with one factorisation
//!
//! ```text
//! K a = R,    K b = h − K_held v,    u ← u + a + b δτ,    τ ← τ + δτ,
//! ```
//!
//! and `δτ` so that the equation of the control holds at every iterate:
//!
//! ```text
//! arc length     Σ m |u|²/Σ m = ℓ²                     [Crisfield 1981, cylindrical]
//! dissipation    Σ V ΔD(u) = ΔE                        [Gutierrez 2004; Verhoosel et al. 2009]
//! ```
//!
//! The first is a quadratic equation. Of its roots the one that leaves less unbalanced is taken
//! [Hellweg and Crisfield 1998]: the usual choice, the smaller angle with the last increment, turns back where a path
//! has a sharp corner, as that of a bar that snaps. Of two that leave nothing it is the one along the
//! last increment, but the later in load time if the last step dissipated energy: its branch has then ended. In the second
//! `ΔD` is what the laws say, whatever they are, so it is solved by bracketing along `b`, with
//! sweeps that take no tangent.

use fissure_grid::Shape;
use fissure_scene::NewtonStop;
use nalgebra::SVector;

use super::border::{reach, roots};
use super::trial::{Equilibrium, LEAST_DAMPING, Trial};
use crate::equilibrium::failure::Failure;

/// Probes of the dissipation over the size of the increment.
const PROBE: f64 = 1e-3;

/// What a step is to reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Goal {
    /// A length of the displacement increment, m.
    Length(f64),
    /// An energy dissipated, J.
    Energy(f64),
}

/// An iterate and the line on which the next one is sought.
struct Line<const D: usize> {
    /// `u + a`.
    displacement: Vec<SVector<f64, D>>,
    /// `b`, what is held included, m/s.
    direction: Vec<SVector<f64, D>>,
    load_step: f64,
}

/// Balances a trial that reaches a goal, from its present displacement and load time.
pub(super) fn follow<S: Shape<D>, const D: usize>(
    trial: &mut Trial<'_, S, D>,
    goal: Goal,
) -> Result<Equilibrium<D>, Failure> {
    trial.place_held()?;
    let start = trial.displacement.clone();
    let still = vec![SVector::zeros(); trial.displacement.len()];
    let masses = trial.active_masses();
    let jacobian = trial.jacobian(&masses);
    for iteration in 0.. {
        let loads = trial.loads(trial.load_step)?;
        let balance = trial.balance(&loads, true)?;
        let error = balance.error;
        trial.statistics.residuals.push(error);
        // The start need not reach the goal; every later iterate does.
        if iteration > 0 && balance.is_balanced && !trial.is_let_go(&balance)? {
            return Ok(trial.equilibrium(&balance, &loads, iteration));
        }
        trial.ended(iteration, error)?;
        let (rate, speeds) = (trial.load_rate(&loads)?, trial.held_speeds());
        let rights = [(balance.force, still.as_slice()), (rate, speeds.as_slice())];
        let (system, transfers) = (&mut *trial.system, &trial.transfers);
        let [correction, per_load] = system
            .correct(
                trial.scene,
                transfers,
                trial.tangents,
                jacobian,
                rights,
                LEAST_DAMPING,
            )
            .map_err(|_| Failure::at(NewtonStop::Linear, error))?;
        trial.statistics.negative_pivots = system.negative_pivots();
        let mut line = Line {
            displacement: trial.displacement.clone(),
            direction: speeds,
            load_step: trial.load_step,
        };
        let links = &trial.system.links;
        links.add(&correction, 1.0, &mut line.displacement);
        links.add(&per_load, 1.0, &mut line.direction);
        let change = match goal {
            Goal::Length(length) => sphere(trial, &line, &start, length)?,
            Goal::Energy(energy) => dissipation(trial, &line, energy)?,
        };
        let change = change.ok_or_else(|| Failure::at(NewtonStop::Control, error))?;
        trial.go(&line, change)?;
    }
    // Not reached: the loop has no end of its own.
    Err(Failure::at(NewtonStop::Iterations, f64::NAN))
}

impl<S: Shape<D>, const D: usize> Trial<'_, S, D> {
    /// Goes to a point of the line.
    fn go(&mut self, line: &Line<D>, change: f64) -> Result<(), Failure> {
        self.displacement.clone_from(&line.displacement);
        let nodes = self.displacement.iter_mut().zip(&line.direction);
        nodes.for_each(|(u, direction)| *u += direction * change);
        self.load_step = line.load_step + change;
        self.place_held()
    }
}

/// The change of load time that gives the increment its length; `None` where the line does not reach it.
/// `start` is the increment that the iteration began with.
fn sphere<S: Shape<D>, const D: usize>(
    trial: &mut Trial<'_, S, D>,
    line: &Line<D>,
    start: &[SVector<f64, D>],
    length: f64,
) -> Result<Option<f64>, Failure> {
    let square = trial.product(&line.direction, &line.direction);
    let half = trial.product(&line.displacement, &line.direction);
    let rest = trial.product(&line.displacement, &line.displacement) - length * length;
    let Some([late, early]) = roots(square, half, rest) else {
        return Ok(None);
    };
    let mut left = |change: f64| -> Result<f64, Failure> {
        trial.go(line, change)?;
        let loads = trial.loads(trial.load_step)?;
        Ok(trial.balance(&loads, false)?.error)
    };
    // A root that a law refuses leaves the most.
    let [after_late, after_early] =
        [late, early].map(|change| left(change).unwrap_or(f64::INFINITY));
    let nothing = trial.settings.tolerance;
    let chosen = if after_late <= nothing && after_early <= nothing {
        let along = trial.dissipated_before || trial.product(&line.direction, start) >= 0.0;
        if along { late } else { early }
    } else if after_late <= after_early {
        late
    } else {
        early
    };
    Ok(Some(chosen))
}

/// The change of load time with which the laws dissipate the energy; `None` where none does.
fn dissipation<S: Shape<D>, const D: usize>(
    trial: &mut Trial<'_, S, D>,
    line: &Line<D>,
    energy: f64,
) -> Result<Option<f64>, Failure> {
    let (way, slope) = (
        trial.length(&line.displacement),
        trial.length(&line.direction),
    );
    let probe = match way > 0.0 && slope > 0.0 {
        true => PROBE * way / slope,
        false => PROBE * trial.dt,
    };
    let mut dissipated = |change: f64| -> Result<f64, Failure> {
        trial.go(line, change)?;
        Ok(trial.strain(false)?.dissipated)
    };
    reach(&mut dissipated, energy, probe)
}
