use super::*;
use crate::contract::{self, Random};
use crate::hardening::{Linear, Table, Voce};
use crate::localization::{Directions, localization_of};
use crate::testing::{assert_wave_speed, gradients, tangent_error};
use crate::{Axis, Band, Hencky, Path, PlaneStress, Point, PointError};

const STEEL: Isotropic = Isotropic {
    density: 7800.0,
    young: 210e9,
    poisson: 0.3,
};
const VOCE: Voce = Voce {
    yield_stress: 300e6,
    saturation: 150e6,
    rate: 16.0,
    modulus: 0.2e9,
};

fn linear(modulus: f64) -> J2<Linear> {
    J2 {
        elastic: STEEL,
        hardening: Linear {
            yield_stress: 300e6,
            modulus,
        },
    }
}

fn voce() -> J2<Voce> {
    J2 {
        elastic: STEEL,
        hardening: VOCE,
    }
}

fn table() -> J2<Table> {
    let points = [(0.0, 300e6), (0.01, 340e6), (0.05, 400e6), (0.2, 450e6)];
    J2 {
        elastic: STEEL,
        hardening: Table::new(points).expect("a sound table"),
    }
}

fn passes(law: &impl Material) {
    let summary = contract::check(law).map_err(|violation| violation.to_string());
    let step_error = summary.map(|summary| summary.step_error);
    println!("one step against many: {step_error:?}");
    assert_eq!(step_error.err().unwrap_or_default(), "");
}

/// P1-P3, P6, P9-P12, P19, P20, P22, P24.
#[test]
fn every_hardening_passes_the_battery() {
    passes(&linear(0.0));
    passes(&linear(2e9));
    passes(&voce());
    passes(&table());
}

/// In uniaxial stress `ln λ = σ(α)/E + α` and `τ = σ(α)`, in one step or many.
#[test]
fn tension_follows_the_hardening_curve() -> Result<(), PointError> {
    for steps in [1, 7, 100] {
        let path = Path::new(Band::cube(1e-3)).uniaxial(Axis::X, 0.25, steps);
        let law = voce();
        let samples = Point::new(&law)?.drive(&path)?;
        let end = samples.last().expect("there are steps");
        let jacobian = end.deformation_gradient().determinant();
        let alpha = end.state.equivalent;
        let tension = jacobian * end.stress.xx();
        assert!((tension / VOCE.stress(alpha) - 1.0).abs() < 1e-9);
        let log = VOCE.stress(alpha) / STEEL.young + alpha;
        assert!((log / 1.25_f64.ln() - 1.0).abs() < 1e-9, "{log}");
        // Lateral strain: elastic by Poisson's ratio, plastic without change of volume.
        let lateral = -STEEL.poisson * VOCE.stress(alpha) / STEEL.young - 0.5 * alpha;
        assert!((lateral / (1.0 + end.strain.yy()).ln() - 1.0).abs() < 1e-9);
    }
    Ok(())
}

/// The same in plane stress, where the thickness is found by iteration.
#[test]
fn plane_stress_tension_follows_the_hardening_curve() -> Result<(), PointError> {
    let path = Path::new(Band::cube(1e-3)).uniaxial(Axis::X, 0.1, 20);
    let law = PlaneStress(voce());
    let samples = Point::new(&law)?.drive(&path)?;
    let end = samples.last().expect("there are steps");
    let jacobian = end.deformation_gradient().determinant();
    let alpha = end.state.inner.equivalent;
    let tension = jacobian * end.stress.xx();
    assert!((tension / VOCE.stress(alpha) - 1.0).abs() < 1e-9);
    let log = VOCE.stress(alpha) / STEEL.young + alpha;
    assert!((log / 1.1_f64.ln() - 1.0).abs() < 1e-9, "{log}");
    Ok(())
}

/// Along one direction the law books the work to the last digit in one step:
/// `W = ψ + ∫σ(0)` with the closed form of eq. 5 at the end.
#[test]
fn energies_of_uniaxial_tension_are_closed() -> Result<(), PointError> {
    let path = Path::new(Band::cube(1e-3)).uniaxial(Axis::X, 0.1, 1);
    let law = voce();
    let samples = Point::new(&law)?.drive(&path)?;
    let (end, alpha) = (&samples[0], samples[0].state.equivalent);
    let stress = VOCE.stress(alpha);
    let stored = 0.5 * stress * stress / STEEL.young + VOCE.work(alpha) - VOCE.yield_stress * alpha;
    assert!(
        (end.stored / stored - 1.0).abs() < 1e-9,
        "{} {stored}",
        end.stored
    );
    assert!((end.dissipated / (VOCE.yield_stress * alpha) - 1.0).abs() < 1e-12);
    Ok(())
}

#[test]
fn below_yield_it_is_hencky_elasticity() -> Result<(), MaterialError> {
    let hard = J2 {
        elastic: STEEL,
        hardening: Linear {
            yield_stress: 1e15,
            modulus: 0.0,
        },
    };
    let hencky = Hencky { elastic: STEEL };
    for f in gradients() {
        let increment = Increment::to(f);
        let (ours, theirs) = (
            hard.update(&increment, &J2State::default())?,
            hencky.update(&increment, &())?,
        );
        let bound = 1e-14 * STEEL.young;
        assert!((ours.stress - theirs.stress).max_abs() <= bound);
        assert!((ours.stored - theirs.stored).abs() <= bound);
        let gap =
            hard.tangent(&increment, &J2State::default())? - hencky.tangent(&increment, &())?;
        assert!(gap.max_abs() <= 1e-13 * STEEL.young);
    }
    Ok(())
}

/// P3 and the wave speed at large strain, from rest and from a flowed state.
#[test]
fn tangent_and_wave_speed_hold_at_large_strain() -> Result<(), MaterialError> {
    let law = voce();
    let all = gradients();
    let mut largest: f64 = 0.0;
    for start in &all {
        let old = law.update(&Increment::to(*start), &law.initial())?.state;
        for end in &all {
            if start == end {
                continue; // on the yield surface, where the tangent jumps
            }
            let increment = Increment::to(*end);
            largest = largest.max(tangent_error(&law, &increment, &old)?);
            let state = law.update(&increment, &old)?.state;
            assert_wave_speed(&law, end, &state, f64::INFINITY)?;
        }
    }
    println!("largest error of the tangent: {largest:.1e}");
    assert!(largest <= 1e-8);
    Ok(())
}

/// P4: associated, so the tangent is symmetric, flowing or not.
#[test]
fn the_tangent_is_symmetric() -> Result<(), MaterialError> {
    let law = table();
    for f in gradients() {
        let tangent = law.tangent(&Increment::to(f), &law.initial())?;
        let skew = (tangent - tangent.symmetric_part()).max_abs();
        assert!(skew <= 1e-14 * tangent.max_abs(), "{skew:e}");
    }
    Ok(())
}

/// P5 (yield and flow conditions after every update), P6, P7, X4 and typed errors along random
/// walks with steps between 1e-12 and 10; `Cᵖ` keeps its volume.
#[test]
fn random_walks_stay_admissible() {
    let law = voce();
    let mut random = Random::new(7);
    let (mut updates, mut refused, mut within, mut drift) = (0, 0, 0, 0.0_f64);
    for _ in 0..2000 {
        let (mut state, mut f) = (law.initial(), Matrix3::identity());
        for _ in 0..20 {
            let size = random.log_uniform(1e-12, 10.0);
            let part = random.strain_direction(true).to_matrix() * size;
            let next = random.rotation() * (Matrix3::identity() + part) * f;
            let determinant = next.determinant();
            let admissible = (0.2..=5.0).contains(&determinant);
            let increment = Increment::to(f).with_end(next);
            updates += 1;
            within += usize::from(admissible);
            let Ok(response) = law.update(&increment, &state) else {
                refused += usize::from(admissible);
                continue;
            };
            assert!(response.stress.is_finite() && response.dissipated >= 0.0);
            assert!(response.state.equivalent >= state.equivalent);
            let tangent = law.tangent(&increment, &state);
            assert!(tangent.is_ok_and(|tangent| tangent.is_finite()));
            let limit = VOCE.stress(response.state.equivalent);
            let mises = determinant * response.stress.von_mises();
            let trial = law.trial(&next, &response.state).expect("it was updated");
            let shear = STEEL.shear_modulus();
            let round_off = 4.0 * slack(&trial, &next, &response.state, shear, limit)
                + 1e-14 * determinant * response.stress.max_abs();
            assert!(mises <= limit + round_off, "{mises} {limit} {round_off}");
            if admissible {
                (state, f) = (response.state, next);
                let volume = (Sym::IDENTITY + state.plastic).determinant();
                let scale = (1.0 + state.plastic.norm()).powi(3);
                drift = drift.max((volume - 1.0).abs() / scale);
            }
        }
    }
    println!("{updates} updates, {within} with det F in [0.2, 5], {refused} of those refused");
    println!("largest |det Cp - 1| over its condition: {drift:e}");
    assert!(refused * 100 <= within);
    assert!(drift < 1e-13);
}

/// P6 in the large: what is booked converges to the work with the second power of the step.
#[test]
fn the_ledger_closes_at_second_order() -> Result<(), MaterialError> {
    let law = voce();
    let imbalance = |steps: usize| -> Result<f64, MaterialError> {
        let at = |t: f64| {
            let stretch = Sym::new(0.05 * t, -0.02 * t, 0.0, 0.0, 0.0, 0.04 * (3.0 * t).sin());
            Matrix3::identity() + stretch.to_matrix()
        };
        let (mut state, mut work, mut dissipated) = (law.initial(), 0.0, 0.0);
        let mut f_old = at(0.0);
        let (mut first_piola, mut stored) = (Matrix3::zeros(), 0.0);
        for step in 1..=steps {
            let f = at(step as f64 / steps as f64);
            let response = law.update(&Increment::to(f_old).with_end(f), &state)?;
            let inverse = f.try_inverse().unwrap_or_default();
            let next = response.stress.to_matrix() * inverse.transpose() * f.determinant();
            work += ((first_piola + next) * 0.5).dot(&(f - f_old));
            dissipated += response.dissipated;
            (state, stored, f_old, first_piola) = (response.state, response.stored, f, next);
        }
        Ok((stored + dissipated - work).abs() / work)
    };
    let (coarse, fine) = (imbalance(200)?, imbalance(1600)?);
    println!("imbalance over work: {coarse:e} in 200 steps, {fine:e} in 1600");
    assert!(fine < 1e-5 && fine < coarse / 30.0);
    Ok(())
}

/// P24.
#[test]
fn parameters_out_of_range_are_refused() {
    let refused = |law: &J2<Voce>, name: &str| {
        let refusal = law.check();
        assert!(
            matches!(refusal, Err(MaterialError::Parameter { parameter, .. }) if parameter == name),
            "{name}: {refusal:?}"
        );
    };
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let with = |hardening| J2 {
            elastic: STEEL,
            hardening,
        };
        refused(
            &with(Voce {
                yield_stress: bad,
                ..VOCE
            }),
            "yield_stress",
        );
        refused(
            &with(Voce {
                saturation: bad,
                ..VOCE
            }),
            "saturation",
        );
        refused(&with(Voce { rate: bad, ..VOCE }), "rate");
        refused(
            &with(Voce {
                modulus: bad,
                ..VOCE
            }),
            "modulus",
        );
        assert!(linear(bad).check().is_err());
        let elastic = Isotropic {
            young: bad,
            ..STEEL
        };
        refused(
            &J2 {
                elastic,
                hardening: VOCE,
            },
            "young",
        );
    }
    refused(
        &J2 {
            elastic: STEEL,
            hardening: Voce {
                yield_stress: 0.0,
                ..VOCE
            },
        },
        "yield_stress",
    );
}

/// A yield stress that falls, as no curve of the library does.
#[derive(Clone, Copy, Debug)]
struct Falling {
    modulus: f64,
}

impl Hardening for Falling {
    fn stress(&self, plastic_strain: f64) -> f64 {
        300e6 - self.modulus * plastic_strain
    }

    fn slope(&self, _: f64) -> f64 {
        -self.modulus
    }

    fn work(&self, plastic_strain: f64) -> f64 {
        (300e6 - 0.5 * self.modulus * plastic_strain) * plastic_strain
    }
}

/// P21: the plane across which softening localises first, and no sooner than theory says. With the
/// deviator `s1 ≥ s2 ≥ s3` its normal has `n1² = (s1 + ν s2)/(s1 − s3)`, and the modulus is
/// `H = −E (s2/q)² 9/4` with the Mises stress `q`, but for terms of the order of the stress and of the
/// step beyond yield
/// [Ottosen and Runesson 1991, Int. J. Solids Struct. 27, 401].
#[test]
fn softening_localises_across_the_analytic_plane() -> Result<(), MaterialError> {
    let mut random = Random::new(21);
    for [s1, s2, s3] in [[3.0, -0.5, -2.5], [2.2, 0.3, -2.5], [2.0, -0.8, -1.2]] {
        let axes = random.rotation();
        let deviator = Sym::diagonal(s1, s2, s3).rotated(&axes);
        let mises = (1.5 * deviator.dot(&deviator)).sqrt();
        let found = |modulus: f64| {
            let law = J2 {
                elastic: STEEL,
                hardening: Falling { modulus },
            };
            let strain = deviator * (1.001 * 300e6 / (2.0 * STEEL.shear_modulus() * mises));
            let increment = Increment::to(Matrix3::identity() + strain.to_matrix());
            localization_of(&law, &increment, &law.initial(), Directions::Space)
        };
        let (mut low, mut high) = (0.0, STEEL.young);
        assert!(!found(low)?.is_lost(0.0) && found(high)?.is_lost(0.0));
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if found(middle)?.is_lost(0.0) {
                high = middle;
            } else {
                low = middle;
            }
        }
        let modulus = STEEL.young * (s2 / mises).powi(2) * 9.0 / 4.0;
        assert!((high - modulus).abs() < 3.0 * 300e6, "{high:e} {modulus:e}");
        let normal = axes.transpose() * found(high)?.normal;
        let squared = (s1 + STEEL.poisson * s2) / (s1 - s3);
        let off = normal.x.abs().acos() - squared.sqrt().acos();
        let off = off.abs().max(normal.y.abs().asin()).to_degrees();
        println!("{s1} {s2} {s3}: modulus {high:e} of {modulus:e} Pa, {off}° off");
        assert!(off < 0.5, "{off}°");
    }
    Ok(())
}
