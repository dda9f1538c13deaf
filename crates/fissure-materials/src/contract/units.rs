//! P19: the result does not depend on the units.

use super::{gauge::Gauge, runner::Property, subject::Subject};
use crate::{Material, MaterialError, Response, Scale};

/// Another unit of stress or length by a power of two changes nothing but exponents: equality bit
/// for bit.
///
/// A law cannot be rebuilt in other units from outside, so the scales of
/// [`External`](crate::External) do it: stiffness, strength and toughness times 2ᵏ are another
/// unit of stress, and give 2ᵏ the stress and energies; toughness and band times 2ᵏ are another
/// unit of length, and give the same ones. A law that leaves the stiffness scale alone is not
/// judged. Exponents in ±40.
pub(super) fn units<M: Material>() -> Property<M> {
    Property {
        name: "P19 units",
        hint: "An absolute tolerance, or a parameter that External::scale does not reach, hides \
               in the law",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, true),
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            if !heeds_stiffness(subject)? {
                return Ok(gauge);
            }
            let factor = 2.0_f64.powi(case.exponent);
            let gradients = case.gradients();
            let base = subject.drive(&gradients, &case.band, &Scale::default())?;
            let stress_unit = Scale {
                stiffness: factor,
                strength: factor,
                toughness: factor,
            };
            let other = subject.drive(&gradients, &case.band, &stress_unit)?;
            gauge.require(
                same(&base, &other, factor),
                "another unit of stress gave another result",
            );
            let length_unit = Scale {
                toughness: factor,
                ..Scale::default()
            };
            let band = case.band.scaled(factor);
            let other = subject.drive(&gradients, &band, &length_unit)?;
            gauge.require(
                same(&base, &other, 1.0),
                "another unit of length gave another result",
            );
            Ok(gauge)
        },
        must_apply: false,
    }
}

/// Whether twice the stiffness changes the stress at all.
fn heeds_stiffness<M: Material>(subject: &Subject<M>) -> Result<bool, MaterialError> {
    let mut increment = subject.rest();
    increment.f_new.m11 += 1e-3 * subject.natural;
    let virgin = subject.law.initial();
    let once = subject.law.update(&increment, &virgin)?.stress;
    increment.external.scale.stiffness = 2.0;
    Ok(subject.law.update(&increment, &virgin)?.stress != once)
}

fn same<S>(base: &[Response<S>], other: &[Response<S>], factor: f64) -> bool {
    base.iter().zip(other).all(|(a, b)| {
        a.stress * factor == b.stress
            && a.stored * factor == b.stored
            && a.dissipated * factor == b.dissipated
    })
}
