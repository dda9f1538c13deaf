mod battery;
mod flow;
mod paths;
mod single;

use super::*;
use crate::{Material, criteria::Geological, softening::Linear};

const CONCRETE: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};

const CHOICES: [(Unloading, Shear); 6] = [
    (Unloading::Permanent, Shear::Elastic),
    (Unloading::Permanent, Shear::Coulomb(0.0)),
    (Unloading::Permanent, Shear::Damaged(0.0)),
    (Unloading::Secant, Shear::Elastic),
    (Unloading::Secant, Shear::Coulomb(0.0)),
    (Unloading::Secant, Shear::Damaged(0.0)),
];

fn law<const N: usize>(
    unloading: Unloading,
    shear: Shear,
    planes: Planes,
) -> MultiCrack<N, ModeOne> {
    MultiCrack {
        elastic: CONCRETE,
        decohesion: ModeOne {
            strength: 2.7e6,
            toughness: 61.35,
            softening: Linear,
            unloading,
            shear,
        },
        planes,
    }
}

fn geological<const N: usize>(
    friction: Option<f64>,
    planes: Planes,
) -> MultiCrack<N, GeologicalFlow> {
    MultiCrack {
        elastic: CONCRETE,
        decohesion: GeologicalFlow {
            surface: Geological::CONCRETE,
            toughness: 61.35,
            softening: Linear,
            friction,
        },
        planes,
    }
}

fn step_to(from: &Sym, to: &Sym, band: Band) -> Increment {
    let gradient = |strain: &Sym| Matrix3::identity() + strain.to_matrix();
    Increment {
        f_old: gradient(from),
        band,
        ..Increment::to(gradient(to))
    }
}
