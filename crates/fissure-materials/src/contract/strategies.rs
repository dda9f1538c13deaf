//! Proptest strategies for tests of one's own: everything they give is valid by construction.

use std::f64::consts::TAU;

use fissure_tensor::{Band, Matrix3, Sym, Vector3, rotation};
use proptest::prelude::*;

use super::{Case, Step};
use crate::{Increment, Isotropic};

/// A positive number, uniform in the logarithm.
pub fn log_uniform(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// A unit vector, uniform on the sphere.
pub fn direction() -> impl Strategy<Value = Vector3<f64>> {
    (-1.0..1.0, 0.0..TAU).prop_map(|(z, angle): (f64, f64)| {
        let r = (1.0 - z * z).sqrt();
        Vector3::new(r * angle.cos(), r * angle.sin(), z)
    })
}

/// A rotation vector of any direction, up to half a turn.
pub fn turn() -> impl Strategy<Value = Vector3<f64>> {
    (direction(), 0.0..0.5 * TAU).prop_map(|(axis, angle)| axis * angle)
}

/// A strain of this norm with any Lode angle, mean and axes. Below 1, `1 + strain` is positive
/// definite.
pub fn strain(norm: impl Strategy<Value = f64>) -> impl Strategy<Value = Sym> {
    (norm, 0.0..TAU, -0.25 * TAU..0.25 * TAU, turn()).prop_map(|(norm, lode, slope, turn)| {
        let (mean, deviator) = slope.sin_cos();
        let [a, b, c] = [0.0, 1.0, 2.0].map(|i: f64| {
            mean / 3.0_f64.sqrt() + deviator * (2.0_f64 / 3.0).sqrt() * (lode - i * TAU / 3.0).cos()
        });
        (Sym::diagonal(a, b, c) * norm).congruence(&rotation(&turn, turn.norm()))
    })
}

/// An increment from one stretch to another, log-uniform in strain between 1e-12 and 1e-2, with a
/// rotation of its own at each end and a band between a micrometre and a metre.
pub fn increment() -> impl Strategy<Value = Increment> {
    let end = || {
        (strain(log_uniform(1e-12, 1e-2)), turn()).prop_map(|(strain, turn)| {
            rotation(&turn, turn.norm()) * (Matrix3::identity() + strain.to_matrix())
        })
    };
    (end(), end(), log_uniform(1e-6, 1.0)).prop_map(|(f_old, f_new, width)| Increment {
        f_old,
        band: Band::Uniform(width),
        ..Increment::to(f_new)
    })
}

/// A path of 1 to 8 steps from rest, with strains up to 8e-2 in all and rotations.
pub fn history() -> impl Strategy<Value = Case> {
    let step = (strain(log_uniform(1e-12, 1e-2)), turn());
    let step = step.prop_map(|(strain, spin)| Step { strain, spin });
    (
        prop::collection::vec(step, 1..=8),
        log_uniform(1e-6, 1.0),
        turn(),
        -40..40,
    )
        .prop_map(|(steps, width, turn, exponent)| Case {
            steps,
            band: Band::Uniform(width),
            turn,
            exponent,
        })
}

/// Isotropic constants inside their ranges: of the orders of foams to diamond.
pub fn isotropic() -> impl Strategy<Value = Isotropic> {
    (log_uniform(1.0, 1e5), log_uniform(1e3, 1e13), -0.99..0.499).prop_map(
        |(density, young, poisson)| Isotropic {
            density,
            young,
            poisson,
        },
    )
}
