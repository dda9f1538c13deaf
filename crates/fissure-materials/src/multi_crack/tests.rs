use super::*;
use crate::{contract, softening::Linear};

const CONCRETE: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};

fn mode_one(unloading: Unloading, shear: Shear) -> ModeOne {
    ModeOne {
        strength: 2.7e6,
        toughness: 61.35,
        softening: Linear,
        unloading,
        shear,
    }
}

fn law<const N: usize>(
    unloading: Unloading,
    shear: Shear,
    planes: Planes,
) -> MultiCrack<N, ModeOne> {
    MultiCrack {
        elastic: CONCRETE,
        decohesion: mode_one(unloading, shear),
        planes,
    }
}

const CHOICES: [(Unloading, Shear); 6] = [
    (Unloading::Permanent, Shear::Elastic),
    (Unloading::Permanent, Shear::Coulomb(0.0)),
    (Unloading::Permanent, Shear::Damaged(0.0)),
    (Unloading::Secant, Shear::Elastic),
    (Unloading::Secant, Shear::Coulomb(0.0)),
    (Unloading::Secant, Shear::Damaged(0.0)),
];

#[test]
fn a_fixed_plane_passes_the_battery_of_cracks() {
    for (unloading, shear) in CHOICES {
        let law = law::<1>(unloading, shear, Planes::Fixed);
        if let Err(violation) = contract::check_cracking(&law) {
            eprintln!("XX {unloading:?} {shear:?} cracking: {violation}");
        }
    }
}

#[test]
fn friction_passes_the_battery() {
    for (unloading, shear) in [
        (Unloading::Permanent, Shear::Coulomb(0.5)),
        (Unloading::Secant, Shear::Damaged(0.5)),
    ] {
        let law = law::<1>(unloading, shear, Planes::Fixed);
        if let Err(violation) = contract::check_cracking(&law) {
            eprintln!("XX {unloading:?} {shear:?} friction: {violation}");
        }
    }
}

#[test]
fn several_planes_pass_the_battery() {
    for (unloading, shear) in CHOICES {
        let law = law::<6>(unloading, shear, Planes::Multiple(None));
        if let Err(violation) = contract::check_cracking(&law) {
            eprintln!("XX {unloading:?} {shear:?} several: {violation}");
        }
    }
}
#[test]
fn rotating_passes_the_battery() {
    for unloading in [Unloading::Permanent, Unloading::Secant] {
        let law = law::<1>(unloading, Shear::Elastic, Planes::Rotating);
        if let Err(violation) = contract::check_cracking(&law) {
            eprintln!("XX {unloading:?} rotating: {violation}");
        }
    }
}
