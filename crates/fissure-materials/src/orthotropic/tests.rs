use fissure_tensor::{Matrix6, Vector3, rotation};

use super::*;
use crate::contract;
use crate::testing::{assert_wave_speed, gradients, tangent_error};
use crate::{Axis, Band, Path, PlaneStress, Point, PointError};

/// Spruce; L, R, T as 1, 2, 3.
fn spruce() -> Orthotropic {
    Orthotropic {
        density: 450.0,
        young: [11.6e9, 0.9e9, 0.5e9],
        poisson_12: 0.37,
        poisson_13: 0.42,
        poisson_23: 0.47,
        shear_12: 0.75e9,
        shear_13: 0.72e9,
        shear_23: 0.039e9,
        axes: rotation(&Vector3::new(0.2, -0.5, 1.0), 0.7),
    }
}

/// Compliance of eq. 2 in Mandel form.
fn compliance(law: &Orthotropic) -> Matrix6<f64> {
    let [e1, e2, e3] = law.young;
    let mut s = Matrix6::zeros();
    (s[(0, 0)], s[(1, 1)], s[(2, 2)]) = (1.0 / e1, 1.0 / e2, 1.0 / e3);
    for (i, j, value) in [
        (0, 1, -law.poisson_12 / e1),
        (0, 2, -law.poisson_13 / e1),
        (1, 2, -law.poisson_23 / e2),
    ] {
        (s[(i, j)], s[(j, i)]) = (value, value);
    }
    s[(3, 3)] = 0.5 / law.shear_23;
    s[(4, 4)] = 0.5 / law.shear_13;
    s[(5, 5)] = 0.5 / law.shear_12;
    s
}

#[test]
fn stiffness_inverts_the_engineering_constants() {
    let law = spruce();
    let product = law.stiffness_in_material_axes().0 * compliance(&law);
    let error = (product - Matrix6::identity()).amax();
    println!("stiffness times compliance less identity: {error:.1e}");
    assert!(error < 1e-13, "{product}");
}

#[test]
fn equal_constants_are_isotropic_elasticity() {
    let elastic = Isotropic {
        density: 2400.0,
        young: 30e9,
        poisson: 0.2,
    };
    let mut law = Orthotropic::from_isotropic(&elastic);
    law.axes = rotation(&Vector3::new(1.0, 2.0, -1.0), 1.0);
    let gap = (law.stiffness() - elastic.stiffness()).max_abs();
    assert!(gap <= 1e-14 * elastic.young, "{gap:e}");
    assert!((law.wave_modulus() / elastic.p_wave_modulus() - 1.0).abs() < 1e-14);
}

/// P1-P3, P6, P9, P11, P12, P19, P20, P22, P24.
#[test]
fn passes_the_battery() {
    let message = contract::check(&spruce()).err().map(|v| v.to_string());
    assert_eq!(message.unwrap_or_default(), "");
}

/// P10: the symmetry group of the material, half turns about its axes and nothing more.
#[test]
fn half_turns_about_the_material_axes_change_nothing() -> Result<(), MaterialError> {
    let law = spruce();
    let changes = |turn: &Matrix3<f64>| -> Result<f64, MaterialError> {
        let mut largest: f64 = 0.0;
        for f in gradients() {
            let plain = law.update(&Increment::to(f), &())?.stress;
            let turned = law.update(&Increment::to(f * turn), &())?.stress;
            largest = largest.max((plain - turned).max_abs());
        }
        Ok(largest)
    };
    for axis in 0..3 {
        let axis = law.axes.column(axis).into_owned();
        let half = changes(&rotation(&axis, std::f64::consts::PI))?;
        assert!(half <= 1e-14 * law.young[0] * 10.0, "{half:e}");
        let quarter = changes(&rotation(&axis, std::f64::consts::FRAC_PI_2))?;
        assert!(quarter > 1e-3 * law.young[0]);
    }
    Ok(())
}

/// The axes turn with the material: pulled along its turned axis 1 it has the modulus E₁.
#[test]
fn axes_turn_with_the_material() -> Result<(), MaterialError> {
    let law = spruce();
    let turn = rotation(&Vector3::new(1.0, 1.0, 0.3), 2.0);
    let strain = 1e-7;
    let pull = Sym::diagonal(strain, -law.poisson_12 * strain, -law.poisson_13 * strain);
    let stretch = Matrix3::identity() + pull.congruence(&law.axes).to_matrix();
    let stress = law.update(&Increment::to(turn * stretch), &())?.stress;
    let axis = turn * law.axes.column(0);
    let expected = Sym::dyad(&axis) * (law.young[0] * strain);
    assert!((stress - expected).max_abs() <= 1e-6 * law.young[0] * strain);
    Ok(())
}

/// Plane stress of a board pulled at an angle to the grain: the modulus by the book,
/// `1/E = c⁴/E₁ + s⁴/E₂ + c²s² (1/G₁₂ − 2ν₁₂/E₁)`.
#[test]
fn pulled_at_an_angle_it_has_the_modulus_of_the_book() -> Result<(), PointError> {
    for angle in [0.0, 0.3, 0.8, 1.4] {
        let law = Orthotropic {
            axes: rotation(&Vector3::z(), angle),
            ..spruce()
        };
        let path = Path::new(Band::cube(1e-3)).uniaxial(Axis::X, 1e-8, 1);
        let stress = Point::new(&law)?.drive(&path)?[0].stress.xx();
        let plane = Point::new(&PlaneStress(law))?.drive(&path)?[0].stress.xx();
        let (c, s) = (angle.cos().powi(2), angle.sin().powi(2));
        let mixed = 1.0 / law.shear_12 - 2.0 * law.poisson_12 / law.young[0];
        let compliance = c * c / law.young[0] + s * s / law.young[1] + c * s * mixed;
        assert!((stress * compliance / 1e-8 - 1.0).abs() < 1e-6, "{angle}");
        assert!((plane * compliance / 1e-8 - 1.0).abs() < 1e-6, "{angle}");
    }
    Ok(())
}

#[test]
fn tangent_and_wave_speed_hold_at_large_strain() -> Result<(), MaterialError> {
    let law = spruce();
    let mut largest: f64 = 0.0;
    for f in gradients() {
        largest = largest.max(tangent_error(&law, &Increment::to(f), &())?);
    }
    println!("largest error of the tangent: {largest:.1e}");
    assert!(largest <= 1e-8);
    // The bound is exact here: the fastest wave runs along the grain.
    assert_wave_speed(&law, &Matrix3::identity(), &(), 1.01)?;
    for f in gradients() {
        assert_wave_speed(&law, &f, &(), f64::INFINITY)?;
    }
    Ok(())
}

/// P13 and P24: what passes has a positive definite stiffness, and what does not is named.
#[test]
fn constants_without_a_positive_energy_are_refused() {
    let law = spruce();
    assert_eq!(law.check(), Ok(()));
    let smallest = law.stiffness().0.symmetric_eigenvalues().min();
    assert!(smallest > 0.0);
    let refused = |law: Orthotropic, name: &str| {
        let refusal = law.check();
        assert!(
            matches!(refusal, Err(MaterialError::Parameter { parameter, .. }) if parameter == name),
            "{name}: {refusal:?}"
        );
    };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(
            Orthotropic {
                density: bad,
                ..law
            },
            "density",
        );
        refused(
            Orthotropic {
                young: [1e9, bad, 1e9],
                ..law
            },
            "young",
        );
        refused(
            Orthotropic {
                shear_12: bad,
                ..law
            },
            "shear_12",
        );
        refused(
            Orthotropic {
                shear_13: bad,
                ..law
            },
            "shear_13",
        );
        refused(
            Orthotropic {
                shear_23: bad,
                ..law
            },
            "shear_23",
        );
    }
    // √(E₁/E₂) = 3.59: far beyond ½ is admissible, beyond the bound is not.
    assert_eq!(
        Orthotropic {
            poisson_12: 1.2,
            ..law
        }
        .check(),
        Ok(())
    );
    refused(
        Orthotropic {
            poisson_12: 3.6,
            ..law
        },
        "poisson_12",
    );
    refused(
        Orthotropic {
            poisson_13: f64::NAN,
            ..law
        },
        "poisson_13",
    );
    refused(
        Orthotropic {
            poisson_23: -1.4,
            ..law
        },
        "poisson_23",
    );
    // Each pair is admissible, the three together are not.
    let together = Orthotropic {
        young: [1e9; 3],
        poisson_12: 0.6,
        poisson_13: 0.6,
        poisson_23: 0.6,
        ..law
    };
    refused(together, "poisson");
    refused(
        Orthotropic {
            axes: law.axes * 1.001,
            ..law
        },
        "axes",
    );
    refused(
        Orthotropic {
            axes: -law.axes,
            ..law
        },
        "axes",
    );
    refused(
        Orthotropic {
            axes: law.axes * f64::NAN,
            ..law
        },
        "axes",
    );
}
