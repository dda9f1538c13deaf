//! Parameters of the coating and the cases that are run by default.

use fissure_study::{Overrides, Parameter, Permitted};

use crate::nairn::conjugate::StressMeasure;
use crate::nairn::numerics::Numerics;

/// Runs whose mean is compared: the places of the cracks are chance.
const SEEDS: u64 = 8;

pub(super) fn parameters() -> Vec<Parameter> {
    let positive = || Permitted::above(0.0);
    let mut parameters = Numerics::parameters(1e-3);
    parameters.extend([
        StressMeasure::parameter(),
        Parameter::number("length", "of the specimen", "m", 0.2, positive()),
        Parameter::number("substrate", "its thickness", "m", 0.01, positive()),
        Parameter::number("coating", "its thickness", "m", 2e-3, positive()),
        Parameter::number("substrate_young", "Young's modulus", "Pa", 1e9, positive()),
        Parameter::number("coating_young", "Young's modulus", "Pa", 1e10, positive()),
        Parameter::number(
            "poisson",
            "Poisson's ratio of both",
            "1",
            0.33,
            Permitted::between(-1.0, 0.5),
        ),
        Parameter::number(
            "density",
            "mass density of both",
            "kg/m3",
            1000.0,
            positive(),
        ),
        Parameter::number("strength", "of the coating", "Pa", 1e7, positive()),
        Parameter::number("toughness", "of the coating", "J/m2", 100.0, positive()),
        Parameter::number("speed", "of the right grip", "m/s", 4.0, positive()),
        Parameter::number(
            "strain",
            "nominal, at the end of the run",
            "1",
            0.025,
            Permitted::numbers(1e-4..=0.2),
        ),
        Parameter::number(
            "jitter",
            "coefficient of variation of the strengths, particle by particle",
            "1",
            1e-5,
            Permitted::numbers(0.0..=0.3),
        ),
        Parameter::count(
            "seed",
            "of the jitter",
            1,
            Permitted::counts(0..=u64::from(u32::MAX)),
        ),
        Parameter::number(
            "ends",
            "cracks nearer to a grip are not counted",
            "m",
            4e-3,
            Permitted::at_least(0.0),
        ),
    ]);
    parameters
}

pub(super) fn default_cases(settings: &Overrides, quick: bool) -> Vec<Overrides> {
    if quick {
        return vec![
            Overrides::new()
                .set("length", 0.04)
                .set("strain", 0.012)
                .sweep("seed", 1..=2_u64),
        ];
    }
    let mut cases = vec![Overrides::new().sweep("seed", 1..=SEEDS)];
    let names = ["transfer", "order", "seed", "band"];
    if names.iter().any(|name| settings.get(name).is_some()) {
        return cases;
    }
    for order in [1_u64, 3] {
        cases.push(Overrides::new().set("order", order));
    }
    cases.push(Overrides::new().set("transfer", "fmpm"));
    cases.push(
        Overrides::new()
            .sweep("transfer", ["flip", "apic"])
            .set("order", 1_u64),
    );
    cases
}
