//! Parameters of the study and the cases that are run by default.

use fissure_study::{Overrides, Parameter, Value};

use crate::bar::{self, SPACINGS};

pub(super) fn parameters() -> Vec<Parameter> {
    let mut parameters = vec![Parameter::choice(
        "case",
        "what is studied: the bar breaking, or its elastic convergence (sec. 5.3)",
        "softening",
        &["softening", "elastic"],
    )];
    parameters.extend(bar::parameters(&SPACINGS));
    parameters
}

/// The aligned bar: linear functions at every resolution and the other shapes at two, with both
/// solvers. The elastic study: every angle and filling at every resolution.
pub(super) fn default_cases(settings: &Overrides, quick: bool) -> Vec<Overrides> {
    let elastic = Value::from("elastic");
    let both = ["explicit", "quasi-static"];
    let spacings = if quick { &SPACINGS[..2] } else { &SPACINGS[..] };
    let asked = settings.get("case").unwrap_or(&[]);
    let mut cases = Vec::new();
    if asked.is_empty() || asked.iter().any(|case| *case != elastic) {
        let softening = Overrides::new()
            .set("case", "softening")
            .sweep("solver", both);
        cases.push(
            softening
                .clone()
                .set("shape", "linear")
                .sweep("h", spacings.iter().copied()),
        );
        let others: &[&str] = if quick {
            &["gimp"]
        } else {
            &["gimp", "cpdi", "bspline2", "bspline3"]
        };
        let coarse = if quick {
            &SPACINGS[..1]
        } else {
            &SPACINGS[1..3]
        };
        cases.push(
            softening
                .sweep("shape", others.iter().copied())
                .sweep("h", coarse.iter().copied()),
        );
    }
    if asked.contains(&elastic) {
        cases.push(
            Overrides::new()
                .set("case", "elastic")
                .set("solver", "quasi-static")
                .sweep("angle", [0.0, 15.0, 30.0, 45.0])
                .sweep("fill", ["rotated", "cell"])
                .sweep("h", spacings.iter().copied()),
        );
    }
    cases
}
