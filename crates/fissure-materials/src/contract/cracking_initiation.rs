//! P18 initiation, and what objectivity asks of cracks.

use std::f64::consts::{FRAC_PI_2, TAU};

use fissure_tensor::{Sym, Vector3, rotation};

use super::{Case, Random, frames::perturbed, gauge::Gauge, runner::Property, subject::Subject};
use crate::crossing::crossing;
use crate::{Crack, Cracking, MaterialError, Scale};

/// No direction of a grid of 3° over the half sphere gives a larger failure function than the
/// law's maximum, the value is that of its normal, and in a step from the virgin material over
/// the surface a crack starts with a normal that attains the maximum of the stress shrunk back to
/// the surface: that at which it starts on the way. Bound: `1e-8 (1 + |value|)`.
pub(super) fn initiation<M: Cracking>() -> Property<M> {
    Property {
        name: "P18 initiation",
        hint: "Cracking::initiation, Cracking::failure_along and the update disagree about where \
               a crack starts",
        share: 1.0,
        draw: draw_strain,
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            maximum(subject, case, 3.0, &mut gauge);
            started(subject, case, &mut gauge)?;
            Ok(gauge)
        },
        must_apply: true,
    }
}

/// The first part of [`initiation`] on a grid of 0.25°, for 20 of the default 256 states.
pub(super) fn initiation_finely<M: Cracking>() -> Property<M> {
    Property {
        name: "P18 initiation on a 0.25° grid",
        hint: "The law's maximum of the failure function is not the largest",
        share: 20.0 / 256.0,
        draw: draw_strain,
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            maximum(subject, case, 0.25, &mut gauge);
            Ok(gauge)
        },
        must_apply: true,
    }
}

fn draw_strain<M: Cracking>(subject: &Subject<M>, random: &mut Random) -> Case {
    let size = subject.natural * random.log_uniform(0.3, 10.0);
    let strain = random.strain_direction(true) * size;
    Case::straight([strain], subject.draw_band(random))
}

/// The elastic stress of a case's strain, Pa.
fn stress<M: Cracking>(subject: &Subject<M>, case: &Case) -> Sym {
    let strain = case.points().last().map_or(Sym::ZERO, |(_, e)| *e);
    subject.modulus.apply(&strain)
}

fn maximum<M: Cracking>(subject: &Subject<M>, case: &Case, degrees: f64, gauge: &mut Gauge) {
    let (law, scale) = (subject.law, Scale::default());
    let stress = stress(subject, case);
    let found = law.initiation(&stress, &scale);
    gauge.require(
        found == law.initiation(&stress, &scale),
        "the same stress gave two directions",
    );
    let tolerance = 1e-8 * (1.0 + found.value.abs());
    let there = law.failure_along(&stress, &found.normal, &scale);
    gauge.check(
        there.map_or(f64::NAN, |value| (value - found.value).abs()),
        tolerance,
        "the value is not that of the normal",
    );
    let unit = (found.normal.norm() - 1.0).abs();
    gauge.check(unit, 1e-12, "the normal is not of unit length");
    let rows = (90.0 / degrees) as usize;
    let mut largest = f64::NEG_INFINITY;
    for row in 0..=rows {
        let (sin, cos) = (FRAC_PI_2 * row as f64 / rows as f64).sin_cos();
        for column in 0..4 * rows {
            let (y, x) = (TAU * column as f64 / (4 * rows) as f64).sin_cos();
            let direction = Vector3::new(sin * x, sin * y, cos);
            if let Some(value) = law.failure_along(&stress, &direction, &scale) {
                largest = largest.max(value);
            }
        }
    }
    gauge.check(
        largest - found.value,
        tolerance,
        "another direction has a larger failure function",
    );
}

fn started<M: Cracking>(
    subject: &Subject<M>,
    case: &Case,
    gauge: &mut Gauge,
) -> Result<(), MaterialError> {
    let (law, scale) = (subject.law, Scale::default());
    let gradients = case.gradients();
    let [_, f] = gradients.as_slice() else {
        return Ok(());
    };
    let Some(undamaged) = subject.undamaged(f, &case.band) else {
        return Ok(());
    };
    let f = subject.whole(f, &undamaged.state);
    let trial = law.driving_stress(&f, &undamaged.stress)?;
    let found = law.initiation(&trial, &scale);
    let responses = subject.drive(&gradients, &case.band, &scale)?;
    let cracks = responses.last().map(|r| law.cracks(&r.state));
    let cracks = cracks.unwrap_or_default();
    let tolerance = 1e-8 * (1.0 + found.value.abs());
    match cracks.first() {
        None => gauge.check(found.value, tolerance, "no crack started over the surface"),
        Some(crack) => {
            gauge.check(-found.value, tolerance, "a crack started below the surface");
            let beyond = |share: f64| law.initiation(&(trial * share), &scale).value;
            let ends = [0.0, 1.0];
            let [share, _] = crossing(ends, ends.map(beyond), beyond);
            let onset = trial * share;
            let value = law.failure_along(&onset, &crack.normal, &scale);
            gauge.check(
                value.map_or(f64::NAN, |value| {
                    law.initiation(&onset, &scale).value - value
                }),
                1e-8,
                "the crack's normal is not the maximising one",
            );
        }
    }
    Ok(())
}

/// Under the rotations of P9 the cracks stay what they are in the reference configuration: as
/// many, with the same normals up to sign, openings, strength and energy. Bound: `1e-9` of the
/// largest, and fifty times what a perturbation of `F` by round-off does; left out from where
/// that is over `1e-3` (repeated principal values).
pub(super) fn objectivity<M: Cracking>() -> Property<M> {
    Property {
        name: "P9 objectivity of cracks",
        hint: "Normals are kept in the reference configuration; a spatial one has to turn",
        share: 1.0,
        draw: |subject, random| {
            let mut case = subject.draw_path(random, false);
            case.band = fissure_tensor::Band::Uniform(case.band.max_width());
            case
        },
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            if !M::OBJECTIVE {
                return Ok(gauge);
            }
            let scale = Scale::default();
            let path = case.gradients();
            let twin: Vec<_> = path.iter().map(|f| perturbed(f, 1.0)).collect();
            let turned: Vec<_> = path
                .iter()
                .enumerate()
                .map(|(i, f)| rotation(&case.turn, case.turn.norm() * (1.0 + 0.7 * i as f64)) * f)
                .collect();
            let base = subject.drive(&path, &case.band, &scale)?;
            let twin = subject.drive(&twin, &case.band, &scale)?;
            let turned = subject.drive(&turned, &case.band, &scale)?;
            for ((a, b), c) in base.iter().zip(&twin).zip(&turned) {
                let [a, b, c] = [a, b, c].map(|r| subject.law.cracks(&r.state));
                let by_round_off = apart(&a, &b, subject.opening);
                if by_round_off > 1e-3 {
                    break;
                }
                if !a.is_empty() {
                    let bound = 1e-9 + 50.0 * by_round_off;
                    let difference = apart(&a, &c, subject.opening);
                    gauge.check(difference, bound, "the cracks differ between frames");
                }
            }
            Ok(gauge)
        },
        must_apply: M::OBJECTIVE,
    }
}

/// Largest difference between two lists of cracks, each quantity over its scale.
fn apart(a: &[Crack], b: &[Crack], opening: f64) -> f64 {
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    let differences = a.iter().zip(b).map(|(a, b)| {
        let normal = a.normal.cross(&b.normal).norm();
        normal
            .max((a.opening - b.opening).abs() / opening)
            .max((a.strength_ratio - b.strength_ratio).abs())
            .max((a.dissipated_fraction - b.dissipated_fraction).abs())
            .max(f64::from(u8::from(a.failed != b.failed)))
    });
    differences.fold(0.0, f64::max)
}
