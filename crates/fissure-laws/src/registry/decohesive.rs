//! The elastic-decohesive law: each softening curve, a lowered strength, several planes, shear.

use fissure_materials::criteria::Geological;
use fissure_materials::multi_crack::{
    GeologicalFlow, ModeOne, MultiCrack, Planes, Shear, Unloading,
};
use fissure_materials::*;
use fissure_tensor::Vector3;

use super::Entry;
use super::elastic::EXPANSION;
use super::parameters::{
    DECAY_RATIO, EXPONENT, FRICTION, KINK_OPENING, KINK_RATIO, WEIGHT, density, isotropic, poisson,
    shear_strength, strength, toughness, young,
};
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
    parameters: parameters!(KINK_OPENING, KINK_RATIO),
    plane_stress: true,
    build: |values, space| cracking(decohesive(values, Curve::bilinear(values)), space),
};

pub(super) const POWER_LAW: Entry = Entry {
    name: "decohesive-power-law",
    about: "the same with a power of the opening",
    parameters: parameters!(EXPONENT),
    plane_stress: true,
    build: |values, space| cracking(decohesive(values, Curve::power_law(values)), space),
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
    parameters: parameters!(DECAY_RATIO, WEIGHT),
    plane_stress: true,
    build: |values, space| cracking(decohesive(values, Curve::double_exponential(values)), space),
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
    shear_strength(Geological::CONCRETE.shear_strength),
    LawParameter::positive(
        "confined_shear_strength",
        "strength in sliding under large pressure; above shear_strength",
        "Pa",
        Geological::CONCRETE.confined_shear_strength,
    ),
    LawParameter::positive(
        "compressive_strength",
        "uniaxial compressive strength f'_c",
        "Pa",
        Geological::CONCRETE.compressive_strength,
    ),
    LawParameter::positive(
        "biaxial_strength",
        "biaxial compressive strength f'_b, above half of f'_c; the usual one is 1.16 f'_c",
        "Pa",
        Geological::CONCRETE.biaxial_strength,
    ),
    LawParameter::not_negative(
        "normal_coupling",
        "C_n, of the normal traction",
        "1",
        Geological::CONCRETE.normal_coupling,
    ),
    LawParameter::not_negative(
        "lateral_coupling",
        "C_s, of the stress along the plane",
        "1",
        Geological::CONCRETE.lateral_coupling,
    ),
    LawParameter::not_negative(
        "shape_coupling",
        "C_psi, of the shape of the surface",
        "1",
        Geological::CONCRETE.shape_coupling,
    ),
    LawParameter::choice(
        "after_failure",
        "shear of a failed plane: on the surface that is left, or by friction",
        "surface",
        &["surface", "friction"],
    ),
    FRICTION,
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
                shear_strength: values.number("shear_strength"),
                confined_shear_strength: values.number("confined_shear_strength"),
                compressive_strength: values.number("compressive_strength"),
                biaxial_strength: values.number("biaxial_strength"),
                normal_coupling: values.number("normal_coupling"),
                lateral_coupling: values.number("lateral_coupling"),
                shape_coupling: values.number("shape_coupling"),
            },
            toughness: values.number("toughness"),
            softening: softening::Linear,
            friction: match values.choice("after_failure") {
                "friction" => Some(values.number("friction")),
                _ => None,
            },
        },
        planes,
    }
}
