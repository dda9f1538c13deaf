//! Parameters that many laws share, and what is made of them.

use fissure_materials::*;

use crate::parameter::{LawParameter, Values};
pub(super) use crate::parameter::{density, poisson, strength, toughness, young};

/// Those of [`isotropic`], of concrete.
pub(super) const ELASTIC: &[LawParameter] = &[density(2350.0), young(24.9e9), poisson(0.18)];

/// Elastic constants and density.
pub(super) fn isotropic(values: &Values<'_>) -> Isotropic {
    Isotropic {
        density: values.number("density"),
        young: values.number("young"),
        poisson: values.number("poisson"),
    }
}

/// Coefficient of friction of crack faces.
pub(super) const FRICTION: LawParameter = LawParameter::not_negative(
    "friction",
    "coefficient of friction of the faces of a failed crack",
    "1",
    0.0,
);
