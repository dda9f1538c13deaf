//! Parameters of the notched plate and the cases that are run by default.

use fissure_study::{Overrides, Parameter, Permitted};

use crate::nairn::conjugate::StressMeasure;
use crate::nairn::numerics::Numerics;

pub(super) fn parameters() -> Vec<Parameter> {
    let positive = || Permitted::above(0.0);
    let mut parameters = vec![Parameter::choice(
        "mode",
        "how the crack is modelled",
        "damage",
        &["damage"],
    )];
    parameters.extend(Numerics::parameters(1e-3));
    parameters.extend([
        StressMeasure::parameter(),
        Parameter::number("strength", "in tension", "Pa", 30e6, positive()),
        Parameter::number("toughness", "in opening", "J/m2", 600.0, positive()),
        Parameter::choice(
            "notch",
            "a cell row left out, or failed from the start",
            "gap",
            &["gap", "severed"],
        ),
        Parameter::number("young", "Young's modulus", "Pa", 2.5e9, positive()),
        Parameter::number(
            "poisson",
            "Poisson's ratio",
            "1",
            0.33,
            Permitted::between(-1.0, 0.5),
        ),
        Parameter::number("density", "mass density", "kg/m3", 1000.0, positive()),
        Parameter::number("width", "of the plate", "m", 0.05, positive()),
        Parameter::number("height", "of the plate", "m", 0.1, positive()),
        Parameter::number("crack", "length of the notch", "m", 0.025, positive()),
        Parameter::number("speed", "of each end", "m/s", 3.1623, positive()),
        Parameter::number("end", "of the run", "s", 1.1e-4, positive()),
    ]);
    parameters
}

pub(super) fn default_cases(settings: &Overrides, quick: bool) -> Vec<Overrides> {
    if quick {
        return vec![
            Overrides::new()
                .set("width", 0.02)
                .set("height", 0.04)
                .set("crack", 0.01)
                .set("end", 6e-5),
        ];
    }
    let mut cases = vec![Overrides::new()];
    let asked = ["strength", "toughness", "h", "band", "notch", "transfer"];
    if asked.iter().any(|name| settings.get(name).is_some()) {
        return cases;
    }
    let tough = |strength: f64| {
        Overrides::new()
            .set("strength", strength)
            .set("toughness", 2000.0)
            .set("end", 2e-4)
    };
    cases.push(Overrides::new().sweep("strength", [20e6, 40e6]));
    cases.extend([20e6, 30e6, 40e6].map(tough));
    cases.push(tough(30e6).set("band", "discretisation"));
    cases.push(Overrides::new().set("notch", "severed"));
    cases.push(Overrides::new().set("transfer", "flip"));
    cases.push(
        Overrides::new()
            .set("h", 0.5e-3)
            .sweep("toughness", [600.0, 750.0]),
    );
    cases
}
