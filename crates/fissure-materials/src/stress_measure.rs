//! How Cauchy's stress follows from the stress `T` that a law gives for Biot's strain `E = U − 1`.
//!
//! - [`Conjugate`]: that which does the work `T : dE` ([`Biot::cauchy`]);
//! - [`Turned`]: `R·T·Rᵀ` [Nairn 2017, app. II], which leaves out the factors of stretch between the two.

use fissure_tensor::{Matrix3, Sym, Tangent};

use crate::Biot;

/// One of the two, as a type: which it is costs nothing in an update.
///
/// Named by laws that can be had in both; not to be implemented outside.
pub trait StressMeasure {
    /// Cauchy's stress, Pa, from `T` and the kinematics it was found for.
    fn cauchy(kinematics: &Biot, biot_stress: &Sym) -> Sym;

    /// The same for an isotropic law on the left stretch `V = 1 + strain`, of which `T` has the axes; `dilation` is
    /// `det F − 1`.
    fn cauchy_on_left(biot_stress: &Sym, strain: &Sym, dilation: f64) -> Sym;

    /// The spatial tangent from the rate of `T`, given the rates of strain and rotation.
    fn tangent(
        kinematics: &Biot,
        biot_stress: &Sym,
        rate: impl Fn(&Sym, &Matrix3<f64>) -> Sym,
    ) -> Tangent;

    /// A bound of the wave speed, m/s, from that at rest and the longest stretch.
    fn wave_speed(at_rest: f64, longest_stretch: f64) -> f64;
}

/// Cauchy's stress does the work `T : dE`.
#[derive(Clone, Copy, Debug)]
pub struct Conjugate;

/// Cauchy's stress is `R·T·Rᵀ`.
#[derive(Clone, Copy, Debug)]
pub struct Turned;

impl StressMeasure for Conjugate {
    #[inline(always)]
    fn cauchy(kinematics: &Biot, biot_stress: &Sym) -> Sym {
        kinematics.cauchy(biot_stress)
    }

    /// `V·T/J`, since `V` and `T` commute.
    #[inline(always)]
    fn cauchy_on_left(biot_stress: &Sym, strain: &Sym, dilation: f64) -> Sym {
        (*biot_stress + strain.commuting_product(biot_stress)) * (1.0 / (1.0 + dilation))
    }

    fn tangent(
        kinematics: &Biot,
        biot_stress: &Sym,
        rate: impl Fn(&Sym, &Matrix3<f64>) -> Sym,
    ) -> Tangent {
        kinematics.conjugate_tangent(biot_stress, rate)
    }

    #[inline(always)]
    fn wave_speed(at_rest: f64, longest_stretch: f64) -> f64 {
        at_rest * longest_stretch
    }
}

impl StressMeasure for Turned {
    #[inline(always)]
    fn cauchy(kinematics: &Biot, biot_stress: &Sym) -> Sym {
        kinematics.turned(biot_stress)
    }

    /// `R·T(U)·Rᵀ = T(V)`.
    #[inline(always)]
    fn cauchy_on_left(biot_stress: &Sym, _strain: &Sym, _dilation: f64) -> Sym {
        *biot_stress
    }

    fn tangent(
        kinematics: &Biot,
        biot_stress: &Sym,
        rate: impl Fn(&Sym, &Matrix3<f64>) -> Sym,
    ) -> Tangent {
        kinematics.turned_tangent(biot_stress, rate)
    }

    /// The nominal stress is `T` times the change of the area it acts on: a second factor of the stretch.
    #[inline(always)]
    fn wave_speed(at_rest: f64, longest_stretch: f64) -> f64 {
        at_rest * longest_stretch * longest_stretch
    }
}
