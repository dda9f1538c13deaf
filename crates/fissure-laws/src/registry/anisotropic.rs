//! Anisotropic damage and its variants.

use fissure_materials::*;
use fissure_tensor::Vector3;

use super::Entry;
use super::elastic::{
    POISSON_XY, POISSON_XZ, POISSON_YZ, SHEAR_XY, SHEAR_XZ, SHEAR_YZ, YOUNG_X, YOUNG_Y, YOUNG_Z,
    orthotropic,
};
use super::parameters::{FRICTION, density, isotropic, poisson, strength, toughness, young};
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

const SHEAR_STRENGTH: LawParameter =
    LawParameter::positive("shear_strength", "strength in sliding", "Pa", 20e6);

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
    ],
    plane_stress: true,
    build: |values, space| {
        let law = AnisotropicDamage {
            friction: values.number("friction"),
            ..anisotropic(values, Onset::TensionShear)
        };
        cracking(law, space)
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
        LawParameter::positive("shear_strength", "strength in sliding", "Pa", 2e6),
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

fn anisotropic(values: &Values<'_>, onset: Onset) -> AnisotropicDamage {
    let elastic = isotropic(values);
    let mode = |strength: &str, toughness: &str| Mode {
        strength: values.number(strength),
        toughness: values.number(toughness),
        softening: softening::Linear,
    };
    let opening = mode("strength", "toughness");
    let shear = mode("shear_strength", "shear_toughness");
    AnisotropicDamage {
        onset,
        ..AnisotropicDamage::new(elastic, opening, shear)
    }
}
