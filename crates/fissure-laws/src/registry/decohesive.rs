//! The elastic-decohesive law: each softening curve, a lowered strength, several planes, shear.

use fissure_materials::criteria::Geological;
use fissure_materials::multi_crack::{
    GeologicalFlow, ModeOne, MultiCrack, Planes, Shear, Unloading,
};
use fissure_materials::*;
use fissure_tensor::Vector3;

use super::Entry;
use super::elastic::EXPANSION;
use super::parameters::{FRICTION, density, isotropic, poisson, strength, toughness, young};
use crate::curve::Curve;
use crate::parameter::{LawParameter, Values};
use crate::subject::{cracking, lowered};

/// Parameters of the law in opening with these of the softening curve.
macro_rules! parameters {
    ($($own:expr),*) => {
        &[
            density(2350.0),
            young(24.9e9),
            poisson(0.18),
            strength(2.7e6),
            toughness(61.35),
            NORMAL,
            $($own),*
        ]
    };
}

pub(super) const LINEAR: Entry = Entry {
    name: "decohesive",
    about: "elastic-decohesive law in mode I, linear softening",
    parameters: parameters!(),
    plane_stress: true,
    build: |values, space| cracking(decohesive(values, softening::Linear), space),
};

pub(super) const BILINEAR: Entry = Entry {
    name: "decohesive-bilinear",
    about: "the same with bilinear softening",
    parameters: parameters!(
        LawParameter::positive(
            "kink_opening",
            "opening of the kink over toughness / strength",
            "1",
            0.8
        ),
        LawParameter::positive(
            "kink_ratio",
            "traction at the kink over strength",
            "1",
            1.0 / 3.0
        )
    ),
    plane_stress: true,
    build: |values, space| {
        let curve = softening::Bilinear {
            kink_opening: values.number("kink_opening"),
            kink_ratio: values.number("kink_ratio"),
        };
        cracking(decohesive(values, Curve::Bilinear(curve)), space)
    },
};

pub(super) const POWER_LAW: Entry = Entry {
    name: "decohesive-power-law",
    about: "the same with a power of the opening",
    parameters: parameters!(LawParameter::positive(
        "exponent",
        "of the softening curve; at least 1",
        "1",
        2.0
    )),
    plane_stress: true,
    build: |values, space| {
        let exponent = values.number("exponent");
        cracking(
            decohesive(values, Curve::PowerLaw(softening::PowerLaw { exponent })),
            space,
        )
    },
};

pub(super) const EXPONENTIAL: Entry = Entry {
    name: "decohesive-exponential",
    about: "the same with exponential softening",
    parameters: parameters!(),
    plane_stress: true,
    build: |values, space| {
        cracking(
            decohesive(values, Curve::Exponential(softening::Exponential)),
            space,
        )
    },
};

pub(super) const CUBIC_STEP: Entry = Entry {
    name: "decohesive-cubic-step",
    about: "the same with a cubic step",
    parameters: parameters!(),
    plane_stress: true,
    build: |values, space| {
        cracking(
            decohesive(values, Curve::CubicStep(softening::CubicStep)),
            space,
        )
    },
};

pub(super) const DOUBLE_EXPONENTIAL: Entry = Entry {
    name: "decohesive-double-exponential",
    about: "the same with two exponentials",
    parameters: parameters!(
        LawParameter::positive(
            "decay_ratio",
            "of the second exponential to the first; above 1",
            "1",
            4.0
        ),
        LawParameter::number(
            "weight",
            "of the second exponential, taken away from the first",
            "1",
            0.2
        )
    ),
    plane_stress: true,
    build: |values, space| {
        let curve = softening::DoubleExponential {
            decay_ratio: values.number("decay_ratio"),
            weight: values.number("weight"),
        };
        cracking(decohesive(values, Curve::DoubleExponential(curve)), space)
    },
};

pub(super) const LOWERED: Entry = Entry {
    name: "lowered-strength",
    about: "the decohesive law over bands up to ten times its limit, where its strength is lowered",
    parameters: parameters!(),
    plane_stress: true,
    build: |values, space| lowered(decohesive(values, softening::Linear), space),
};

pub(super) const THERMAL: Entry = Entry {
    name: "thermal-decohesive",
    about: "the decohesive law with thermal expansion, at a temperature of each walk's own",
    parameters: parameters!(EXPANSION),
    plane_stress: true,
    build: |values, space| {
        let law = Thermal {
            law: decohesive(values, softening::Linear),
            expansion: Expansion::Isotropic(values.number("expansion")),
        };
        cracking(law, space)
    },
};

pub(super) const FIXED_PLANE: Entry = Entry {
    name: "mode-one-fixed",
    about: "one failure plane that opens, as it started",
    parameters: MODE_ONE,
    plane_stress: true,
    build: |values, space| cracking(mode_one::<1>(values, Planes::Fixed), space),
};

pub(super) const SEVERAL_PLANES: Entry = Entry {
    name: "mode-one-multiple",
    about: "up to six failure planes that open",
    parameters: MODE_ONE,
    plane_stress: true,
    build: |values, space| cracking(mode_one::<6>(values, Planes::Multiple(None)), space),
};

pub(super) const ROTATING_PLANE: Entry = Entry {
    name: "mode-one-rotating",
    about: "one failure plane that opens and follows the largest principal strain",
    parameters: MODE_ONE,
    plane_stress: true,
    build: |values, space| cracking(mode_one::<1>(values, Planes::Rotating), space),
};

pub(super) const GEOLOGICAL: Entry = Entry {
    name: "geological-flow",
    about: "one failure plane in tension, shear and compression, with associated flow",
    parameters: GEOLOGICAL_PARAMETERS,
    plane_stress: true,
    build: |values, space| cracking(geological::<1>(values, Planes::Fixed), space),
};

pub(super) const GEOLOGICAL_PLANES: Entry = Entry {
    name: "geological-multiple",
    about: "up to six failure planes in tension, shear and compression",
    parameters: GEOLOGICAL_PARAMETERS,
    plane_stress: false,
    build: |values, space| cracking(geological::<6>(values, Planes::Multiple(None)), space),
};

const GEOLOGICAL_PARAMETERS: &[LawParameter] = &[
    density(2350.0),
    young(24.9e9),
    poisson(0.18),
    strength(2.7e6),
    toughness(61.35),
];

const MODE_ONE: &[LawParameter] = &[
    density(2350.0),
    young(24.9e9),
    poisson(0.18),
    strength(2.7e6),
    toughness(61.35),
    LawParameter::choice(
        "unloading",
        "of an open plane: its opening stays, or goes back to zero with the traction",
        "permanent",
        &["permanent", "secant"],
    ),
    LawParameter::choice(
        "shear_along",
        "an open plane: elastic, none but friction, or stiffness that falls as it opens",
        "damaged",
        &["elastic", "coulomb", "damaged"],
    ),
    FRICTION,
];

const NORMAL: LawParameter = LawParameter::choice(
    "normal",
    "direction of the crack: of the largest principal stress, or this axis",
    "rankine",
    &["rankine", "x", "y", "z"],
);

fn decohesive<S: Softening>(values: &Values<'_>, softening: S) -> Decohesive<S> {
    Decohesive {
        elastic: isotropic(values),
        strength: values.number("strength"),
        toughness: values.number("toughness"),
        softening,
        normal: match values.choice("normal") {
            "x" => Normal::Prescribed(Vector3::x()),
            "y" => Normal::Prescribed(Vector3::y()),
            "z" => Normal::Prescribed(Vector3::z()),
            _ => Normal::Rankine,
        },
    }
}

fn mode_one<const N: usize>(values: &Values<'_>, planes: Planes) -> MultiCrack<N, ModeOne> {
    let friction = values.number("friction");
    MultiCrack {
        elastic: isotropic(values),
        decohesion: ModeOne {
            strength: values.number("strength"),
            toughness: values.number("toughness"),
            softening: softening::Linear,
            unloading: match values.choice("unloading") {
                "secant" => Unloading::Secant,
                _ => Unloading::Permanent,
            },
            shear: match values.choice("shear_along") {
                "elastic" => Shear::Elastic,
                "coulomb" => Shear::Coulomb(friction),
                _ => Shear::Damaged(friction),
            },
        },
        planes,
    }
}

fn geological<const N: usize>(
    values: &Values<'_>,
    planes: Planes,
) -> MultiCrack<N, GeologicalFlow> {
    MultiCrack {
        elastic: isotropic(values),
        decohesion: GeologicalFlow {
            surface: Geological {
                strength: values.number("strength"),
                ..Geological::CONCRETE
            },
            toughness: values.number("toughness"),
            softening: softening::Linear,
            friction: None,
        },
        planes,
    }
}
