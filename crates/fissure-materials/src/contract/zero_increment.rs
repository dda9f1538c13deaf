//! P22 determinism and P1 zero increment.

use super::{gauge::Gauge, runner::Property, subject::Subject};
use crate::{Band, EIGHT, EightPoints, Material, MaterialError, Matrix3};

/// The same call gives the same bits, whatever was asked in between: the law holds nothing back.
/// Bound: equality. (Threads and restarts are the solvers' part of P22.)
pub(super) fn determinism<M: Material>() -> Property<M> {
    Property {
        name: "P22 determinism",
        hint: "A law is a pure function of the increment and the old state: look for interior \
               mutability, globals, clocks and unseeded hashing",
        share: 0.5,
        draw: |subject, random| subject.draw_path(random, true),
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            let gradients = case.gradients();
            let mut state = subject.law.initial();
            for pair in gradients.windows(2) {
                let increment = subject.increment(pair[0], pair[1], &case.band);
                let first = subject.law.update(&increment, &state)?;
                let tangent = subject.law.tangent(&increment, &state)?;
                subject
                    .law
                    .update(&subject.rest(), &subject.law.initial())?;
                let second = subject.law.update(&increment, &state)?;
                gauge.require(first == second, "the same call gave two answers");
                let again = subject.law.tangent(&increment, &state)?;
                gauge.require(tangent == again, "the same call gave two tangents");
                state = first.state;
            }
            by_eights(subject, &gradients, &case.band, &mut gauge)?;
            Ok(gauge)
        },
        must_apply: true,
    }
}

/// What a law answers for eight points at once is what it answers for each, to the last bit.
fn by_eights<M: Material>(
    subject: &Subject<M>,
    gradients: &[Matrix3<f64>],
    band: &Band,
    gauge: &mut Gauge,
) -> Result<(), MaterialError> {
    let at = |place: usize| gradients[place % gradients.len()];
    let scale = subject.increment(at(0), at(0), band).external.scale;
    let mut points = EightPoints::of(&at(0));
    points.stiffness = [scale.stiffness; EIGHT];
    points.strength = [scale.strength; EIGHT];
    for place in 0..EIGHT {
        points.set(place, &at(place));
    }
    let Some(eight) = subject.law.update_eight(&points) else {
        return Ok(());
    };
    for place in 0..EIGHT {
        let increment = subject.increment(at(place), at(place), band);
        let old = subject.law.without_history(&at(place));
        let one = subject.law.update(&increment, &old)?;
        let speed = subject.law.wave_speed(&at(place), &one.state, &scale);
        let same = one.stress == eight.stress(place)
            && (one.stored, speed) == (eight.stored[place], eight.wave_speed[place]);
        gauge.require(same, "eight at once are not what each is by itself");
        let quiet = one.dissipated == 0.0 && one.state == old;
        gauge.require(quiet, "a point of eight got a history");
    }
    Ok(())
}

/// A zero increment after any history leaves the state as it is, dissipates nothing and gives the
/// stress again. Bounds: the state exactly; the stress, which is recomputed from `F`, to
/// `1e-12` of stiffness times strain plus `1e-14` of the stiffness, since `F` itself is rounded.
/// Rate-independent laws only.
pub(super) fn zero_increment<M: Material>() -> Property<M> {
    Property {
        name: "P1 zero increment",
        hint: "The state must not creep by round-off when nothing moves: compare with the limit \
               with a slack, and recompute nothing that has not changed",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, true),
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            if M::RATE_DEPENDENT {
                return Ok(gauge);
            }
            let Some((increment, old)) = subject.last_step(case)? else {
                return Ok(gauge);
            };
            let before = subject.law.update(&increment, &old)?;
            let zero = subject.increment(increment.f_new, increment.f_new, &case.band);
            let after = subject.law.update(&zero, &before.state)?;
            gauge.require(after.state == before.state, "the state moved");
            let strain = case.max_strain();
            let bound = subject.stiffness * (1e-12 * strain + 1e-14);
            let change = (after.stress - before.stress).max_abs();
            gauge.check(change, bound, "the stress changed, Pa");
            let energy = bound * strain;
            gauge.check(after.dissipated.abs(), energy, "energy was dissipated");
            let stored = (after.stored - before.stored).abs();
            gauge.check(stored, energy, "the stored energy changed");
            Ok(gauge)
        },
        must_apply: !M::RATE_DEPENDENT,
    }
}

/// Without dissipation the stress depends on where the strain is, not on how it came there: a
/// detour over a second strain gives the same, and a closed loop gives rest again. Fixed
/// rotation, so that hypoelastic laws are held to it as well. Bounds: `1e-12` of stiffness times
/// strain plus `1e-14` of the stiffness; for laws that are not hyperelastic ten times the strain
/// squared on top.
pub(super) fn path_independence<M: Material>() -> Property<M> {
    Property {
        name: "P2 elastic path independence",
        hint: "An elastic law written in rates accumulates its own integration error; write it on \
               the total strain",
        share: 1.0,
        draw: |subject, random| {
            let mut case = subject.draw_path(random, true);
            let size = random.log_uniform(1e-12, subject.natural);
            let longest = case.max_strain();
            for step in &mut case.steps {
                step.spin.fill(0.0);
                step.strain = step.strain * (size / longest);
            }
            case
        },
        judge: judge_path_independence,
        must_apply: true,
    }
}

fn judge_path_independence<M: Material>(
    subject: &Subject<M>,
    case: &super::Case,
) -> Result<Gauge, MaterialError> {
    let mut gauge = Gauge::default();
    let gradients = case.gradients();
    let [first, .., end] = gradients.as_slice() else {
        return Ok(gauge);
    };
    let scale = Default::default();
    let mut loop_path = gradients.clone();
    loop_path.push(*first);
    let detour = subject.drive(&loop_path, &case.band, &scale)?;
    let direct = subject.drive(&[*first, *end], &case.band, &scale)?;
    if detour.iter().chain(&direct).any(|r| r.dissipated != 0.0) {
        return Ok(gauge);
    }
    let strain = case.max_strain();
    let mut bound = subject.stiffness * (1e-12 * strain + 1e-14);
    if !M::HYPERELASTIC {
        bound += 10.0 * subject.stiffness * strain * strain;
    }
    if let ([.., by_detour, back], [directly]) = (detour.as_slice(), direct.as_slice()) {
        let difference = (by_detour.stress - directly.stress).max_abs();
        gauge.check(difference, bound, "two paths gave two stresses, Pa");
        let left = (back.stress - subject.rest_stress).max_abs();
        gauge.check(left, bound, "a closed loop left a stress, Pa");
        let stored = (by_detour.stored - directly.stored).abs();
        let energy = bound * strain;
        gauge.check(stored, energy, "two paths stored different energies");
    }
    Ok(gauge)
}
