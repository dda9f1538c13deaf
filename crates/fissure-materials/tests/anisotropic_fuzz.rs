//! Anisotropic damage under random steps of any size (X4): no NaN, no panic, no negative
//! dissipation, nothing that falls, hardly an error.
//!
//! `FISSURE_FUZZ=10000000 cargo test --release -p fissure-materials --test anisotropic_fuzz -- --nocapture`

#![allow(clippy::print_stdout, clippy::panic)] // figures for the docs

use fissure_materials::{
    AnisotropicDamage, Band, ConjugateDamage, Cracking, DamagePlane, EllipticalDamage, Increment,
    Isotropic, Material, Matrix3, MixedMode, Mode, Onset, OrthotropicDamage, PlaneStress,
    SteppedCircleDamage, Tangent, TwoCrackDamage, Vector3, contract::Random, softening::Linear,
};
use fissure_tensor::Matrix6;

fn law() -> AnisotropicDamage {
    let mode = |strength, toughness| Mode {
        strength,
        toughness,
        softening: Linear,
    };
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e9,
        poisson: 0.33,
    };
    AnisotropicDamage::new(elastic, mode(3e6, 1e3), mode(2e6, 1.5e3))
}

#[derive(Debug, Default)]
struct Counts {
    updates: usize,
    typed_errors: usize,
    not_finite: usize,
    negative_dissipation: usize,
    irreversibility_violations: usize,
    cracked: usize,
    failed: usize,
}

/// Random walks of up to 30 steps in `F`, restarted when `det F` leaves 0.2 to 5.
fn fuzz<M: Cracking>(law: &M, plane: bool, updates: usize) -> Counts {
    let mut random = Random::new(17);
    let mut counts = Counts::default();
    while counts.updates < updates {
        let width = random.log_uniform(1e-4, 0.99 * law.band_limit(&Default::default()));
        let mut band = random.band(width);
        if plane {
            band = Band::Uniform(width);
        }
        let (mut f_old, mut state) = (Matrix3::identity(), law.initial());
        for _ in 0..30 {
            let mut change = random.strain_direction(true).to_matrix();
            let mut turn = random.rotation();
            if plane {
                for i in 0..3 {
                    (change[(i, 2)], change[(2, i)]) = (0.0, 0.0);
                }
                turn = Matrix3::identity();
            }
            if random.chance(0.5) {
                turn = Matrix3::identity();
            }
            let size = random.log_uniform(1e-12, 10.0);
            let f_new = turn * (Matrix3::identity() + change * size) * f_old;
            let determinant = f_new.determinant();
            if !(0.2..=5.0).contains(&determinant) {
                break;
            }
            let increment = Increment {
                f_old,
                band,
                ..Increment::to(f_new)
            };
            counts.updates += 1;
            let Ok(response) = law.update(&increment, &state) else {
                counts.typed_errors += 1;
                break;
            };
            let finite = response.stress.is_finite()
                && response.stored.is_finite()
                && response.dissipated.is_finite();
            counts.not_finite += usize::from(!finite);
            counts.negative_dissipation += usize::from(!(response.dissipated >= 0.0));
            let (before, now) = (law.irreversible(&state), law.irreversible(&response.state));
            let falls = before.iter().zip(&now).any(|(b, n)| !(n >= b));
            counts.irreversibility_violations += usize::from(falls);
            let cracks = law.cracks(&response.state);
            counts.cracked += usize::from(!cracks.is_empty());
            counts.failed += usize::from(cracks.iter().any(|crack| crack.failed));
            (f_old, state) = (f_new, response.state);
        }
    }
    counts
}

fn holds<M: Cracking>(name: &str, law: &M, plane: bool) {
    let updates = std::env::var("FISSURE_FUZZ")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(50_000);
    let counts = fuzz(law, plane, updates);
    println!("{name}: {counts:?}");
    assert_eq!(counts.not_finite, 0, "{name}");
    assert_eq!(counts.negative_dissipation, 0, "{name}");
    assert_eq!(counts.irreversibility_violations, 0, "{name}");
    assert!(counts.typed_errors * 100 <= counts.updates, "{name}");
    assert!(
        counts.cracked * 2 > counts.updates && counts.failed > 0,
        "{name}"
    );
}

#[test]
fn any_step_in_space() {
    holds("mixed mode", &law(), false);
    let uncoupled = AnisotropicDamage {
        mixed: MixedMode::Uncoupled,
        friction: 0.6,
        ..law()
    };
    holds("uncoupled, friction", &uncoupled, false);
}

/// Stiffness like a softwood's, three planes.
#[test]
fn any_step_of_orthotropic_material() {
    let mut stiffness = Matrix6::from_diagonal(&[12e9, 1.1e9, 0.8e9, 0.1e9, 1.4e9, 2.0e9].into());
    for (i, j, value) in [(0, 1, 0.6e9), (0, 2, 0.5e9), (1, 2, 0.4e9)] {
        stiffness[(i, j)] = value;
        stiffness[(j, i)] = value;
    }
    let plane = |normal| DamagePlane {
        normal,
        opening: law().opening,
        shear: law().shear,
    };
    let wood = OrthotropicDamage {
        density: 500.0,
        stiffness: Tangent(stiffness),
        planes: [Vector3::x(), Vector3::y(), Vector3::z()].map(plane),
        mixed: MixedMode::default(),
    };
    holds("orthotropic", &wood, false);
}

/// The variants for comparison: every solve is bracketed, so that it always returns.
#[test]
fn any_step_of_the_ellipse_and_the_stepped_circle() {
    holds("ellipse", &EllipticalDamage::new(law()), false);
    holds("stepped circle", &SteppedCircleDamage::new(law()), false);
}

#[test]
fn any_step_of_two_cracks() {
    holds("two cracks", &TwoCrackDamage(law()), false);
    let uncoupled = AnisotropicDamage {
        mixed: MixedMode::Uncoupled,
        ..law()
    };
    holds("two cracks, uncoupled", &TwoCrackDamage(uncoupled), false);
    let conjugate = ConjugateDamage(TwoCrackDamage(law()));
    holds("two cracks, conjugate", &conjugate, false);
    let sheet = PlaneStress(TwoCrackDamage(law()));
    holds("two cracks, plane stress", &sheet, true);
}

#[test]
fn any_step_in_plane_stress() {
    let plane = AnisotropicDamage {
        onset: Onset::InPlane,
        ..law()
    };
    holds("plane stress", &PlaneStress(plane), true);
}

/// X15: units from 1e-300 to 1e300.
#[test]
fn any_unit() {
    for exponent in [-300, -150, 150, 290] {
        let unit = 10f64.powi(exponent);
        let mut scaled = law();
        scaled.elastic.young *= unit;
        scaled.elastic.density *= unit;
        for (strength, toughness) in [
            (&mut scaled.opening.strength, &mut scaled.opening.toughness),
            (&mut scaled.shear.strength, &mut scaled.shear.toughness),
        ] {
            *strength *= unit;
            *toughness *= unit;
        }
        let mut f = Matrix3::identity();
        for strain in [1e-3, 1e-2, 0.1, -0.1] {
            f.m11 = 1.0 + strain;
            f.m12 = strain;
            let increment = Increment {
                band: Band::cube(1e-2),
                ..Increment::to(f)
            };
            if let Ok(response) = scaled.update(&increment, &scaled.initial()) {
                assert!(
                    response.stress.is_finite() && response.dissipated >= 0.0,
                    "{unit:e}"
                );
            }
        }
    }
}
