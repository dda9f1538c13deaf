//! D6, X5: a material point turned ten thousand times keeps its stress.

use fissure::prelude::*;
use fissure::tensor::rotation;

const TURNS: u32 = 10_000;
const STEPS_A_TURN: u32 = 1000;
const YOUNG: f64 = 24.9e9;

/// Turns a strained point and returns the largest change of its stress, seen in its own frame,
/// over Young's modulus.
fn drift<M: Material>(law: &M, strain: f64) -> f64 {
    let mut stretch = Matrix3::identity();
    stretch.m11 += strain;
    stretch.m12 += 0.3 * strain;
    stretch.m21 += 0.3 * strain;
    let mut increment = Increment::to(stretch);
    increment.band = Band::Uniform(0.01);
    let first = law.update(&increment, &law.initial()).unwrap();
    let quarter = rotation(
        &Vector3::z(),
        std::f64::consts::TAU / f64::from(STEPS_A_TURN),
    );
    let (mut state, mut worst) = (first.state, 0.0_f64);
    let mut turn = Matrix3::identity();
    for _ in 0..TURNS {
        // Products drift by round-off: every turn starts from the identity.
        turn.fill_with_identity();
        for _ in 0..STEPS_A_TURN {
            turn *= quarter;
            increment.f_old = increment.f_new;
            increment.f_new = turn * stretch;
            let response = law.update(&increment, &state).unwrap();
            state = response.state;
            let seen = response.stress.rotated(&turn.transpose());
            let change = (seen - first.stress).max_abs() / YOUNG;
            // `max` would drop a NaN.
            if !(change <= worst) {
                worst = change;
            }
        }
    }
    worst
}

#[test]
fn x5_ten_thousand_turns_of_a_cracked_point_keep_its_stress() {
    let law = Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: YOUNG,
            poisson: 0.18,
        },
        strength: 2.7e6,
        toughness: 61.35,
        softening: softening::Linear,
        normal: Normal::Rankine,
    };
    let worst = drift(&law, 1e-3);
    println!("cracked point, {TURNS} turns: {worst:.1e} E");
    assert!(worst <= 1e-9, "{worst:e}");
}

#[test]
fn x5_ten_thousand_turns_of_an_elastic_point_keep_its_stress() {
    let elastic = Isotropic {
        density: 2350.0,
        young: YOUNG,
        poisson: 0.18,
    };
    let worst = drift(&Hencky { elastic }, 1e-2);
    println!("elastic point, {TURNS} turns: {worst:.1e} E");
    assert!(worst <= 1e-9, "{worst:e}");
}
