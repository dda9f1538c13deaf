//! What one update costs against neo-Hookean elasticity, measured in one run on one core.
//!
//! `cargo run --release -p fissure-materials --example decohesive_cost`
//!
//! Every figure is the smallest of nine rounds over 4096 states, 95 % of them below 0.7 of the
//! strength, divided by that of the neo-Hookean law over the same deformation gradients.

use std::{hint::black_box, time::Instant};

use fissure_materials::{
    Band, Decohesive, Increment, Isotropic, Material, MaterialError, Matrix3, NeoHookean, Normal,
    contract::Random, softening::Linear,
};

const STATES: usize = 4096;
const ROUNDS: usize = 9;
const CONCRETE: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};
const STRENGTH: f64 = 2.7e6;

fn main() -> Result<(), MaterialError> {
    let rankine = Decohesive {
        elastic: CONCRETE,
        strength: STRENGTH,
        toughness: 61.35,
        softening: Linear,
        normal: Normal::Rankine,
    };
    let neo_hookean = NeoHookean {
        density: CONCRETE.density,
        young: CONCRETE.young,
        poisson: CONCRETE.poisson,
    };
    println!("law, plane gradients, full gradients");
    let mut base = [0.0; 2];
    for (slot, plane) in [true, false].into_iter().enumerate() {
        base[slot] = time(&neo_hookean, &increments(plane, 0.7))?;
    }
    println!("neo-Hookean, {:.1} ns, {:.1} ns", base[0], base[1]);
    row("mode I", &rankine, base)?;
    Ok(())
}

fn row<M: Material>(name: &str, law: &M, base: [f64; 2]) -> Result<(), MaterialError> {
    let plane = time(law, &increments(true, 0.7))? / base[0];
    let full = time(law, &increments(false, 0.7))? / base[1];
    println!("{name}, {plane:.2}, {full:.2}");
    Ok(())
}

/// Strains of any direction, 95 % with a first principal stress below `share` of the strength.
fn increments(plane: bool, share: f64) -> Vec<Increment> {
    let mut random = Random::new(11);
    let mut strain = || {
        let direction = random.strain_direction(false);
        let mut m = direction.to_matrix();
        if plane {
            for (row, column) in [(0, 2), (1, 2), (2, 0), (2, 1), (2, 2)] {
                m[(row, column)] = 0.0;
            }
        }
        let stress = CONCRETE.stress(&fissure_materials::Sym::from_matrix(&m));
        let largest = stress.spectrum().values[0].abs().max(1e-3 * CONCRETE.young);
        let level = random.uniform(0.0, share / 0.95);
        let turn = random.uniform(0.0, 1e-3);
        let mut spin = Matrix3::identity();
        spin.m12 = turn;
        spin.m21 = -turn;
        spin * (Matrix3::identity() + m * (level * STRENGTH / largest))
    };
    (0..STATES)
        .map(|_| Increment {
            band: Band::Projected([0.01; 3]),
            ..Increment::to(strain())
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
