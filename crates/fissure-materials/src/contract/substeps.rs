//! P12 sub-step convergence and P20 isoerror: what a step loses against many.

use fissure_tensor::{Matrix3, Sym};

use super::{Case, gauge::Gauge, runner::Property, subject::Subject};
use crate::{Increment, Material, MaterialError};

/// A proportional path from rest in 1, 2, 4, … 64 steps converges: either nothing changes, or the
/// last change is at most 0.6 of the largest before the last three (0.6 and not 0.5, since a
/// kink's place within a step varies). Where that fails 1024 steps decide: a law that bends near
/// the end of the path has nothing to resolve before. A rate-independent law gives the same bits
/// for twice the time. Round-off allowed: `1e-9` of stiffness times strain plus `1e-13` of the
/// stiffness.
pub(super) fn convergence<M: Material>() -> Property<M> {
    Property {
        name: "P12 sub-step convergence",
        hint: "The result must settle as the step is divided; a law that counts steps or adds a \
               fixed error per step does not",
        share: 0.5,
        draw: |subject, random| {
            let path = subject.draw_path(random, false);
            Case::straight([path.steps[0].strain], path.band)
        },
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            let Some(step) = case.steps.first() else {
                return Ok(gauge);
            };
            let strain = step.strain;
            let whole = subject.increment(Matrix3::identity(), end(&strain), &case.band);
            let virgin = subject.law.initial();
            let round_off = subject.stiffness * (1e-9 * strain.norm() + 1e-13);
            let (mut last, mut bound) = settling(subject, &whole, 6)?;
            if !(last <= bound + round_off) {
                (last, bound) = settling(subject, &whole, 10)?;
            }
            gauge.check(
                last,
                bound + round_off,
                "twice the steps change as much as few steps do, Pa",
            );
            if !M::RATE_DEPENDENT {
                let slow = Increment { dt: 2.0, ..whole };
                let same =
                    subject.law.update(&slow, &virgin)? == subject.law.update(&whole, &virgin)?;
                gauge.require(same, "the answer depends on the time the step takes");
            }
            Ok(gauge)
        },
        must_apply: true,
    }
}

/// The change of stress from `2^(powers − 1)` to `2^powers` steps, and what it may be by the changes
/// before.
fn settling<M: Material>(
    subject: &Subject<M>,
    whole: &Increment,
    powers: usize,
) -> Result<(f64, f64), MaterialError> {
    let virgin = subject.law.initial();
    let mut stresses = Vec::new();
    for power in 0..=powers {
        stresses.push(divided(subject, whole, &virgin, 1 << power)?);
    }
    let changes = stresses.windows(2).map(|two| (two[1] - two[0]).max_abs());
    let changes: Vec<f64> = changes.collect();
    let largest = changes[..powers - 3].iter().copied().fold(0.0, f64::max);
    Ok((changes[powers - 1], 0.6 * largest))
}

/// One step against many (1000 by default) over increments `(Δε_nn, Δε_nt)` of a grid over ±5
/// natural strains in halves, from rest and from a stretch of two natural strains along `n`, `n`
/// and `t` being the first two axes. Measured: the change of stress over stiffness times
/// increment, reported in [`Summary::step_error`](super::Summary::step_error). Bound:
/// [`Material::STEP_ERROR`]. Rate-independent laws only.
pub(super) fn isoerror<M: Material>() -> Property<M> {
    Property {
        name: "P20 isoerror",
        hint: "The error of one step is over what the law states in Material::STEP_ERROR",
        share: 1.0,
        draw: |subject, random| {
            let half = |random: &mut super::Random| {
                (random.integer(0, 20) as f64 - 10.0) * 0.5 * subject.natural
            };
            let (normal, shear) = (half(random), half(random));
            let increment = Sym::new(normal, 0.0, 0.0, 0.0, 0.0, shear);
            let level = if random.chance(0.5) { 2.0 } else { 0.0 };
            let stretch = Sym::diagonal(level * subject.natural, 0.0, 0.0);
            let band = subject.draw_band(random);
            Case::straight([stretch, increment], band)
        },
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            let size = case.steps.last().map_or(0.0, |step| step.strain.norm());
            if M::RATE_DEPENDENT || size == 0.0 {
                return Ok(gauge);
            }
            let Some((whole, old)) = subject.last_step(case)? else {
                return Ok(gauge);
            };
            let one = divided(subject, &whole, &old, 1)?;
            let many = divided(subject, &whole, &old, subject.isoerror_steps)?;
            let unit = subject.stiffness * size;
            let round_off = 1e-9 + 1e-13 / size;
            let error = (one - many).max_abs() / unit;
            gauge.step_error = error;
            gauge.check(
                error,
                M::STEP_ERROR + round_off,
                "one step differs from many, over stiffness times increment",
            );
            Ok(gauge)
        },
        must_apply: !M::RATE_DEPENDENT,
    }
}

fn end(strain: &Sym) -> Matrix3<f64> {
    Matrix3::identity() + strain.to_matrix()
}

/// Stress at the end of an increment taken in equal parts.
fn divided<M: Material>(
    subject: &Subject<M>,
    whole: &Increment,
    old: &M::State,
    parts: usize,
) -> Result<Sym, MaterialError> {
    let mut state = *old;
    let mut stress = Sym::ZERO;
    let mut f_old = whole.f_old;
    for part in 1..=parts {
        let fraction = part as f64 / parts as f64;
        // The end itself, so that one part is the whole bit for bit.
        let f_new = if part == parts {
            whole.f_new
        } else {
            whole.f_old + (whole.f_new - whole.f_old) * fraction
        };
        let mut increment = subject.increment(f_old, f_new, &whole.band);
        increment.dt = whole.dt / parts as f64;
        let response = subject.law.update(&increment, &state)?;
        (stress, state, f_old) = (response.stress, response.state, f_new);
    }
    Ok(stress)
}
