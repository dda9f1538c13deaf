//! Parameters of the block and the cases that are run by default.

use fissure_study::{Overrides, Parameter, Permitted};

use crate::nairn::conjugate::StressMeasure;
use crate::nairn::numerics::Numerics;

pub(super) fn parameters() -> Vec<Parameter> {
    let positive = || Permitted::above(0.0);
    let mut parameters = vec![
        Parameter::choice(
            "field",
            "the factor on stiffness, strengths and toughnesses: particle by particle, or correlated",
            "uncorrelated",
            &["uncorrelated", "correlated"],
        )
        .sweep(["uncorrelated", "correlated"]),
    ];
    parameters.extend(Numerics::parameters(1e-3));
    if let Some(h) = parameters.iter_mut().find(|p| p.name == "h") {
        h.default = vec![1e-3.into(), 0.5e-3.into()];
    }
    parameters.extend([
        StressMeasure::parameter(),
        Parameter::count(
            "samples",
            "of each field and resolution",
            20,
            Permitted::counts(2..=100_000),
        ),
        Parameter::number(
            "alpha",
            "of the correlation exp(−α d^1.5)",
            "m^-1.5",
            2.108e4,
            positive(),
        ),
        Parameter::number(
            "deviation",
            "coefficient of variation of the factor",
            "1",
            0.1,
            Permitted::numbers(1e-4..=0.2),
        ),
        Parameter::number(
            "length",
            "of the block, along the load",
            "m",
            0.02,
            positive(),
        ),
        Parameter::number("width", "of the block", "m", 0.01, positive()),
        Parameter::number("young", "Young's modulus", "Pa", 1e9, positive()),
        Parameter::number(
            "poisson",
            "Poisson's ratio",
            "1",
            0.3,
            Permitted::between(-1.0, 0.5),
        ),
        Parameter::number("density", "mass density", "kg/m3", 1000.0, positive()),
        Parameter::number("strength", "in tension", "Pa", 10e6, positive()),
        Parameter::number("shear_strength", "in shear", "Pa", 4.5e6, positive()),
        Parameter::number("toughness", "in opening", "J/m2", 500.0, positive()),
        Parameter::number("shear_toughness", "in sliding", "J/m2", 1000.0, positive()),
        Parameter::number("speed", "of the pressing end", "m/s", 2.0, positive()),
        Parameter::number(
            "strain",
            "nominal, at the end of a run",
            "1",
            0.03,
            Permitted::numbers(1e-3..=0.5),
        ),
    ]);
    parameters
}

pub(super) fn default_cases(_settings: &Overrides, quick: bool) -> Vec<Overrides> {
    let all = Overrides::new();
    vec![if quick {
        all.set("samples", 4_u64)
            .set("strain", 0.013)
            .sweep("h", [2e-3, 1e-3])
    } else {
        all
    }]
}

/// The document's four resolutions and its number of samples.
pub(super) fn full_case() -> Overrides {
    Overrides::new()
        .sweep("h", [0.5e-3, 0.25e-3, 0.125e-3, 0.0625e-3])
        .set("samples", 200_u64)
}
