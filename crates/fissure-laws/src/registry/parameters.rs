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

/// Strength of a plane in shear.
pub(super) const fn shear_strength(default: f64) -> LawParameter {
    LawParameter::positive("shear_strength", "strength in sliding", "Pa", default)
}

/// Opening of the kink of bilinear softening.
pub(super) const KINK_OPENING: LawParameter = LawParameter::positive(
    "kink_opening",
    "opening of the kink over toughness / strength",
    "1",
    0.8,
);

/// Traction there.
pub(super) const KINK_RATIO: LawParameter = LawParameter::positive(
    "kink_ratio",
    "traction at the kink over strength",
    "1",
    1.0 / 3.0,
);

/// Exponent of power-law softening.
pub(super) const EXPONENT: LawParameter =
    LawParameter::positive("exponent", "of the softening curve; at least 1", "1", 2.0);

/// Decay of the second of two exponentials.
pub(super) const DECAY_RATIO: LawParameter = LawParameter::positive(
    "decay_ratio",
    "of the second exponential to the first; above 1",
    "1",
    4.0,
);

/// Its weight.
pub(super) const WEIGHT: LawParameter = LawParameter::number(
    "weight",
    "of the second exponential, taken away from the first",
    "1",
    0.2,
);

/// A softening curve by name, for laws that take any; its own parameters stand beside it.
pub(super) const CURVE: LawParameter = LawParameter::choice(
    "curve",
    "softening curve, with the parameters of its kind",
    "linear",
    &[
        "linear",
        "bilinear",
        "power-law",
        "exponential",
        "cubic-step",
        "double-exponential",
    ],
);

/// Coefficient of friction of crack faces.
pub(super) const FRICTION: LawParameter = LawParameter::not_negative(
    "friction",
    "coefficient of friction of the faces of a failed crack",
    "1",
    0.0,
);
