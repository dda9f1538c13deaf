use super::*;
use crate::{Isotropic, Mode, Onset};

fn law() -> EllipticalDamage {
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
    // The axes are y and z: the crack is across x, and no shear at onset turns them.
    EllipticalDamage::new(AnisotropicDamage {
        onset: Onset::Prescribed(Vector3::x()),
        ..AnisotropicDamage::new(elastic, mode(30e6, 1e3), mode(20e6, 1.5e3))
    })
}

/// Shear traction in steps to an engineering strain, at an angle to the first axis; the crack has
/// been started by a stretch a little over the strength, with y stretched more than z.
fn sheared(angle: f64, ends: &[f64], steps: usize) -> Result<Vec<f64>, MaterialError> {
    let law = law();
    let mut f = Matrix3::identity();
    (f.m11, f.m22) = (1.0203, 1.0004);
    let mut step = Increment {
        band: Band::cube(1e-3),
        ..Increment::to(f)
    };
    let mut state = law.update(&step, &law.initial())?.state;
    assert!(state.axis[1].abs() > 0.9 || state.axis[2].abs() > 0.9);
    let mut tractions = Vec::new();
    let mut from = 0.0;
    for end in ends {
        for i in 1..=steps {
            let strain = from + (end - from) * i as f64 / steps as f64;
            let half = Sym::new(
                0.0203,
                4e-4,
                0.0,
                0.0,
                0.5 * strain * angle.sin(),
                0.5 * strain * angle.cos(),
            );
            step.f_old = step.f_new;
            step.f_new = Matrix3::identity() + half.to_matrix();
            let response = law.update(&step, &state)?;
            assert!(response.dissipated >= 0.0 && response.stored >= 0.0);
            state = response.state;
            let kinematics = Biot::new(&step.f_new)?;
            let stress = response.stress.rotated(&kinematics.rotation.transpose());
            tractions.push(stress.xy().hypot(stress.xz()));
        }
        from = *end;
    }
    Ok(tractions)
}

/// What the reference's README says of it (point 1): the same peak, another end.
#[test]
fn it_is_not_objective() -> Result<(), MaterialError> {
    let mut last = Vec::new();
    for angle in [0.0, std::f64::consts::FRAC_PI_4] {
        let tractions = sheared(angle, &[0.2], 2000)?;
        let peak = tractions.iter().copied().fold(0.0, f64::max);
        assert!((peak / 20e6 - 1.0).abs() < 5e-3, "{peak}");
        let before_failure = tractions.iter().copied().rfind(|t| *t > 1e3);
        last.push(before_failure.expect("a traction"));
    }
    println!("traction just before failure along an axis and halfway between: {last:?} Pa");
    assert!(last[0] < 1e6 && last[1] > 8e6, "{last:?}");
    Ok(())
}

/// Reversal to the opposite strength in one step stays within the ellipse.
#[test]
fn a_reversal_in_one_step_returns_to_the_ellipse() -> Result<(), MaterialError> {
    for angle in [0.0, 0.3, std::f64::consts::FRAC_PI_4, 1.2] {
        for end in [-0.07, -0.09, -0.3] {
            let once = sheared(angle, &[0.06, end], 1)?;
            let many = sheared(angle, &[0.06, end], 400)?;
            let (once, many) = (once.last().copied(), many.last().copied());
            let (once, many) = (once.expect("one"), many.expect("many"));
            assert!(
                once <= 20e6 && (once - many).abs() < 0.15 * 20e6,
                "{angle} {end}: {once} {many}"
            );
        }
    }
    Ok(())
}
