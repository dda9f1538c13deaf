//! Every law that the studies know. A new law is one [`Entry`] here; `point`, `laws` and
//! `isoerror` then have it, in space and, where it makes sense, in plane stress.

mod anisotropic;
mod decohesive;
mod elastic;
mod inelastic;
mod parameters;

use super::law::{Law, Space};
use super::parameter::{LawParameter, Values};

/// A law with its parameters.
#[derive(Debug)]
pub struct Entry {
    /// The name on the command line, in lower case with hyphens.
    pub name: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
    /// Its parameters with its own values.
    pub parameters: &'static [LawParameter],
    /// Whether it is offered in plane stress: where that makes sense and passes the contract.
    pub plane_stress: bool,
    /// The law of some values; its parameters are checked by the one who asks.
    pub build: fn(&Values<'_>, Space) -> Box<dyn Law>,
}

/// Every law. Not a constant: that would be compiled, with all laws, once more in each crate that names it.
pub static LAWS: &[Entry] = &[
    elastic::ISOTROPIC,
    elastic::HENCKY,
    elastic::NEO_HOOKEAN,
    elastic::ORTHOTROPIC,
    elastic::THERMAL_HENCKY,
    elastic::JWL,
    inelastic::J2_LINEAR,
    inelastic::J2_VOCE,
    inelastic::J2_TABLE,
    inelastic::VISCOUS_DAMAGE,
    inelastic::SCALAR_DAMAGE,
    inelastic::MAZARS,
    decohesive::LINEAR,
    decohesive::BILINEAR,
    decohesive::POWER_LAW,
    decohesive::EXPONENTIAL,
    decohesive::CUBIC_STEP,
    decohesive::DOUBLE_EXPONENTIAL,
    decohesive::LOWERED,
    decohesive::THERMAL,
    decohesive::FIXED_PLANE,
    decohesive::SEVERAL_PLANES,
    decohesive::ROTATING_PLANE,
    decohesive::GEOLOGICAL,
    decohesive::GEOLOGICAL_PLANES,
    anisotropic::ANISOTROPIC,
    anisotropic::IN_PLANE,
    anisotropic::TWO_CRACKS,
    anisotropic::CONJUGATE,
    anisotropic::CONJUGATE_TWO_CRACKS,
    anisotropic::ELLIPTICAL,
    anisotropic::STEPPED,
    anisotropic::ORTHOTROPIC,
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

impl Entry {
    /// Whether the law is offered there.
    pub fn is_for(&self, space: Space) -> bool {
        space == Space::Solid || self.plane_stress
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
                if !entry.is_for(space) {
                    continue;
                }
                let law = (entry.build)(&Values::own(entry), space);
                assert!(law.check().is_ok(), "{}: {:?}", entry.name, law.check());
                assert!(law.natural_strain() > 0.0 && law.band() > 0.0);
            }
            assert_eq!(NAMES.iter().filter(|name| **name == entry.name).count(), 1);
        }
    }
}
