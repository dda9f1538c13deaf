use super::*;
use crate::Entry::{Held, Stress, Value};
use crate::softening::Linear;
use crate::{
    Axis, Band, Component, Control, Decohesive, Hencky, Increment, Isotropic, Leg, NeoHookean,
    Normal, PlaneStress, SubSteps,
};
use fissure_tensor::Vector3;

const ELASTIC: Isotropic = Isotropic {
    density: 2400.0,
    young: 30e9,
    poisson: 0.2,
};
const WIDTH: f64 = 0.01;

fn cohesive() -> Decohesive {
    Decohesive {
        elastic: ELASTIC,
        strength: 3e6,
        toughness: 60.0,
        softening: Linear,
        normal: Normal::Rankine,
    }
}

fn path() -> Path {
    Path::new(Band::cube(WIDTH))
}

#[test]
fn uniaxial_stress_gives_youngs_modulus_and_poissons_ratio() -> Result<(), PointError> {
    let samples = Point::new(&ELASTIC)?.drive(&path().uniaxial(Axis::Y, 1e-3, 7).back(-2e-3, 3))?;
    for sample in samples {
        let axial = sample.strain.yy();
        assert!((sample.stress.yy() - ELASTIC.young * axial).abs() < 1e-14 * ELASTIC.young);
        assert!((sample.strain.xx() + 0.2 * axial).abs() < 1e-14);
        assert!((sample.strain.zz() + 0.2 * axial).abs() < 1e-14);
        assert!(sample.stress.xx().abs() < 1e-14 * ELASTIC.young);
    }
    Ok(())
}

#[test]
fn load_control_reaches_its_target_in_every_component() -> Result<(), PointError> {
    let legs = path()
        .stress(Component::XY, 2e6, 2)
        .stress(Component::ZZ, -5e6, 1)
        .leg(Leg {
            control: [1e6, -2e6, 3e6, 4e5, -5e5, 6e5].map(Control::Stress),
            steps: 3,
            dt: 0.5,
            spin: Vector3::new(0.0, 1.0, 2.0),
        });
    let samples = Point::new(&Hencky { elastic: ELASTIC })?.drive(&legs)?;
    let shear = 2e6 / (2.0 * ELASTIC.shear_modulus());
    assert!((samples[1].strain.xy() / shear - 1.0).abs() < 1e-4);
    assert!((samples[2].stress.zz() / -5e6 - 1.0).abs() < 1e-9);
    let last = samples[5];
    let wanted = Sym::new(1e6, -2e6, 3e6, 4e5, -5e5, 6e5);
    assert!((last.stress - wanted).max_abs() < 1e-13 * ELASTIC.young);
    assert!((last.time - 4.5).abs() < 1e-15);
    Ok(())
}

#[test]
fn a_crack_dissipates_its_toughness_whatever_the_steps() -> Result<(), PointError> {
    let law = cohesive();
    for steps in [1, 2, 3, 10, 100, 1000] {
        for path in [
            path().uniaxial_strain(Axis::X, 8e-3, steps),
            path().uniaxial(Axis::X, 8e-3, steps),
            path()
                .uniaxial_strain(Axis::Z, 1e-3, steps)
                .cycle(5e-4, 2e-3, 3, steps)
                .back(8e-3, steps),
            path()
                .uniaxial(Axis::Z, 1e-3, steps)
                .cycle(5e-4, 2e-3, 3, steps)
                .cycle(8e-3, -1e-4, 2, steps),
        ] {
            let samples = Point::new(&law)?.drive(&path)?;
            let last = samples.last().unwrap();
            assert!(last.state.failed);
            assert!((last.dissipated * WIDTH / law.toughness - 1.0).abs() < 1e-10);
            let rising = samples
                .windows(2)
                .all(|w| w[1].dissipated >= w[0].dissipated);
            assert!(rising);
        }
    }
    Ok(())
}

#[test]
fn work_converges_to_stored_plus_dissipated() -> Result<(), PointError> {
    let error = |steps| -> Result<f64, PointError> {
        let path = path()
            .uniaxial(Axis::X, 1e-3, steps)
            .back(5e-4, steps)
            .back(8e-3, steps);
        let samples = Point::new(&cohesive())?.drive(&path)?;
        let last = samples.last().unwrap();
        Ok(((last.stored + last.dissipated) / last.work - 1.0).abs())
    };
    let (coarse, fine) = (error(100)?, error(3200)?);
    assert!(fine < 1e-5 && fine < 0.1 * coarse, "{coarse:e} to {fine:e}");
    Ok(())
}

#[test]
fn work_is_stored_at_finite_strain_with_spin() -> Result<(), PointError> {
    let law = NeoHookean {
        density: 1100.0,
        young: 2e6,
        poisson: 0.4,
    };
    let error = |steps| -> Result<f64, PointError> {
        let path = path()
            .uniaxial(Axis::X, 1.0, steps)
            .spin(Axis::Z, 3.0)
            .shear(Axis::Z, 0.4, steps)
            .spin(Axis::X, -0.7);
        let samples = Point::new(&law)?.drive(&path)?;
        let last = samples.last().unwrap();
        Ok((last.stored / last.work - 1.0).abs())
    };
    let (coarse, fine) = (error(20)?, error(80)?);
    assert!(
        fine < 1e-4 && (coarse / fine - 16.0).abs() < 1.0,
        "{coarse:e} to {fine:e}"
    );
    Ok(())
}

#[test]
fn softening_under_load_control_names_leg_and_step() {
    let law = cohesive();
    let mut samples = Vec::new();
    let mut point = Point::new(&law).unwrap();
    let result = point.drive_with(&path().stress(Component::XX, 4e6, 8), |s| {
        samples.push(s.step)
    });
    // 7/8 of 4 MPa is over the strength of 3 MPa.
    assert!(
        matches!(result, Err(PointError::NoEquilibrium { leg: 0, step: 7, unbalanced }) if unbalanced > 0.0)
    );
    assert_eq!((samples.len(), point.sample().step), (6, 6));
}

#[test]
fn unsound_paths_and_bands_are_refused() {
    let law = cohesive();
    let drive = |path: Path| Point::new(&law).unwrap().drive(&path);
    assert_eq!(
        drive(path().uniaxial(Axis::X, 1e-3, 0)),
        Err(PointError::Leg { leg: 0 })
    );
    assert_eq!(
        drive(path().shear(Axis::X, f64::NAN, 1)),
        Err(PointError::Leg { leg: 0 })
    );
    let wide = Path::new(Band::cube(10.0)).uniaxial(Axis::X, 1e-3, 1);
    assert!(matches!(
        drive(wide),
        Err(PointError::Law(MaterialError::Band { .. }))
    ));
    let inverted = path().hydrostatic(0.1, 1).uniaxial_strain(Axis::X, -2.0, 1);
    assert!(matches!(
        drive(inverted),
        Err(PointError::Update {
            leg: 1,
            step: 1,
            ..
        })
    ));
}

const RUBBER: NeoHookean = NeoHookean {
    density: 1100.0,
    young: 2e6,
    poisson: 0.4,
};

#[test]
fn a_table_of_gradients_is_followed_with_its_rotations() -> Result<(), PointError> {
    let rows = [
        Matrix3::new(1.1, 0.3, 0.0, -0.2, 0.9, 0.1, 0.0, 0.05, 1.2),
        Matrix3::new(0.0, -1.2, 0.0, 1.1, 0.1, 0.0, 0.0, 0.0, 0.9),
    ];
    let samples = Point::new(&RUBBER)?.drive(&path().gradients(rows, 5))?;
    for (row, sample) in rows.iter().zip(samples.iter().skip(4).step_by(5)) {
        assert!((sample.deformation_gradient() - row).norm() < 1e-14);
        let direct = RUBBER.update(&Increment::to(*row), &())?;
        assert!((sample.cauchy() - direct.stress).max_abs() < 1e-13 * RUBBER.young);
    }
    Ok(())
}

#[test]
fn entries_and_stresses_are_driven_together() -> Result<(), PointError> {
    // Simple shear with a pressure across, free along, and a shear stress out of plane.
    let entries = [
        [Stress(0.0), Value(0.8), Held],
        [Held, Stress(-2e5), Stress(3e4)],
        [Held, Held, Held],
    ];
    let samples = Point::new(&RUBBER)?.drive(&path().entries(entries, 4))?;
    let last = samples[3];
    let (f, stress) = (last.deformation_gradient(), last.cauchy());
    assert!((f.m12 - 0.8).abs() < 1e-15 && (f.m33 - 1.0).abs() < 1e-15);
    assert!(f.m21.abs() < 1e-15 && f.m31.abs() < 1e-15 && f.m32.abs() < 1e-15);
    for (found, wanted) in [(stress.xx(), 0.0), (stress.yy(), -2e5), (stress.yz(), 3e4)] {
        assert!((found - wanted).abs() < 1e-6, "{found} for {wanted}");
    }
    // In plane stress the entries out of the plane are the law's.
    let plane = PlaneStress(RUBBER);
    let entries = [
        [Value(1.3), Held, Stress(1e9)],
        [Held, Stress(0.0), Held],
        [Held, Held, Stress(1e9)],
    ];
    let last = Point::new(&plane)?.drive(&path().entries(entries, 3))?[2];
    assert!((last.strain.yy() - last.strain.zz()).abs() < 1e-12 && last.strain.yy() < -0.05);
    // A stress cannot stand for both of two mirrored entries.
    let both = [
        [Held, Stress(0.0), Held],
        [Stress(0.0), Held, Held],
        [Held; 3],
    ];
    let refused = Point::new(&RUBBER)?.drive(&path().entries(both, 1));
    assert_eq!(refused, Err(PointError::Leg { leg: 0 }));
    Ok(())
}

#[test]
fn willams_test_turns_the_principal_strains() -> Result<(), PointError> {
    let peak = 3e6 / ELASTIC.young;
    let path = path().willam(peak, 10.0 * peak, ELASTIC.poisson, 100);
    let samples = Point::new(&cohesive())?.drive(&path)?;
    // The first leg ends at the strength, in uniaxial stress.
    assert!((samples[99].stress.xx() / 3e6 - 1.0).abs() < 1e-3);
    assert!(samples[99].stress.yy().abs() < 1e-3 * 3e6);
    for pair in samples[99..].windows(2) {
        let step = pair[1].strain - pair[0].strain;
        assert!((step.yy() / step.xx() - 1.5).abs() < 1e-9);
        assert!((2.0 * step.xy() / step.xx() - 2.0).abs() < 1e-9);
        assert!(pair[1].stress.zz().abs() < 1.0);
    }
    let end = samples[199];
    let axis = end.strain.spectrum().vectors[0];
    // tan 2θ = γ/(ε_xx − ε_yy): past 45°, towards 52°.
    let angle = (axis.y / axis.x).atan().to_degrees();
    assert!((45.0..52.1).contains(&angle), "{angle}");
    // The crack keeps the direction in which it started, at most one step after the peak.
    assert!(end.state.softened > 0.0 && end.state.normal[0].abs() > 0.99);
    Ok(())
}

#[test]
fn a_random_walk_repeats_itself_and_stays_in_its_ball() -> Result<(), PointError> {
    let walk = |seed| path().random_walk(seed, 2e-3, 50, 2, false);
    assert_eq!(walk(5), walk(5));
    assert_ne!(walk(5), walk(6));
    let law = cohesive();
    let samples = Point::new(&law)?.drive(&walk(5))?;
    assert!(
        samples
            .iter()
            .all(|s| s.strain.norm() <= 2e-3 * (1.0 + 1e-12))
    );
    let rising = samples
        .windows(2)
        .all(|w| w[1].dissipated >= w[0].dissipated);
    assert!(rising && samples[99].dissipated > 0.0);
    let plane = path().random_walk(5, 2e-3, 50, 2, true);
    let samples = Point::new(&law)?.drive(&plane)?;
    assert!(
        samples
            .iter()
            .all(|s| s.strain.zz() == 0.0 && s.strain.xz() == 0.0)
    );
    Ok(())
}

#[test]
fn steps_are_divided_until_they_settle() -> Result<(), PointError> {
    // Sheared below the strength, then pulled: the direction of the crack is that of where it
    // starts, which one step takes to be where it ends.
    let law = cohesive();
    let legs = |steps| {
        path()
            .shear(Axis::Z, 5e-5, 1)
            .uniaxial_strain(Axis::X, 1e-3, steps)
    };
    let last = |path: Path| -> Result<_, PointError> {
        Ok(*Point::new(&law)?.drive(&path)?.last().unwrap())
    };
    let exact = last(legs(4096))?.stress;
    let whole = last(legs(1))?;
    let sub_steps = |tolerance| SubSteps {
        halvings: 20,
        tolerance,
    };
    let coarse = last(legs(1).sub_steps(sub_steps(1e5)))?;
    let fine = last(legs(1).sub_steps(sub_steps(1e2)))?;
    let error = |sample: &Sample<_>| (sample.stress - exact).max_abs();
    assert_eq!(whole.parts, 1);
    assert!(error(&whole) > 2e5, "{:e}", error(&whole));
    assert!(coarse.parts > 1 && fine.parts > coarse.parts && fine.parts < 100);
    assert!(error(&fine) < 2e-2 * error(&coarse), "{:e}", error(&fine));
    assert_eq!((fine.step, fine.time), (1, 2.0));
    Ok(())
}

#[test]
fn a_step_that_fails_leaves_the_point_and_is_divided_no_further_than_allowed() {
    let law = cohesive();
    let mut point = Point::new(&law).unwrap();
    let sub_steps = SubSteps {
        halvings: 6,
        tolerance: f64::INFINITY,
    };
    let path = path().stress(Component::XX, 4e6, 2).sub_steps(sub_steps);
    let result = point.drive(&path);
    assert!(matches!(
        result,
        Err(PointError::NoEquilibrium {
            leg: 0,
            step: 2,
            ..
        })
    ));
    assert_eq!(point.sample().step, 1);
    assert!((point.sample().stress.xx() - 2e6).abs() < 1.0);
    let none = SubSteps {
        halvings: 1,
        tolerance: f64::NAN,
    };
    assert_eq!(
        point.drive(&path.sub_steps(none)),
        Err(PointError::Leg { leg: 0 })
    );
}

#[test]
fn events_are_found_where_they_happen_whatever_the_steps() -> Result<(), PointError> {
    let law = cohesive();
    let onset = law.strength / ELASTIC.p_wave_modulus();
    let failure = 2.0 * law.toughness / law.strength / WIDTH;
    for steps in [1, 7, 100] {
        let path = path()
            .uniaxial_strain(Axis::X, 8e-3, steps)
            .back(-1e-3, steps);
        let History { samples, events } = Point::new(&law)?.drive_with_events(&path)?;
        assert_eq!(samples.len(), 2 * steps);
        let found: Vec<_> = events
            .iter()
            .map(|e| (e.kind, e.crack, e.sample.leg))
            .collect();
        assert_eq!(
            found,
            [
                (EventKind::Initiation, 0, 0),
                (EventKind::Failure, 0, 0),
                (EventKind::Contact, 0, 1)
            ]
        );
        for (event, strain) in events.iter().zip([onset, failure, 0.0]) {
            assert!(
                (event.sample.strain.xx() - strain).abs() < 1e-14,
                "{event:?}"
            );
        }
        for (event, fraction) in events.iter().zip([onset / 8e-3, failure / 8e-3, 8.0 / 9.0]) {
            assert!((event.fraction - fraction).abs() < 1e-12, "{event:?}");
        }
    }
    Ok(())
}
