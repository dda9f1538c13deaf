use super::*;
use crate::softening::Linear;
use crate::{Axis, Band, Component, Decohesive, Hencky, Isotropic, NeoHookean, Normal};
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
