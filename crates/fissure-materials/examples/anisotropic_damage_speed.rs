//! Time of an update of the anisotropic damage law over that of neo-Hookean elasticity, in one run.
//! `cargo run --release -p fissure-materials --example anisotropic_damage_speed`
#![allow(clippy::print_stdout)] // what this example is for

use std::hint::black_box;
use std::time::Instant;

use fissure_materials::{
    AnisotropicDamage, Band, Increment, Isotropic, Material, MaterialError, Matrix3, Mode,
    NeoHookean, contract::Random, softening::Linear,
};

const COUNT: usize = 4096;

const ELASTIC: Isotropic = Isotropic {
    density: 1000.0,
    young: 1e9,
    poisson: 0.33,
};

fn law() -> AnisotropicDamage {
    let mode = |strength, toughness| Mode {
        strength,
        toughness,
        softening: Linear,
    };
    AnisotropicDamage::new(ELASTIC, mode(3e6, 1e3), mode(2e6, 1.5e3))
}

/// Steps from states that the law has come to, 95 % of `levels` below 0.7 of the strength or all
/// with a growing crack.
fn steps<M: Material>(
    law: &M,
    random: &mut Random,
    plane: bool,
    damaging: bool,
) -> Result<Vec<(Increment, M::State)>, MaterialError> {
    let mut steps = Vec::with_capacity(COUNT);
    for index in 0..COUNT {
        let mut direction = random.strain_direction(false).to_matrix();
        let mut turn = random.rotation();
        if plane {
            for i in 0..2 {
                direction[(i, 2)] = 0.0;
                direction[(2, i)] = 0.0;
            }
            direction.m33 = 0.0;
            turn = fissure_tensor::rotation(&fissure_materials::Vector3::z(), 0.3);
        }
        // The strain of the largest stress at the strength.
        let size = 3e6 / ELASTIC.p_wave_modulus();
        let (before, after) = if damaging {
            let level = random.uniform(1.5, 3.0) * size;
            (level, 1.05 * level)
        } else {
            let most = if index % 20 == 0 { 1.0 } else { 0.6 };
            let level = random.uniform(0.0, most) * size;
            (level, level)
        };
        let gradient = |level: f64| turn * (Matrix3::identity() + direction * level);
        let band = Band::Projected([1e-3; 3]);
        let to = |f_old, f_new| Increment {
            f_old,
            band,
            ..Increment::to(f_new)
        };
        let (start, end) = (gradient(before), gradient(after));
        let mut state = law.initial();
        if damaging {
            state = law.update(&to(turn, start), &state)?.state;
        }
        steps.push((to(start, end), state));
    }
    Ok(steps)
}

/// Nanoseconds per update, the least of many rounds.
fn time<M: Material>(law: &M, steps: &[(Increment, M::State)]) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..200 {
        let start = Instant::now();
        for (increment, state) in steps {
            let _ = black_box(law.update(black_box(increment), black_box(state)));
        }
        best = best.min(start.elapsed().as_secs_f64());
    }
    best / steps.len() as f64 * 1e9
}

fn main() -> Result<(), MaterialError> {
    let elastic = NeoHookean {
        density: 1000.0,
        young: 1e9,
        poisson: 0.33,
    };
    for plane in [true, false] {
        let mut random = Random::new(1);
        let baseline = steps(&elastic, &mut random, plane, false)?;
        let sound = steps(&law(), &mut random, plane, false)?;
        let damaging: Vec<_> = steps(&law(), &mut random, plane, true)?
            .into_iter()
            .filter(|(increment, state)| {
                let response = law().update(increment, state);
                response.is_ok_and(|r| r.dissipated > 0.0 && state.width > 0.0)
            })
            .collect();
        let base = time(&elastic, &baseline);
        let (a, b) = (time(&law(), &sound), time(&law(), &damaging));
        println!(
            "{}: neo-Hookean {base:.1} ns; sound {a:.1} ns, ratio {:.2}; damaging ({} steps) {b:.1} ns, ratio {:.2}",
            if plane { "plane" } else { "space" },
            a / base,
            damaging.len(),
            b / base
        );
    }
    println!(
        "state: {} bytes",
        size_of::<<AnisotropicDamage as Material>::State>()
    );
    Ok(())
}
