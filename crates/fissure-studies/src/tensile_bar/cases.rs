//! Parameters of the bar and the cases that are run by default.

use std::thread::available_parallelism;

use fissure_study::{Overrides, Parameter, Permitted, Value};

/// Grid spacings of the document, m: h⁻¹ = 50, 100, 200, 400.
const SPACINGS: [f64; 4] = [0.02, 0.01, 0.005, 0.0025];

pub(super) fn parameters() -> Vec<Parameter> {
    let positive = || Permitted::above(0.0);
    let threads = available_parallelism().map_or(1, |n| n.get() as u64);
    vec![
        Parameter::choice(
            "case",
            "what is studied: the bar breaking, or its elastic convergence (sec. 5.3)",
            "softening",
            &["softening", "elastic"],
        ),
        Parameter::number(
            "angle",
            "of the bar against the grid",
            "deg",
            0.0,
            Permitted::numbers(0.0..=90.0),
        ),
        Parameter::number("h", "grid spacing", "m", SPACINGS[0], positive()).sweep(SPACINGS),
        Parameter::choice(
            "solver",
            "time integration",
            "explicit",
            &["explicit", "quasi-static"],
        ),
        Parameter::choice(
            "shape",
            "shape function",
            "linear",
            &["linear", "gimp", "cpdi", "bspline2", "bspline3"],
        ),
        Parameter::choice(
            "transfer",
            "between particles and grid (explicit)",
            "flip",
            &["flip", "pic", "apic", "xpic", "fmpm"],
        ),
        Parameter::count(
            "order",
            "terms of xpic and fmpm",
            3,
            Permitted::counts(1..=20),
        ),
        Parameter::choice(
            "fill",
            "particles on a lattice that turns with the bar, or at the same places in every cell (figs 5.4, 5.39)",
            "rotated",
            &["rotated", "cell"],
        ),
        Parameter::choice(
            "ends",
            "what the grips hold: the axial velocity, or all of it",
            "rollers",
            &["rollers", "clamped"],
        ),
        Parameter::number(
            "gap",
            "of the grips from the ends of a turned bar, in cells",
            "1",
            0.5,
            Permitted::numbers(0.0..=2.0),
        ),
        Parameter::choice(
            "band",
            "width that smears the crack",
            "discretisation",
            &["discretisation", "particle"],
        ),
        Parameter::number(
            "weakening",
            "strength of the weak line over the nominal one",
            "1",
            0.9,
            Permitted::numbers(0.1..=1.0),
        ),
        Parameter::number("young", "Young's modulus", "Pa", 24.9e9, positive()),
        Parameter::number(
            "poisson",
            "Poisson's ratio",
            "1",
            0.18,
            Permitted::between(-1.0, 0.5),
        ),
        Parameter::number("density", "mass density", "kg/m3", 2350.0, positive()),
        Parameter::number("strength", "tensile strength", "Pa", 2.7e6, positive()),
        Parameter::number("toughness", "fracture energy", "J/m2", 61.35, positive()),
        Parameter::number("length", "of the bar", "m", 0.20, positive()),
        Parameter::number("width", "of the bar", "m", 0.06, positive()),
        Parameter::number("depth", "of the bar", "m", 0.06, positive()),
        Parameter::number("speed", "of the right grip", "m/s", 0.01, positive()),
        Parameter::number(
            "ramp",
            "time to full speed, in transits of the bar by a wave (explicit)",
            "1",
            10.0,
            Permitted::at_least(0.0),
        ),
        Parameter::number(
            "cfl",
            "step over the time a wave needs across a cell (explicit)",
            "1",
            0.8,
            Permitted::numbers(0.01..=1.0),
        ),
        Parameter::count(
            "steps",
            "load steps of the run, which ends at 1.25 critical openings (quasi-static)",
            150,
            Permitted::counts(1..=100_000),
        ),
        Parameter::count(
            "threads",
            "worker threads",
            threads,
            Permitted::counts(1..=256),
        ),
    ]
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
