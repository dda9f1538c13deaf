//! Plasticity, and damage without a crack.

use fissure_materials::*;
use fissure_materials::{DamageSurface, Hardening, Relaxation, hardening};

use super::Entry;
use super::parameters::{density, isotropic, poisson, strength, toughness, young};
use crate::law::{Law, Space};
use crate::parameter::{LawParameter, Values};
use crate::subject::{banded, plain};

pub(super) const J2_LINEAR: Entry = Entry {
    name: "j2",
    about: "J2 plasticity with linear hardening",
    parameters: &[density(7800.0), young(210e9), poisson(0.3), YIELD, MODULUS],
    plane_stress: true,
    build: |values, space| {
        let law = hardening::Linear {
            yield_stress: values.number("yield_stress"),
            modulus: values.number("hardening_modulus"),
        };
        metal(values, law, space)
    },
};

pub(super) const J2_VOCE: Entry = Entry {
    name: "j2-voce",
    about: "J2 plasticity with saturating hardening",
    parameters: &[
        density(7800.0),
        young(210e9),
        poisson(0.3),
        YIELD,
        MODULUS,
        LawParameter::not_negative(
            "saturation",
            "rise of the yield stress at saturation",
            "Pa",
            200e6,
        ),
        LawParameter::positive("saturation_rate", "exponent of the saturation", "1", 15.0),
    ],
    plane_stress: true,
    build: |values, space| {
        let law: Box<dyn Hardening> = Box::new(hardening::Voce {
            yield_stress: values.number("yield_stress"),
            saturation: values.number("saturation"),
            rate: values.number("saturation_rate"),
            modulus: values.number("hardening_modulus"),
        });
        metal(values, law, space)
    },
};

pub(super) const J2_TABLE: Entry = Entry {
    name: "j2-table",
    about: "J2 plasticity with hardening between points: 1, 1.4 and 1.6 times the yield stress at 0, 5 and 20 %",
    parameters: &[density(7800.0), young(210e9), poisson(0.3), YIELD],
    plane_stress: true,
    build: |values, space| {
        let first = values.number("yield_stress");
        let points = [(0.0, first), (0.05, 1.4 * first), (0.2, 1.6 * first)];
        let law: Box<dyn Hardening> = match hardening::Table::new(points) {
            Ok(table) => Box::new(table),
            // Whose check says what is wrong with it.
            Err(_) => Box::new(hardening::Linear {
                yield_stress: first,
                modulus: 0.0,
            }),
        };
        metal(values, law, space)
    },
};

pub(super) const VISCOUS_DAMAGE: Entry = Entry {
    name: "viscous-damage",
    about: "damage of concrete; it lags behind the strain if all four parameters of the lag are given",
    parameters: &[
        density(2400.0),
        young(36e9),
        poisson(0.22),
        LawParameter::positive("threshold", "strain at which damage starts", "1", 2.5e-5),
        LawParameter::positive("spread", "strain over which damage grows", "1", 2.2e-4),
        LawParameter::positive(
            "damage_exponent",
            "exponent of the damage; at least 1",
            "1",
            1.5,
        ),
        LawParameter::unpublished("lag", "relaxation time at a rate of 1/s", "s"),
        LawParameter::unpublished(
            "rate_curvature",
            "c_t1, of the squared logarithm of the rate",
            "1",
        ),
        LawParameter::unpublished("rate_exponent", "c_t2, minus the exponent of the rate", "1"),
        LawParameter::unpublished(
            "relaxation_exponent",
            "g_h; 1 for exponential relaxation",
            "1",
        ),
    ],
    plane_stress: true,
    build: |values, space| {
        let relaxation = Relaxation {
            time: values.number("lag"),
            rate_curvature: values.number("rate_curvature"),
            rate_exponent: values.number("rate_exponent"),
            exponent: values.number("relaxation_exponent"),
        };
        // All or none: one that is missing is not a number, which the law refuses by its name.
        let given = [
            relaxation.time,
            relaxation.rate_curvature,
            relaxation.rate_exponent,
            relaxation.exponent,
        ];
        let any = given.iter().any(|value| !value.is_nan());
        let law = ViscousDamage {
            elastic: isotropic(values),
            surface: DamageSurface::CONCRETE,
            threshold: values.number("threshold"),
            spread: values.number("spread"),
            exponent: values.number("damage_exponent"),
            relaxation: any.then_some(relaxation),
        };
        plain(law, values.number("threshold"), space)
    },
};

pub(super) const SCALAR_DAMAGE: Entry = Entry {
    name: "scalar-damage",
    about: "isotropic damage by the largest effective principal stress, linear softening",
    parameters: &[
        density(2350.0),
        young(24.9e9),
        poisson(0.18),
        strength(2.7e6),
        toughness(61.35),
    ],
    plane_stress: true,
    build: |values, space| {
        let law = ScalarDamage {
            elastic: isotropic(values),
            evolution: RankineDamage {
                strength: values.number("strength"),
                toughness: values.number("toughness"),
                softening: softening::Linear,
            },
        };
        let strain = values.number("strength") / law.elastic.p_wave_modulus();
        let limit = law.band_limit(&Scale::default());
        banded(law, strain, limit, space)
    },
};

pub(super) const MAZARS: Entry = Entry {
    name: "mazars",
    about: "Mazars' damage by the tensile principal strains, with a toughness",
    parameters: &[
        density(2450.0),
        young(32e9),
        poisson(0.2),
        LawParameter::positive("threshold", "strain at which damage starts", "1", 8.5e-5),
        toughness(100.0),
    ],
    plane_stress: true,
    build: |values, space| {
        let law = ScalarDamage {
            elastic: isotropic(values),
            evolution: MazarsDamage {
                threshold_strain: values.number("threshold"),
                softening: MazarsSoftening::Toughness(values.number("toughness")),
            },
        };
        let limit = law.band_limit(&Scale::default());
        banded(law, values.number("threshold"), limit, space)
    },
};

const YIELD: LawParameter =
    LawParameter::positive("yield_stress", "initial yield stress", "Pa", 250e6);

const MODULUS: LawParameter = LawParameter::not_negative(
    "hardening_modulus",
    "slope of the yield stress that stays",
    "Pa",
    1e9,
);

fn metal<H: Hardening>(values: &Values<'_>, hardening: H, space: Space) -> Box<dyn Law> {
    let elastic = isotropic(values);
    let strain = values.number("yield_stress") / elastic.young;
    plain(J2 { elastic, hardening }, strain, space)
}
