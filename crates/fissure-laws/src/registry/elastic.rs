//! Laws without memory: solids and a gas.

use fissure_materials::*;
use fissure_tensor::Matrix3;

use super::Entry;
use super::parameters::{ELASTIC, density, isotropic, poisson, young};
use crate::parameter::{LawParameter, Values};
use crate::subject::plain;

pub(super) const ISOTROPIC: Entry = Entry {
    name: "isotropic",
    about: "isotropic elasticity at small strain",
    parameters: ELASTIC,
    plane_stress: true,
    build: |values, space| plain(isotropic(values), 1e-4, space),
};

pub(super) const HENCKY: Entry = Entry {
    name: "hencky",
    about: "isotropic elasticity on the logarithmic strain",
    parameters: ELASTIC,
    plane_stress: true,
    build: |values, space| {
        let elastic = isotropic(values);
        plain(Hencky { elastic }, 0.05, space)
    },
};

pub(super) const NEO_HOOKEAN: Entry = Entry {
    name: "neo-hookean",
    about: "rubber elasticity",
    parameters: &[density(1100.0), young(1e6), poisson(0.45)],
    plane_stress: true,
    build: |values, space| {
        let law = NeoHookean {
            density: values.number("density"),
            young: values.number("young"),
            poisson: values.number("poisson"),
        };
        plain(law, 0.05, space)
    },
};

pub(super) const ORTHOTROPIC: Entry = Entry {
    name: "orthotropic",
    about: "orthotropic elasticity (spruce) on the Biot strain, axes x, y, z",
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
    ],
    plane_stress: true,
    build: |values, space| plain(orthotropic(values), 1e-3, space),
};

pub(super) const THERMAL_HENCKY: Entry = Entry {
    name: "thermal-hencky",
    about: "Hencky elasticity with thermal expansion, at a temperature of each walk's own",
    parameters: &[density(2350.0), young(24.9e9), poisson(0.18), EXPANSION],
    plane_stress: true,
    build: |values, space| {
        let law = Thermal {
            law: Hencky {
                elastic: isotropic(values),
            },
            expansion: Expansion::Isotropic(values.number("expansion")),
        };
        plain(law, 0.05, space)
    },
};

pub(super) const JWL: Entry = Entry {
    name: "jwl",
    about: "detonation products of TNT, burnt at once",
    parameters: &[],
    plane_stress: false,
    build: |_, space| {
        let law = Jwl {
            burn: Burn::Instant,
            ..Jwl::TNT
        };
        plain(law, 0.05, space)
    },
};

/// Linear thermal expansion.
pub(super) const EXPANSION: LawParameter = LawParameter::not_negative(
    "expansion",
    "coefficient of thermal expansion",
    "1/K",
    12e-6,
);

// The constants of spruce along its axes, of [`orthotropic`].
pub(super) const YOUNG_X: LawParameter =
    LawParameter::positive("young_x", "Young's modulus along x", "Pa", 11.6e9);
pub(super) const YOUNG_Y: LawParameter =
    LawParameter::positive("young_y", "Young's modulus along y", "Pa", 0.9e9);
pub(super) const YOUNG_Z: LawParameter =
    LawParameter::positive("young_z", "Young's modulus along z", "Pa", 0.5e9);
pub(super) const POISSON_XY: LawParameter = LawParameter::number(
    "poisson_xy",
    "contraction along y under a pull along x",
    "1",
    0.37,
);
pub(super) const POISSON_XZ: LawParameter = LawParameter::number(
    "poisson_xz",
    "contraction along z under a pull along x",
    "1",
    0.42,
);
pub(super) const POISSON_YZ: LawParameter = LawParameter::number(
    "poisson_yz",
    "contraction along z under a pull along y",
    "1",
    0.47,
);
pub(super) const SHEAR_XY: LawParameter =
    LawParameter::positive("shear_xy", "shear modulus in the plane xy", "Pa", 0.75e9);
pub(super) const SHEAR_XZ: LawParameter =
    LawParameter::positive("shear_xz", "shear modulus in the plane xz", "Pa", 0.72e9);
pub(super) const SHEAR_YZ: LawParameter =
    LawParameter::positive("shear_yz", "shear modulus in the plane yz", "Pa", 0.039e9);

/// Orthotropic elasticity along x, y and z.
pub(super) fn orthotropic(values: &Values<'_>) -> Orthotropic {
    Orthotropic {
        density: values.number("density"),
        young: ["young_x", "young_y", "young_z"].map(|name| values.number(name)),
        poisson_12: values.number("poisson_xy"),
        poisson_13: values.number("poisson_xz"),
        poisson_23: values.number("poisson_yz"),
        shear_12: values.number("shear_xy"),
        shear_13: values.number("shear_xz"),
        shear_23: values.number("shear_yz"),
        axes: Matrix3::identity(),
    }
}
