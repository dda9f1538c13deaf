//! What one update costs against neo-Hookean elasticity, measured in one run on one core.
//!
//! `cargo run --release -p fissure-materials --example decohesive_cost`
//!
//! Every figure is the smallest of nine rounds over 4096 steps from the undamaged state, divided by
//! that of the neo-Hookean law over the same deformation gradients. "Sound": 95 % of the first
//! principal stresses below 0.7 of the strength; "near the surface": between 0.9 and 1 of it;
//! "cracking": all between 2 and 20 strengths.

#![allow(clippy::print_stdout)] // the point of it

use std::{hint::black_box, time::Instant};

use fissure_materials::{
    Band, Decohesive, Increment, Isotropic, Material, MaterialError, Matrix3, NeoHookean, Normal,
    Sym,
    contract::Random,
    criteria::Geological,
    multi_crack::{GeologicalFlow, ModeOne, MultiCrack, Planes, Shear, Unloading},
    softening::Linear,
};

const STATES: usize = 4096;
const ROUNDS: usize = 9;
const CONCRETE: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};
const STRENGTH: f64 = 2.7e6;

/// Levels of the first principal stress over the strength.
const LEVELS: [(&str, f64, f64); 3] = [
    ("sound", 0.0, 0.7 / 0.95),
    ("near the surface", 0.9, 1.0),
    ("cracking", 2.0, 20.0),
];

fn main() -> Result<(), MaterialError> {
    let single = Decohesive {
        elastic: CONCRETE,
        strength: STRENGTH,
        toughness: 61.35,
        softening: Linear,
        normal: Normal::Rankine,
    };
    let one = MultiCrack::<1, _> {
        elastic: CONCRETE,
        decohesion: mode_one(),
        planes: Planes::Fixed,
    };
    let six = several::<6>();
    let twenty = several::<20>();
    let flow = MultiCrack::<1, _> {
        elastic: CONCRETE,
        decohesion: GeologicalFlow {
            surface: Geological::CONCRETE,
            toughness: 61.35,
            softening: Linear,
            friction: None,
        },
        planes: Planes::Fixed,
    };
    println!("law, states, plane gradients, full gradients");
    for (name, low, high) in LEVELS {
        let sets = [true, false].map(|plane| increments(plane, low, high));
        let base = base(&sets)?;
        row("mode I", name, &single, &sets, base)?;
        row("one plane of MultiCrack", name, &one, &sets, base)?;
        row("6 planes", name, &six, &sets, base)?;
        row("20 planes", name, &twenty, &sets, base)?;
        row("geological flow", name, &flow, &sets, base)?;
    }
    Ok(())
}

fn mode_one() -> ModeOne {
    ModeOne {
        strength: STRENGTH,
        toughness: 61.35,
        softening: Linear,
        unloading: Unloading::Permanent,
        shear: Shear::Coulomb(0.0),
    }
}

fn several<const N: usize>() -> MultiCrack<N, ModeOne> {
    MultiCrack {
        elastic: CONCRETE,
        decohesion: mode_one(),
        planes: Planes::Multiple(None),
    }
}

fn base(sets: &[Vec<Increment>; 2]) -> Result<[f64; 2], MaterialError> {
    let neo_hookean = NeoHookean {
        density: CONCRETE.density,
        young: CONCRETE.young,
        poisson: CONCRETE.poisson,
    };
    Ok([time(&neo_hookean, &sets[0])?, time(&neo_hookean, &sets[1])?])
}

fn row<M: Material>(
    name: &str,
    states: &str,
    law: &M,
    sets: &[Vec<Increment>; 2],
    base: [f64; 2],
) -> Result<(), MaterialError> {
    let [plane, full] = [
        time(law, &sets[0])? / base[0],
        time(law, &sets[1])? / base[1],
    ];
    println!("{name}, {states}, {plane:.2}, {full:.2}");
    Ok(())
}

/// Strains of any direction with a first principal stress between two shares of the strength.
fn increments(plane: bool, low: f64, high: f64) -> Vec<Increment> {
    let mut random = Random::new(11);
    let mut gradient = || {
        let mut strain = random.strain_direction(false).to_matrix();
        if plane {
            for (row, column) in [(0, 2), (1, 2), (2, 0), (2, 1), (2, 2)] {
                strain[(row, column)] = 0.0;
            }
        }
        let stress = CONCRETE.stress(&Sym::from_matrix(&strain));
        let largest = stress.spectrum().values[0].abs().max(0.05 * CONCRETE.young);
        let level = random.uniform(low, high) * STRENGTH / largest;
        let turn = random.uniform(0.0, 1e-3);
        let mut spin = Matrix3::identity();
        (spin.m12, spin.m21) = (turn, -turn);
        spin * (Matrix3::identity() + strain * level)
    };
    (0..STATES)
        .map(|_| Increment {
            band: Band::Projected([0.01; 3]),
            ..Increment::to(gradient())
        })
        .collect()
}

/// Nanoseconds per update.
fn time<M: Material>(law: &M, increments: &[Increment]) -> Result<f64, MaterialError> {
    let state = law.initial();
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        for increment in increments {
            black_box(law.update(black_box(increment), black_box(&state))?);
        }
        best = best.min(start.elapsed().as_secs_f64() / increments.len() as f64);
    }
    Ok(best * 1e9)
}
