//! P24: what a law has to refuse, and what it has to state.

use fissure_tensor::Matrix3;

use super::{gauge::Gauge, runner::Property, subject::Subject};
use crate::{Material, MaterialError};

/// A deformation gradient that is not finite, or does not preserve orientation, is a typed error
/// after any history and never a NaN; so it is for the tangent. An accepted one gives finite
/// numbers. The density is positive, and the wave speed at rest is not below `√(C/ρ)`, less `1e-6`,
/// for the stiffness `C` against uniaxial strain along the axes, since explicit steps rest on it.
///
/// The parameters of a law cannot be made invalid from outside: that `check` accepts the given
/// ones is the first thing asked, that it refuses others belongs into the law's own tests.
pub(super) fn validation<M: Material>() -> Property<M> {
    Property {
        name: "P24 validation",
        hint: "Refuse with MaterialError::Deformation unless det F is finite and > 0, comparing so \
               that NaN fails",
        share: 1.0,
        draw: |subject, random| {
            let mut case = subject.draw_path(random, true);
            // Which entry is spoilt, and with what.
            case.exponent = random.integer(0, 9 * 5 - 1) as i32;
            case
        },
        judge,
        must_apply: true,
    }
}

fn judge<M: Material>(subject: &Subject<M>, case: &super::Case) -> Result<Gauge, MaterialError> {
    let mut gauge = Gauge::default();
    let law = subject.law;
    let Some((increment, old)) = subject.last_step(case)? else {
        return Ok(gauge);
    };
    let good = law.update(&increment, &old)?;
    let finite = good.stress.is_finite() && good.stored.is_finite() && good.dissipated.is_finite();
    gauge.require(finite, "an accepted deformation gave numbers not finite");
    let finite = law.tangent(&increment, &old)?.is_finite();
    gauge.require(finite, "an accepted deformation gave a tangent not finite");

    let [entry, kind] = [case.exponent.rem_euclid(9), case.exponent / 9];
    let bad = spoilt(&increment.f_new, readable::<M>(entry as usize), kind);
    let bad = increment.with_end(bad);
    let accepted = law.update(&bad, &old).is_ok();
    gauge.require(
        !accepted,
        "update accepted a deformation gradient with a NaN, an infinity or det F ≤ 0",
    );
    let accepted = law.tangent(&bad, &old).is_ok();
    gauge.require(
        !accepted,
        "tangent accepted a deformation gradient with a NaN, an infinity or det F ≤ 0",
    );

    let density = law.density();
    gauge.require(
        density > 0.0 && density.is_finite(),
        "the density is not finite and > 0",
    );
    let rest = subject.rest();
    let speed = law.wave_speed(&rest.f_new, &law.initial(), &rest.external.scale);
    gauge.check(
        (subject.stiffness / density).sqrt(),
        speed * (1.0 + 1e-6),
        "the wave speed is below that of the stiffness, m/s",
    );
    gauge.require(speed.is_finite(), "the wave speed is not finite");
    Ok(gauge)
}

/// The entry itself, or one in the plane if the law reads no other.
fn readable<M: Material>(entry: usize) -> usize {
    const IN_PLANE: [usize; 4] = [0, 1, 3, 4];
    if M::PLANE { IN_PLANE[entry % 4] } else { entry }
}

/// Makes a deformation gradient one that has to be refused.
fn spoilt(f: &Matrix3<f64>, entry: usize, kind: i32) -> Matrix3<f64> {
    let mut bad = *f;
    match kind {
        0 => bad[entry] = f64::NAN,
        1 => bad[entry] = f64::INFINITY,
        2 => bad[entry] = f64::NEG_INFINITY,
        // Turned inside out, and flattened: the determinant is exactly zero.
        3 => bad.set_column(entry % 3, &(f.column(entry % 3) * -1.0)),
        _ => bad.set_column(entry % 3, &Matrix3::zeros().column(0)),
    }
    bad
}
