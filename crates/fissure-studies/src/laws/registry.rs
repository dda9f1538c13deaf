//! Every law that the studies know. A new law is one [`Entry`] here; `point`, `laws` and
//! `isoerror` then have it, in space and in plane stress.

use fissure::prelude::*;

use super::law::{Law, Space, cracking, plain};
use super::parameter::{LawParameter, Values, density, poisson, strength, toughness, young};

/// A law with its parameters.
#[derive(Debug)]
pub struct Entry {
    /// The name on the command line, in lower case with hyphens.
    pub name: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    /// Its parameters with its own values.
    pub parameters: &'static [LawParameter],
    /// The law of some values; its parameters are checked by the one who asks.
    pub build: fn(&Values<'_>, Space) -> Box<dyn Law>,
}

/// Every law.
pub const LAWS: &[Entry] = &[
    Entry {
        name: "isotropic",
        about: "isotropic elasticity at small strain",
        parameters: &[density(2350.0), young(24.9e9), poisson(0.18)],
        build: |values, space| plain(isotropic(values), 1e-4, space),
    },
    Entry {
        name: "hencky",
        about: "isotropic elasticity on the logarithmic strain",
        parameters: &[density(2350.0), young(24.9e9), poisson(0.18)],
        build: |values, space| {
            let elastic = isotropic(values);
            plain(Hencky { elastic }, 0.05, space)
        },
    },
    Entry {
        name: "neo-hookean",
        about: "rubber elasticity",
        parameters: &[density(1100.0), young(1e6), poisson(0.45)],
        build: |values, space| {
            let law = NeoHookean {
                density: values.number("density"),
                young: values.number("young"),
                poisson: values.number("poisson"),
            };
            plain(law, 0.05, space)
        },
    },
    Entry {
        name: "decohesive",
        about: "elastic-decohesive law in mode I, linear softening",
        parameters: &[
            density(2350.0),
            young(24.9e9),
            poisson(0.18),
            strength(2.7e6),
            toughness(61.35),
            NORMAL,
        ],
        build: |values, space| {
            let law = Decohesive {
                elastic: isotropic(values),
                strength: values.number("strength"),
                toughness: values.number("toughness"),
                softening: softening::Linear,
                normal: normal(values),
            };
            cracking(law, space)
        },
    },
];

/// Names of the laws.
pub const NAMES: &[&str] = &{
    let mut names = [""; LAWS.len()];
    let mut index = 0;
    while index < LAWS.len() {
        names[index] = LAWS[index].name;
        index += 1;
    }
    names
};

const NORMAL: LawParameter = LawParameter::choice(
    "normal",
    "direction of the crack: of the largest principal stress, or this axis",
    "rankine",
    &["rankine", "x", "y", "z"],
);

/// Elastic constants and density.
fn isotropic(values: &Values<'_>) -> Isotropic {
    Isotropic {
        density: values.number("density"),
        young: values.number("young"),
        poisson: values.number("poisson"),
    }
}

/// Where the normal of a crack comes from.
fn normal(values: &Values<'_>) -> Normal {
    match values.choice("normal") {
        "x" => Normal::Prescribed(Vector3::x()),
        "y" => Normal::Prescribed(Vector3::y()),
        "z" => Normal::Prescribed(Vector3::z()),
        _ => Normal::Rankine,
    }
}

/// The law of a name.
pub fn entry(name: &str) -> Option<&'static Entry> {
    LAWS.iter().find(|entry| entry.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_law_takes_its_own_values() {
        for entry in LAWS {
            for space in [Space::Solid, Space::PlaneStress] {
                let law = (entry.build)(&Values::own(entry), space);
                assert!(law.check().is_ok(), "{}: {:?}", entry.name, law.check());
                assert!(law.natural_strain() > 0.0 && law.band() > 0.0);
            }
            assert_eq!(NAMES.iter().filter(|name| **name == entry.name).count(), 1);
        }
    }
}
