//! Anisotropic damage and its variants.

use fissure_materials::*;
use fissure_tensor::Vector3;

use super::Entry;
use super::elastic::{
    POISSON_XY, POISSON_XZ, POISSON_YZ, SHEAR_XY, SHEAR_XZ, SHEAR_YZ, YOUNG_X, YOUNG_Y, YOUNG_Z,
    orthotropic,
};
use super::parameters::{
    CURVE, DECAY_RATIO, EXPONENT, FRICTION, KINK_OPENING, KINK_RATIO, WEIGHT, density, isotropic,
    poisson, shear_strength, strength, toughness, young,
};
use crate::curve::Curve;
use crate::parameter::{LawParameter, Values};
use crate::subject::cracking;

const PARAMETERS: &[LawParameter] = &[
    density(1000.0),
    young(1e9),
    poisson(0.33),
    strength(30e6),
    toughness(10e3),
    SHEAR_STRENGTH,
    SHEAR_TOUGHNESS,
];

const SHEAR_STRENGTH: LawParameter = shear_strength(20e6);

const SHEAR_TOUGHNESS: LawParameter = LawParameter::positive(
    "shear_toughness",
    "fracture energy in sliding",
    "J/m2",
    10e3,
);

pub(super) const ANISOTROPIC: Entry = Entry {
    name: "anisotropic-damage",
    about: "one crack that softens in opening and in sliding, on any plane",
    parameters: &[
        density(1000.0),
        young(1e9),
        poisson(0.33),
        strength(30e6),
        toughness(10e3),
        SHEAR_STRENGTH,
        SHEAR_TOUGHNESS,
        FRICTION,
        CURVE,
        KINK_OPENING,
        KINK_RATIO,
        EXPONENT,
        DECAY_RATIO,
        WEIGHT,
        LawParameter::choice(
            "mixed",
            "opening and sliding at once: one failure for both, or each softens to its own end",
            "coupled",
            &["coupled", "uncoupled"],
        ),
        LawParameter::positive(
            "opening_exponent",
            "of G_I over its toughness in the coupled failure",
            "1",
            1.0,
        ),
        LawParameter::positive(
            "shear_exponent",
            "of G_II over its toughness in the coupled failure",
            "1",
            1.0,
        ),
    ],
    plane_stress: true,
    build: |values, space| match Curve::chosen(values) {
        // Known when it is compiled, since it is the faster one.
        None => cracking(whole(values, softening::Linear), space),
        Some(curve) => cracking(whole(values, curve), space),
    },
};

pub(super) const IN_PLANE: Entry = Entry {
    name: "anisotropic-damage-in-plane",
    about: "the same on planes that contain the z axis",
    parameters: PARAMETERS,
    plane_stress: true,
    build: |values, space| cracking(anisotropic(values, Onset::InPlane), space),
};

pub(super) const TWO_CRACKS: Entry = Entry {
    name: "two-crack-damage",
    about: "the same with a second crack across the first",
    parameters: PARAMETERS,
    plane_stress: true,
    build: |values, space| {
        cracking(
            TwoCrackDamage(anisotropic(values, Onset::TensionShear)),
            space,
        )
    },
};

pub(super) const CONJUGATE: Entry = Entry {
    name: "conjugate-damage",
    about: "the same with the stress that does the work",
    parameters: PARAMETERS,
    plane_stress: false,
    build: |values, space| {
        cracking(
            ConjugateDamage(anisotropic(values, Onset::TensionShear)),
            space,
        )
    },
};

pub(super) const CONJUGATE_TWO_CRACKS: Entry = Entry {
    name: "conjugate-two-crack-damage",
    about: "two cracks with the stress that does the work",
    parameters: PARAMETERS,
    plane_stress: false,
    build: |values, space| {
        let law = TwoCrackDamage(anisotropic(values, Onset::TensionShear));
        cracking(ConjugateDamage(law), space)
    },
};

pub(super) const ELLIPTICAL: Entry = Entry {
    name: "elliptical-damage",
    about: "the same with two shear damages on an ellipse, not objective, for comparison",
    parameters: PARAMETERS,
    plane_stress: true,
    build: |values, space| {
        let law: EllipticalDamage = EllipticalDamage::new(anisotropic(values, Onset::TensionShear));
        cracking(law, space)
    },
};

pub(super) const STEPPED: Entry = Entry {
    name: "stepped-circle-damage",
    about: "the same on a circle advanced by increments, for comparison",
    parameters: PARAMETERS,
    plane_stress: true,
    build: |values, space| {
        let law: SteppedCircleDamage =
            SteppedCircleDamage::new(anisotropic(values, Onset::TensionShear));
        cracking(law, space)
    },
};

pub(super) const ORTHOTROPIC: Entry = Entry {
    name: "orthotropic-damage",
    about: "one crack across x, y or z of spruce",
    parameters: &[
        density(450.0),
        YOUNG_X,
        YOUNG_Y,
        YOUNG_Z,
        POISSON_XY,
        POISSON_XZ,
        POISSON_YZ,
        SHEAR_XY,
        SHEAR_XZ,
        SHEAR_YZ,
        strength(3e6),
        toughness(1e3),
        shear_strength(2e6),
        LawParameter::positive(
            "shear_toughness",
            "fracture energy in sliding",
            "J/m2",
            1.5e3,
        ),
    ],
    plane_stress: true,
    build: |values, space| {
        let elastic = orthotropic(values);
        let mode = |strength: &str, toughness: &str| Mode {
            strength: values.number(strength),
            toughness: values.number(toughness),
            softening: softening::Linear,
        };
        let plane = |normal| DamagePlane {
            normal,
            opening: mode("strength", "toughness"),
            shear: mode("shear_strength", "shear_toughness"),
        };
        let law: OrthotropicDamage<3> = OrthotropicDamage {
            density: elastic.density,
            stiffness: elastic.stiffness(),
            planes: [Vector3::x(), Vector3::y(), Vector3::z()].map(plane),
            mixed: MixedMode::default(),
        };
        cracking(law, space)
    },
};

/// With everything that can be chosen.
fn whole<S: Softening>(values: &Values<'_>, curve: S) -> AnisotropicDamage<S, S> {
    let mixed = match values.choice("mixed") {
        "uncoupled" => MixedMode::Uncoupled,
        _ => MixedMode::Coupled {
            opening_exponent: values.number("opening_exponent"),
            shear_exponent: values.number("shear_exponent"),
        },
    };
    AnisotropicDamage {
        friction: values.number("friction"),
        mixed,
        ..softening_as(values, Onset::TensionShear, curve)
    }
}

fn anisotropic(values: &Values<'_>, onset: Onset) -> AnisotropicDamage {
    softening_as(values, onset, softening::Linear)
}

fn softening_as<S: Softening>(
    values: &Values<'_>,
    onset: Onset,
    softening: S,
) -> AnisotropicDamage<S, S> {
    let elastic = isotropic(values);
    let mode = |strength: &str, toughness: &str| Mode {
        strength: values.number(strength),
        toughness: values.number(toughness),
        softening,
    };
    let opening = mode("strength", "toughness");
    let shear = mode("shear_strength", "shear_toughness");
    AnisotropicDamage {
        onset,
        ..AnisotropicDamage::new(elastic, opening, shear)
    }
}
