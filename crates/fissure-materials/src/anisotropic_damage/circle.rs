//! The return of the shear traction to a circle as the authors' code steps it.
//!
//! Trial with the secant modulus, `τ' = τ + (1−d) G Δγ`; its excess over the strength as a strain,
//! `Δγ² = (|τ'| − τ_t f(δ))/((1−d) G)`; growth `δ̇` from `Δγ² = δ̇ + γ_t0 (f(δ+δ̇) − f(δ))` (eq. 26); and
//! the return along the *old* traction, `τ ← τ' − G (δ̇ − d Δγ²) τ/|τ|`. That is right to first order in the
//! turn of the step. Where the trial has turned further from the old traction than 30°, or there is
//! none, the return is along the trial itself.

use super::ellipse::Sheared;
use super::mode::ModeAt;
use crate::Softening;
use crate::softening::opening;

/// Cosine of the largest turn within a step that is returned along the old traction.
const SMALL_TURN: f64 = 0.866;

/// Moves the shear by an increment of the engineering strains; the first softening is the only one.
pub(super) fn moved<S: Softening>(
    mode: &ModeAt<'_, S>,
    start: &Sheared,
    increment: [f64; 2],
) -> Sheared {
    let secant = mode.integrity(start.softened[0]);
    let trial = [0, 1].map(|i| start.traction[i] + secant * increment[i]);
    let size = trial[0].hypot(trial[1]);
    let initiation = mode.strength / mode.modulus;
    let limit = initiation * mode.softening.ratio(start.softened[0]);
    let mut next = *start;
    next.traction = trial;
    if size <= limit * (1.0 + 1e-12) {
        return next;
    }
    if secant == 0.0 {
        next.traction = [0.0; 2];
        return next;
    }
    let strain = (size - limit) / secant;
    // The strain of a single mode on its curve that has grown by as much.
    let load = (strain + limit) / initiation + mode.stiffness * start.softened[0];
    let softened = opening(mode.softening, load, mode.stiffness, start.softened[0]);
    next.softened[0] = softened.min(mode.softening.critical());
    let growth = (softened - start.softened[0]) * mode.stiffness * initiation;
    let back = growth - (1.0 - secant) * strain;
    let old = start.traction[0].hypot(start.traction[1]);
    let along = start.traction[0] * trial[0] + start.traction[1] * trial[1];
    next.traction = if along >= SMALL_TURN * old * size && old > 0.5 * limit {
        [0, 1].map(|i| trial[i] - back * start.traction[i] / old)
    } else {
        let left = initiation * mode.softening.ratio(next.softened[0]);
        trial.map(|x| x * (left / size))
    };
    next
}
