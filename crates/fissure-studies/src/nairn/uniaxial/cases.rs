//! Parameters of the bars and the cases that are run by default.

use fissure_study::{Overrides, Parameter, Permitted};

use crate::nairn::conjugate::StressMeasure;
use crate::nairn::numerics::Numerics;

/// Numerics that are compared on the bar that necks: there the independent code stops early with
/// FLIP, with CPDI and in plane stress.
const NECKING: [(&str, &str, &str); 6] = [
    ("gimp", "xpic", "strain"),
    ("gimp", "flip", "strain"),
    ("gimp", "fmpm", "strain"),
    ("cpdi", "xpic", "strain"),
    ("bspline2", "xpic", "strain"),
    ("gimp", "xpic", "stress"),
];

pub(super) fn parameters() -> Vec<Parameter> {
    let positive = || Permitted::above(0.0);
    let mut parameters = vec![Parameter::choice(
        "case",
        "tension and necking (one bar, two shear strengths), compression; and three sections in space that neck",
        "tension",
        &[
            "tension",
            "necking",
            "compression",
            "rectangle",
            "square",
            "circle",
        ],
    )
    .selecting()];
    parameters.extend(Numerics::parameters(1e-3));
    parameters.extend([
        StressMeasure::parameter(),
        Parameter::choice(
            "planes",
            "of cracks of a bar in space: any, or those that contain z",
            "any",
            &["any", "upright"],
        ),
        Parameter::choice(
            "cracks",
            "of a particle: one, or a second one across it",
            "one",
            &["one", "two"],
        ),
        Parameter::choice(
            "plane",
            "of a bar in the plane",
            "strain",
            &["strain", "stress"],
        ),
        Parameter::number("young", "Young's modulus", "Pa", 1e9, positive()),
        Parameter::number(
            "poisson",
            "Poisson's ratio",
            "1",
            0.33,
            Permitted::between(-1.0, 0.5),
        ),
        Parameter::number("density", "mass density", "kg/m3", 1000.0, positive()),
        Parameter::number("strength", "in tension", "Pa", 30e6, positive()),
        Parameter::number("shear_strength", "in shear", "Pa", 20e6, positive()),
        Parameter::number("toughness", "of both modes", "J/m2", 10e3, positive()),
        Parameter::number("length", "of the bar", "m", 0.04, positive()),
        Parameter::number(
            "width",
            "of the bar, or its diameter",
            "m",
            6e-3,
            positive(),
        ),
        Parameter::number("depth", "of the bar in space", "m", 6e-3, positive()),
        Parameter::number(
            "buffer",
            "at each end that does not soften",
            "m",
            4e-3,
            Permitted::at_least(0.0),
        ),
        Parameter::number("speed", "of the right grip", "m/s", 1.0, positive()),
        Parameter::number(
            "rise",
            "time in which the grip comes to its speed, smoothly",
            "s",
            0.0,
            Permitted::at_least(0.0),
        ),
        Parameter::number(
            "strain",
            "nominal, at the end of the run",
            "1",
            0.055,
            Permitted::numbers(1e-4..=1.0),
        ),
        Parameter::number(
            "jitter",
            "coefficient of variation of the strengths, particle by particle",
            "1",
            0.0,
            Permitted::numbers(0.0..=0.3),
        ),
        Parameter::count(
            "seed",
            "of the jitter",
            1,
            Permitted::counts(0..=u64::from(u32::MAX)),
        ),
    ]);
    parameters
}

/// What differs from the defaults in a case.
fn of(case: &str, quick: bool) -> Overrides {
    let set = Overrides::new().set("case", case);
    match case {
        "necking" => set
            .set("shear_strength", 10e6)
            .set("speed", if quick { 4.0 } else { 1.0 })
            .set("strain", 0.2),
        "compression" => set
            .set("shear_strength", 15e6)
            .set("length", 0.03)
            .set("width", 0.012)
            .set("speed", if quick { 4.0 } else { 1.0 })
            .set("strain", 0.1),
        "tension" if quick => set.set("strain", 0.034),
        "tension" => set,
        _ => in_space(set, case, quick),
    }
}

/// A bar in space. With one crack a particle, on the plane of largest shear, it does not neck: particles beside each
/// other slide along planes that do not go together. A second crack lets a section shrink both ways; so that a quick
/// run needs no more than one, all planes contain z there, and the section shrinks along y.
fn in_space(set: Overrides, case: &str, quick: bool) -> Overrides {
    let bar = set
        .set("shear_strength", 10e6)
        .set("speed", 4.0)
        .set("strain", 0.18)
        .set("length", 0.02);
    let bar = match case {
        "rectangle" => bar.set("width", 8e-3).set("depth", 2e-3),
        _ if quick => bar.set("h", 1.5e-3).set("length", 0.018),
        _ => bar,
    };
    if quick {
        return bar.set("planes", "upright");
    }
    bar.set("cracks", "two").set("measure", "rotated")
}

pub(super) fn default_cases(settings: &Overrides, quick: bool) -> Vec<Overrides> {
    let asked = settings.get("case").unwrap_or(&[]);
    let mut cases = Vec::new();
    let shapes: &[&str] = if quick {
        &["gimp"]
    } else {
        &["gimp", "cpdi", "bspline2"]
    };
    cases.push(of("tension", quick).sweep("shape", shapes.iter().copied()));
    if !quick {
        cases.push(of("tension", quick).set("band", "discretisation"));
        cases.push(of("tension", quick).sweep("transfer", ["flip", "apic"]));
        cases.push(of("tension", quick).set("measure", "rotated"));
    }
    let numerics = if quick { &NECKING[..1] } else { &NECKING[..] };
    for (shape, transfer, plane) in numerics {
        cases.push(
            of("necking", quick)
                .set("shape", *shape)
                .set("transfer", *transfer)
                .set("plane", *plane),
        );
    }
    // In a quick run two of the four are left out unless they are asked for.
    let others = ["compression", "rectangle", "square", "circle"];
    let wanted = |case: &str| {
        !quick || matches!(case, "compression" | "circle") || asked.contains(&case.into())
    };
    cases.extend(
        others
            .into_iter()
            .filter(|c| wanted(c))
            .map(|c| of(c, quick)),
    );
    if !quick {
        let one = of("circle", quick).set("cracks", "one");
        cases.push(
            one.set("measure", "conjugate")
                .sweep("planes", ["upright", "any"]),
        );
    }
    cases
}
