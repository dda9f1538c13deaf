//! The elastic-decohesive bar of Sanchez 2010, ch. 5, for the studies that pull it.

mod breaking;
pub(crate) mod drawing;
mod exact;
mod gauge;
mod history;
mod specimen;

use fissure_study::{Parameter, Permitted};

pub(crate) use breaking::{Finished, Pull, break_bar, load, measured, row, run_length};
pub(crate) use exact::Exact;
pub(crate) use gauge::Gauge;
pub(crate) use history::{History, Thinned};
pub(crate) use specimen::{BODY, Bar, OFFSETS};

use crate::method;

/// Grid spacings of the document, m: h⁻¹ = 50, 100, 200, 400.
pub(crate) const SPACINGS: [f64; 4] = [0.02, 0.01, 0.005, 0.0025];

/// Every parameter of the bar and of how it is solved, for a study that runs these spacings.
pub(crate) fn parameters(spacings: &[f64]) -> Vec<Parameter> {
    parameters_of(spacings, method::SOLVERS)
}

/// The same for a study that permits these solvers.
pub(crate) fn parameters_of(spacings: &[f64], solvers: &'static [&'static str]) -> Vec<Parameter> {
    let mut parameters = method::parameters(spacings, solvers);
    for parameter in &mut parameters {
        let default: Option<fissure_study::Value> = match parameter.name {
            "cfl" => Some(0.8.into()),
            "steps" => Some(150_u64.into()),
            _ => None,
        };
        if let Some(default) = default {
            parameter.default = vec![default];
        }
    }
    parameters.extend(placing());
    parameters.extend(material());
    parameters.extend(loading());
    parameters
}

/// How the bar lies on the grid, and its grips.
fn placing() -> Vec<Parameter> {
    vec![
        Parameter::number(
            "angle",
            "of the bar against the grid",
            "deg",
            0.0,
            Permitted::numbers(0.0..=90.0),
        ),
        Parameter::choice(
            "fill",
            "particles on a lattice that turns with the bar, at the same places in every cell (figs 5.4, 5.39), or in the middle of what the sides leave of quarter cells",
            "rotated",
            &["rotated", "cell", "cut"],
        ),
        Parameter::count(
            "offset",
            "of the grid against the bar: one of eight within a cell; 0 is none",
            0,
            Permitted::counts(0..OFFSETS),
        ),
        Parameter::choice(
            "ends",
            "what the grips hold: the axial velocity, or all of it",
            "rollers",
            &["rollers", "clamped"],
        ),
        Parameter::number(
            "gap",
            "of the grips from the ends of a turned or offset bar, in cells",
            "1",
            0.5,
            Permitted::numbers(0.0..=2.0),
        ),
    ]
}

/// The law, where it is weaker, and the sizes.
fn material() -> Vec<Parameter> {
    let positive = || Permitted::above(0.0);
    vec![
        Parameter::choice(
            "law",
            "normal prescribed along the bar or Rankine's, with elastic shear on the plane; Rankine's without shear, with shear that falls with the opening; a turning plane",
            "prescribed",
            &[
                "prescribed",
                "rankine",
                "no-shear",
                "damaged-shear",
                "rotating",
            ],
        ),
        Parameter::choice(
            "strain",
            "of each particle by its own place, or one for all of a cell (quasi-static)",
            "particle",
            &["particle", "cell"],
        ),
        Parameter::number(
            "hourglass",
            "stiffness against what a cell's one strain does not see, over that of the material",
            "1",
            0.1,
            Permitted::at_least(0.0),
        ),
        Parameter::choice(
            "band",
            "width that smears the crack",
            "discretisation",
            &["discretisation", "particle"],
        ),
        Parameter::number(
            "failing",
            "part of the length, in the middle, that can fail; the rest is elastic (fig. 5.5)",
            "1",
            1.0,
            Permitted::numbers(0.2..=1.0),
        ),
        Parameter::choice(
            "weak",
            "where the bar is weaker (sec. 5.4)",
            "line",
            &["line", "square", "point", "two-lines"],
        ),
        Parameter::number("weak_side", "of the weak square", "m", 0.02, positive()),
        Parameter::number(
            "imperfection",
            "how much less weak the second of two lines is",
            "1",
            0.0,
            Permitted::numbers(0.0..=0.1),
        ),
        Parameter::number(
            "weakening",
            "strength where the bar is weaker over the nominal one",
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
    ]
}

/// How it is pulled.
fn loading() -> Vec<Parameter> {
    vec![
        Parameter::number(
            "speed",
            "of the right grip",
            "m/s",
            0.01,
            Permitted::above(0.0),
        ),
        Parameter::number(
            "ramp",
            "time to full speed, in transits of the bar by a wave (explicit, implicit)",
            "1",
            10.0,
            Permitted::at_least(0.0),
        ),
    ]
}
