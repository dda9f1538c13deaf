//! P11: the response is continuous in the end of the step.

use fissure_tensor::{Matrix3, Sym};

use super::{Case, gauge::Gauge, runner::Property, subject::Subject};
use crate::{Increment, Material, MaterialError};

/// The stress has no jump between two ends of a step from one old state, across initiation,
/// failure, closure and whatever else the law distinguishes.
///
/// The segment between the ends is divided, and the part over which the stress changes most is
/// followed through 34 halvings: what is then left of the change is a jump. Bound: `1e-5` of
/// stiffness times the segment (a slope of 10⁵ stiffnesses), plus `1e-13` of the stiffness. The
/// cracking battery adds the sharp bound on the slope. Laws that say they jump
/// ([`Material::continuous`]) are exempt.
pub(super) fn continuity<M: Material>() -> Property<M> {
    Property {
        name: "P11 continuity",
        hint: "Two branches of the update do not meet: compare their stresses at the switch",
        share: 1.0,
        draw: |subject, random| {
            let mut case = subject.draw_path(random, false);
            // Both ends leave from the state before the last step; the last is the segment.
            let size = case.max_strain();
            let spin = Default::default();
            let strain = random.strain_direction(false) * (0.5 * size);
            case.steps.push(super::Step { strain, spin });
            case
        },
        judge,
        must_apply: false,
    }
}

fn judge<M: Material>(subject: &Subject<M>, case: &Case) -> Result<Gauge, MaterialError> {
    let mut gauge = Gauge::default();
    if !subject.law.continuous() {
        return Ok(gauge);
    }
    let gradients = case.gradients();
    let [history @ .., from, to] = gradients.as_slice() else {
        return Ok(gauge);
    };
    let Some(last) = history.last() else {
        return Ok(gauge);
    };
    let responses = subject.drive(history, &case.band, &Default::default())?;
    let state = responses.last().map_or(subject.law.initial(), |r| r.state);
    let increment = subject.increment(*last, *from, &case.band);
    let jump = largest_jump(subject.law, &increment, &state, to)?;
    let segment = (to - from).norm();
    let bound = subject.stiffness * (1e-5 * segment + 1e-13);
    gauge.check(jump, bound, "the stress jumps, Pa");
    Ok(gauge)
}

/// What is left of the change of stress between the end of an increment and another one after
/// following the steepest part of the segment through 34 halvings, Pa.
pub(super) fn largest_jump<M: Material>(
    law: &M,
    increment: &Increment,
    state: &M::State,
    to: &Matrix3<f64>,
) -> Result<f64, MaterialError> {
    const PARTS: u32 = 16;
    let from = increment.f_new;
    let stress = |t: f64| -> Result<Sym, MaterialError> {
        let f = from + (to - from) * t;
        Ok(law.update(&increment.with_end(f), state)?.stress)
    };
    let (mut low, mut width) = (0.0, 1.0);
    let mut change = 0.0;
    // Sixteen parts once find a jump beside a smooth change; then halvings close in on it.
    for level in 0..31 {
        let parts = if level == 0 { PARTS } else { 2 };
        let part = width / f64::from(parts);
        let mut steepest = (low, -1.0);
        let mut before = stress(low)?;
        for index in 1..=parts {
            let here = stress(low + part * f64::from(index))?;
            let difference = (here - before).max_abs();
            if difference > steepest.1 || difference.is_nan() {
                steepest = (low + part * f64::from(index - 1), difference);
            }
            before = here;
        }
        (low, change) = steepest;
        width = part;
    }
    Ok(change)
}
