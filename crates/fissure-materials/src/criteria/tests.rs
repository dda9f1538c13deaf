use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use super::*;
use crate::contract::Random;

const TENSION: f64 = 2.7e6;
const SHEAR: f64 = 3.5e6;

/// States looked at on a grid of 0.25°; the others are on one of 3°.
const FINE: u32 = 20;

fn stress(random: &mut Random, special: bool) -> Sym {
    let size = random.log_uniform(1e5, 1e8);
    random.strain_direction(special) * size
}

/// P18 on a grid: no direction has a larger value, the value is the normal's, the bound is one,
/// and the same input gives the same bits.
fn largest_on_a_grid<C: FailureCriterion>(criterion: &C, fine: u32, coarse: u32) {
    let mut random = Random::new(18);
    for index in 0..fine + coarse {
        let stress = stress(&mut random, true);
        let degrees = if index < fine { 0.25 } else { 3.0 };
        let found = criterion.initiation(&stress);
        assert_eq!(found, criterion.initiation(&stress));
        let tolerance = 1e-8 * (1.0 + found.value.abs());
        let there = criterion.along(&stress, &found.normal);
        assert!((there - found.value).abs() <= tolerance, "{criterion:?}");
        let bound = criterion.upper_bound(&stress);
        assert!(
            found.value <= bound + tolerance,
            "{} > {bound}",
            found.value
        );
        let rows = (90.0 / degrees) as usize;
        for row in 0..=rows {
            let (sin, cos) = (FRAC_PI_2 * row as f64 / rows as f64).sin_cos();
            for column in 0..4 * rows {
                let (y, x) = (TAU * column as f64 / (4 * rows) as f64).sin_cos();
                let n = Vector3::new(sin * x, sin * y, cos);
                let value = criterion.along(&stress, &n);
                assert!(
                    value <= found.value + tolerance,
                    "{criterion:?} {stress:?}: {value} along {n:?}, found {found:?}"
                );
            }
        }
    }
}

#[test]
fn no_direction_has_a_larger_failure_function() {
    let both = (TENSION, SHEAR);
    largest_on_a_grid(&Rankine { strength: TENSION }, FINE, 100);
    let shear_strength = SHEAR;
    largest_on_a_grid(&Tresca { shear_strength }, FINE, 100);
    let (strength, shear_strength) = both;
    largest_on_a_grid(
        &MohrCoulomb {
            strength,
            shear_strength,
        },
        FINE,
        100,
    );
    largest_on_a_grid(
        &TensionShear {
            strength,
            shear_strength,
        },
        FINE,
        100,
    );
}

#[test]
fn no_direction_has_a_larger_geological_function() {
    largest_on_a_grid(&Geological::CONCRETE, FINE, 200);
}

#[test]
fn planes_lie_where_theory_puts_them() {
    let state = Sym::diagonal(5e6, 1e6, -8e6);
    let shear_strength = SHEAR;
    let tresca = Tresca { shear_strength }.initiation(&state);
    assert!((tresca.normal.x.abs() - FRAC_PI_4.cos()).abs() < 1e-12);
    assert!((tresca.value - (6.5e6 / SHEAR - 1.0)).abs() < 1e-14);
    let strength = TENSION;
    let mohr = MohrCoulomb {
        strength,
        shear_strength,
    }
    .initiation(&state);
    let angle = 0.5 * (TENSION / SHEAR).atan2(1.0);
    assert!((mohr.normal.x.abs() - angle.cos()).abs() < 1e-12);
    // The shear strength is reached first in pure shear, the tensile one in uniaxial tension.
    let nairn = TensionShear {
        strength,
        shear_strength: 0.45 * strength,
    };
    let sheared = nairn.initiation(&Sym::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.5 * strength));
    assert!((sheared.normal - Vector3::x()).norm() < 1e-12);
    let stretched = TensionShear {
        strength,
        shear_strength: 0.6 * strength,
    };
    let stretched = stretched.initiation(&Sym::diagonal(strength, 0.0, 0.0));
    assert!(stretched.normal.x.abs() == 1.0 && stretched.value.abs() < 1e-15);
    // A tie goes to tension.
    let tie = TensionShear {
        strength,
        shear_strength: 0.5 * strength,
    };
    assert!(
        tie.initiation(&Sym::diagonal(strength, 0.0, 0.0))
            .normal
            .x
            .abs()
            == 1.0
    );
}

#[test]
fn geological_surface_has_the_strengths_it_is_given() {
    let concrete = Geological::CONCRETE;
    let value = |s: &Sym| concrete.initiation(s).value;
    // Uniaxial tension, across e1, to round-off.
    let pull = concrete.initiation(&Sym::diagonal(concrete.strength, 0.0, 0.0));
    assert!(pull.value.abs() < 1e-12 && pull.normal.x.abs() > 1.0 - 1e-12);
    // Axial splitting under uniaxial and biaxial compression: s = 1 on a free plane.
    let press = concrete.initiation(&Sym::diagonal(0.0, 0.0, -concrete.compressive_strength));
    assert!(press.value > -1e-12);
    let free = |s: &Sym| concrete.along(s, &Vector3::x());
    assert!(free(&Sym::diagonal(0.0, 0.0, -concrete.compressive_strength)).abs() < 1e-12);
    let biaxial = -concrete.biaxial_strength;
    assert!(free(&Sym::diagonal(0.0, biaxial, biaxial)).abs() < 1e-12);
    assert!(value(&Sym::IDENTITY) < 0.0);
    // Under a mean tension of two strengths and beyond: past failure, finite (pole of 3.5.53).
    for level in [1.9, 2.0, 2.1, 1e3] {
        let found = value(&Sym::diagonal(level, 0.9 * level, 1.1 * level).scaled_by(2.7e6));
        assert!(found.is_finite() && found > 0.0, "{level}: {found}");
    }
}

trait ScaledBy {
    fn scaled_by(self, factor: f64) -> Self;
}
impl ScaledBy for Sym {
    fn scaled_by(self, factor: f64) -> Self {
        self * factor
    }
}

/// Eqs 3.5.88-3.5.92 against central differences in all six components, softening included; with
/// the factor `f_n` that 3.5.91 lacks.
#[test]
fn geological_gradients_are_those_of_differences() {
    let concrete = Geological::CONCRETE;
    let mut random = Random::new(91);
    let mut checked = 0;
    for _ in 0..400 {
        let stress = random.strain_direction(false) * random.log_uniform(1e5, 8e7);
        let (n, f) = (random.direction(), random.uniform(0.05, 1.0));
        let value = |s: &Sym, f: f64| concrete.value(&OnPlane::new(s, &n), f);
        // Away from where P is held and from the joint at ψ = 0, which only is C¹.
        let partials = concrete.partials(&OnPlane::new(&stress, &n), f);
        if stress.mean() > 1.8 * concrete.strength || (partials.value).abs() < 1e-4 {
            continue;
        }
        checked += 1;
        let gradient = concrete.gradient(&stress, &n, f);
        let scale = gradient.max_abs() + 1e-9 / concrete.strength;
        for component in 0..6 {
            let mut d = Sym::ZERO;
            d.mandel[component] = 1.0;
            let central =
                |h: f64| (value(&(stress + d * h), f) - value(&(stress - d * h), f)) / (2.0 * h);
            let h = 1e-3 * concrete.strength;
            let difference = (central(0.5 * h) * 4.0 - central(h)) / 3.0;
            let gap = (gradient.mandel[component] - difference).abs();
            assert!(gap < 1e-6 * scale, "{component}: {gap:e} of {scale:e}");
        }
        let central = |h: f64| (value(&stress, f + h) - value(&stress, f - h)) / (2.0 * h);
        let difference = (central(5e-5) * 4.0 - central(1e-4)) / 3.0;
        assert!((partials.softening - difference).abs() < 1e-6 * (1.0 + difference.abs()));
        // The flow is the gradient with the traction: both shear components count once.
        let flow = concrete.flow(&stress, &n, f);
        let normal = gradient.normal_component(&n);
        assert!((flow.dot(&n) - normal).abs() < 1e-12 * scale);
    }
    assert!(checked > 250, "{checked}");
}

#[test]
fn repeated_principal_stresses_give_one_answer() {
    let concrete = Geological::CONCRETE;
    for state in [
        Sym::diagonal(3e6, 3e6, 3e6),
        Sym::diagonal(3e6, 3e6, -4e6),
        Sym::diagonal(-5e6, -9e7, -9e7),
        Sym::ZERO,
    ] {
        let found = concrete.initiation(&state);
        assert_eq!(found, concrete.initiation(&state));
        assert!((found.normal.norm() - 1.0).abs() < 1e-12);
        // The value does not depend on the axes, even where the direction does.
        let turn = fissure_tensor::rotation(&Vector3::new(0.3, -1.0, 0.4), 0.7);
        let turned = concrete.initiation(&state.congruence(&turn)).value;
        assert!((turned - found.value).abs() < 1e-8 * (1.0 + found.value.abs()));
    }
}

/// P24.
#[test]
fn parameters_out_of_range_are_refused() {
    let refused = |criterion: Geological, field: &str| {
        let error = criterion.check().expect_err("accepted").to_string();
        assert!(error.contains(field), "{error}");
    };
    let good = Geological::CONCRETE;
    assert!(good.check().is_ok());
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(
            Geological {
                strength: bad,
                ..good
            },
            "strength",
        );
        refused(
            Geological {
                shear_strength: bad,
                ..good
            },
            "shear_strength",
        );
        let confined_shear_strength = bad;
        refused(
            Geological {
                confined_shear_strength,
                ..good
            },
            "confined",
        );
        refused(
            Geological {
                biaxial_strength: bad,
                ..good
            },
            "biaxial",
        );
        assert!(Rankine { strength: bad }.check().is_err());
        assert!(
            Tresca {
                shear_strength: bad
            }
            .check()
            .is_err()
        );
        let (strength, shear_strength) = (TENSION, bad);
        assert!(
            MohrCoulomb {
                strength,
                shear_strength
            }
            .check()
            .is_err()
        );
        assert!(
            TensionShear {
                strength,
                shear_strength
            }
            .check()
            .is_err()
        );
    }
    refused(
        Geological {
            biaxial_strength: 0.5 * 42.7e6,
            ..good
        },
        "biaxial",
    );
    refused(
        Geological {
            normal_coupling: -0.1,
            ..good
        },
        "normal_coupling",
    );
    refused(
        Geological {
            shape_coupling: f64::NAN,
            ..good
        },
        "shape_coupling",
    );
}

/// P19: powers of two leave the dimensionless result bitwise alone.
#[test]
fn units_do_not_matter() {
    let mut random = Random::new(19);
    let concrete = Geological::CONCRETE;
    let unit = 2.0_f64.powi(-20);
    let other = concrete.scaled(&Scale {
        strength: unit,
        ..Scale::default()
    });
    for _ in 0..50 {
        let stress = stress(&mut random, true);
        let (a, b) = (
            concrete.initiation(&stress),
            other.initiation(&(stress * unit)),
        );
        assert_eq!(a, b);
    }
}

/// Under strong compression the surface is flat in pressure, and the largest value is at 45° to round-off: at a point of the
/// grid that is scanned, where the slope may be zero to the last bit.
#[test]
fn the_plane_of_pure_shear_is_found_exactly() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    for index in 0..2000 {
        let share = 1.0 + 1e-4 * f64::from(index);
        let stress = Sym::diagonal(-379e6, -662e6, -681e6) * share;
        let normal = Geological::CONCRETE.initiation(&stress).normal;
        let gap = (normal.x.abs() - half).abs() + normal.y.abs() + (normal.z.abs() - half).abs();
        assert!(gap < 1e-12, "{index}: {gap:e}");
    }
}
