//! Parameters of the notched plate and the cases that are run by default.

use fissure_study::{Overrides, Parameter, Permitted};

use crate::nairn::conjugate::StressMeasure;
use crate::nairn::numerics::Numerics;
use crate::nairn::plate::Plate;
use crate::nairn::tips::Tips;

pub(super) fn parameters() -> Vec<Parameter> {
    let mut parameters = vec![Parameter::choice(
        "mode",
        "how the crack is modelled",
        "damage",
        &["damage", "explicit"],
    )];
    parameters.extend(Numerics::parameters(1e-3));
    parameters.extend(Plate::parameters());
    parameters.extend(Tips::parameters("straight"));
    parameters.extend([
        StressMeasure::parameter(),
        Parameter::number(
            "toughness",
            "in opening",
            "J/m2",
            600.0,
            Permitted::above(0.0),
        ),
        Parameter::choice(
            "notch",
            "under damage: a cell row left out, or failed from the start, or a line",
            "gap",
            &["gap", "severed", "line"],
        ),
        Parameter::number("end", "of the run", "s", 1.1e-4, Permitted::above(0.0)),
    ]);
    parameters
}

/// A line that grows at this toughness, J/m².
fn explicit(toughness: f64) -> Overrides {
    Overrides::new()
        .set("mode", "explicit")
        .set("toughness", toughness)
}

pub(super) fn default_cases(settings: &Overrides, quick: bool) -> Vec<Overrides> {
    let asked = |name: &&str| settings.get(name).is_some();
    let line = settings.get("mode") == Some(&["explicit".into()]);
    if quick {
        let small = |case: Overrides| {
            case.set("width", 0.02)
                .set("height", 0.04)
                .set("crack", 0.01)
                .set("end", 6e-5)
        };
        let mut cases = vec![small(Overrides::new())];
        if !asked(&"mode") {
            cases.push(small(explicit(600.0)));
        }
        return cases;
    }
    let names = ["strength", "toughness", "h", "band", "notch", "transfer"];
    if names.iter().any(asked) {
        return vec![Overrides::new()];
    }
    if line {
        return vec![explicit(2000.0), explicit(600.0)];
    }
    let tough = |strength: f64| {
        Overrides::new()
            .set("strength", strength)
            .set("toughness", 2000.0)
            .set("end", 2e-4)
    };
    let mut cases = vec![Overrides::new()];
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
    if !asked(&"mode") {
        cases.extend([explicit(2000.0), explicit(600.0)]);
    }
    cases
}
