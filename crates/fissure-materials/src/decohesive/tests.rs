use super::*;
use crate::Cracking;
use crate::testing::{assert_tangent, assert_wave_speed};
use crate::{Control, Leg, Path, Point as MaterialPoint, PointError};
use fissure_tensor::rotation;

const WIDTH: f64 = 0.01;
const LAW: Decohesive = Decohesive {
    elastic: Isotropic {
        density: 2350.0,
        young: 24.9e9,
        poisson: 0.18,
    },
    strength: 2.7e6,
    toughness: 61.35,
    softening: Linear,
    normal: Normal::Rankine,
};

fn along_x(strain: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(1.0 + strain, 1.0, 1.0))
}

/// Normal strain in uniaxial strain at the dimensionless opening `s`.
fn strain_at(s: f64) -> f64 {
    let traction = LAW.strength * LAW.softening.ratio(s);
    traction / LAW.elastic.p_wave_modulus() + s * LAW.toughness / LAW.strength / WIDTH
}

fn increment(f_old: Matrix3<f64>, f_new: Matrix3<f64>) -> Increment {
    Increment {
        f_old,
        band: Band::cube(WIDTH),
        ..Increment::to(f_new)
    }
}

/// Through these gradients from rest; the last response.
fn through(path: &[Matrix3<f64>]) -> Result<Response<DecohesiveState>, MaterialError> {
    let mut old = Matrix3::identity();
    let mut last = LAW.update(&increment(old, old), &DecohesiveState::default())?;
    for f in path {
        last = LAW.update(&increment(old, *f), &last.state)?;
        old = *f;
    }
    Ok(last)
}

#[test]
fn opening_and_traction_follow_the_linear_curve() -> Result<(), MaterialError> {
    let critical = LAW.critical_opening(&Scale::default());
    assert!((critical / (2.0 * LAW.toughness / LAW.strength) - 1.0).abs() < 1e-15);
    let middle = through(&[along_x(strain_at(1.0))])?;
    assert!((middle.state.opening / (0.5 * critical) - 1.0).abs() < 1e-12);
    assert!((middle.stress.xx() / (0.5 * LAW.strength) - 1.0).abs() < 1e-11);
    assert!((middle.dissipated * WIDTH / (0.75 * LAW.toughness) - 1.0).abs() < 1e-12);
    let failed = through(&[along_x(1.0001 * strain_at(2.0))])?;
    assert!(failed.state.failed && failed.stress.xx().abs() < 1e-12 * LAW.elastic.young);
    assert!((failed.dissipated * WIDTH / LAW.toughness - 1.0).abs() < 1e-12);
    Ok(())
}

#[test]
fn one_step_is_many_on_a_proportional_path() -> Result<(), MaterialError> {
    for end in [0.3, 1.0, 1.9, 2.5].map(strain_at) {
        let one = through(&[along_x(end)])?;
        let steps: Vec<_> = (1..=1000)
            .map(|i| along_x(end * f64::from(i) / 1000.0))
            .collect();
        let many = through(&steps)?;
        assert!((one.state.opening / many.state.opening - 1.0).abs() < 1e-12);
        assert!((one.state.softened / many.state.softened - 1.0).abs() < 1e-12);
        assert!((one.stress - many.stress).max_abs() < 1e-12 * LAW.strength);
        assert!((one.stored - many.stored).abs() < 1e-12 * LAW.toughness / WIDTH);
    }
    Ok(())
}

#[test]
fn a_partly_open_crack_keeps_its_opening() -> Result<(), MaterialError> {
    let opening = LAW.critical_opening(&Scale::default()) / 2.0;
    let loaded = along_x(strain_at(1.0));
    for strain in [0.9 * strain_at(1.0), 0.0, -1e-3] {
        let unloaded = through(&[loaded, along_x(strain)])?;
        let expected = LAW.elastic.p_wave_modulus() * (strain - opening / WIDTH);
        assert!((unloaded.state.opening / opening - 1.0).abs() < 1e-12);
        assert!((unloaded.stress.xx() / expected - 1.0).abs() < 1e-11);
        assert!(unloaded.dissipated == 0.0);
        let again = through(&[loaded, along_x(strain), loaded])?;
        assert!((again.stress.xx() / (0.5 * LAW.strength) - 1.0).abs() < 1e-11);
    }
    Ok(())
}

#[test]
fn a_failed_crack_opens_freely_and_carries_contact() -> Result<(), MaterialError> {
    let failed = along_x(2.0 * strain_at(2.0));
    let shut = Matrix3::new(0.999, 2e-4, 0.0, 0.0, 1.0001, 1e-4, 0.0, 0.0, 0.9998);
    let undamaged = through(&[shut])?;
    let contact = through(&[failed, shut])?;
    let gap = (contact.stress - undamaged.stress).max_abs();
    assert!(contact.state.opening == 0.0 && gap < 4e-15 * LAW.elastic.young);
    let reopened = through(&[failed, shut, along_x(1e-4)])?;
    assert!(reopened.stress.xx().abs() < 1e-15 * LAW.elastic.young && reopened.dissipated == 0.0);
    // Free: exactly the strain is opening.
    assert!((reopened.state.opening / (1e-4 * WIDTH) - 1.0).abs() < 1e-10);
    Ok(())
}

#[test]
fn a_zero_increment_changes_no_bit() -> Result<(), MaterialError> {
    for i in 0..400 {
        let turn = rotation(&Vector3::new(1.0, 0.2, -0.4), 0.01 * f64::from(i));
        let f = turn * along_x(strain_at(2.0) * (0.02 * f64::from(i) - 1.0));
        let first = through(&[f])?;
        let second = through(&[f, f])?;
        assert_eq!(first.state, second.state);
        assert_eq!(first.stress, second.stress);
        assert!(second.dissipated == 0.0 && second.stored == first.stored);
    }
    Ok(())
}

#[test]
fn tangent_matches_differences_in_every_branch() -> Result<(), MaterialError> {
    let turn = rotation(&Vector3::new(0.3, -1.0, 0.6), 1.2);
    let mix = Matrix3::new(0.2, 0.5, -0.1, 0.0, -0.3, 0.2, 0.1, 0.0, 0.1);
    // Distinct principal strains: elsewhere the direction of onset is not differentiable.
    let at = |x: f64| turn * (Matrix3::identity() + (mix + along_x(0.0) * 0.2) * x);
    let opened = 4.0 * strain_at(1.0);
    let branches: [&[f64]; 7] = [
        &[1e-6],          // elastic
        &[1e-3],          // onset
        &[50.0 * opened], // onset to failure
        &[1e-3, 2e-3],    // softening
        &[2e-3, 1e-3],    // unloading
        &[1.0, 0.8],      // failed, open
        &[1.0, -1e-3],    // failed, shut
    ];
    for path in branches {
        let gradients: Vec<_> = path.iter().map(|&x| at(x)).collect();
        let (last, before) = gradients.split_last().unwrap();
        let old = through(before)?;
        let from = before.last().copied().unwrap_or_else(Matrix3::identity);
        let step = increment(from, *last);
        // Smaller than the shortest branch here, 1e-6.
        let analytic = LAW.tangent(&step, &old.state)?;
        let difference = crate::material::difference_tangent(&LAW, &step, &old.state, 1e-8)?;
        let gap = (analytic - difference).max_abs() / difference.max_abs();
        assert!(gap < 1e-6, "{path:?}: off by {gap:e}");
    }
    Ok(())
}

#[test]
fn onset_tangent_turns_with_the_principal_direction() -> Result<(), MaterialError> {
    let f = Matrix3::new(1.002, 4e-4, 0.0, 4e-4, 0.9995, 2e-4, 0.0, 2e-4, 1.0003);
    let step = increment(Matrix3::identity(), f);
    let fixed = Decohesive {
        normal: Normal::Prescribed(Vector3::x()),
        ..LAW
    };
    assert_tangent(&LAW, &step, &DecohesiveState::default(), 1e-4)?;
    assert_tangent(&fixed, &step, &DecohesiveState::default(), 1e-4)
}

/// Not proportional, with rotation, opening, unloading, shear, failure and contact.
fn tour(steps: usize, turns: f64) -> Path {
    let corners = [
        [2e-4, 1e-5, -2e-5, 3e-5, 0.0, 5e-5],
        [5e-5, -1e-4, 2e-5, 0.0, 4e-5, -2e-4],
        [6e-3, 1e-4, 0.0, 1e-4, 0.0, 3e-4],
        [-1e-4, -2e-4, 0.0, 0.0, 0.0, 1e-4],
        [3e-3, 0.0, 1e-4, 0.0, 2e-4, 0.0],
    ];
    corners
        .iter()
        .fold(Path::new(Band::cube(WIDTH)), |path, corner| {
            path.leg(Leg {
                control: corner.map(Control::Strain),
                steps,
                dt: 1.0,
                spin: Vector3::new(0.3, 1.0, -0.5) * turns,
            })
        })
}

#[test]
fn stored_and_dissipated_energy_are_the_work_as_steps_shrink() -> Result<(), PointError> {
    let mut errors = Vec::new();
    for steps in [50, 500, 5000] {
        let samples = MaterialPoint::new(&LAW)?.drive(&tour(steps, 0.0))?;
        let last = samples.last().unwrap();
        assert!(last.state.failed);
        assert!((last.dissipated * WIDTH / LAW.toughness - 1.0).abs() < 1e-10);
        errors.push(((last.stored + last.dissipated) / last.work - 1.0).abs());
    }
    assert!(errors[1] < 0.2 * errors[0] && errors[2] < 0.2 * errors[1]);
    assert!(errors[2] < 1e-5, "{errors:?}");
    Ok(())
}

#[test]
fn rotations_on_top_change_nothing() -> Result<(), PointError> {
    let still = MaterialPoint::new(&LAW)?.drive(&tour(40, 0.0))?;
    let turning = MaterialPoint::new(&LAW)?.drive(&tour(40, 2e4))?;
    for (a, b) in still.iter().zip(&turning) {
        assert!((a.stress - b.stress).max_abs() < 1e-9 * LAW.elastic.young * 1e-3);
        assert!((a.dissipated - b.dissipated).abs() < 1e-9 * LAW.toughness / WIDTH);
        assert!((a.work - b.work).abs() < 1e-9 * LAW.toughness / WIDTH);
    }
    Ok(())
}

#[test]
fn wave_speed_bounds_the_acoustic_tensor_of_an_open_crack() -> Result<(), MaterialError> {
    let state = through(&[along_x(2.0 * strain_at(2.0))])?.state;
    assert!(state.failed);
    for (stretch, shear) in [(1.0, 0.0), (2.0, 0.0), (3.0, 0.5), (1.3, 1.0), (0.7, 0.5)] {
        let mut f = along_x(stretch - 1.0);
        f.m12 = shear;
        assert_wave_speed(&LAW, &f, &state, f64::INFINITY)?;
    }
    let rest = LAW.wave_speed(&Matrix3::identity(), &state, &Scale::default());
    assert!((rest / LAW.elastic.p_wave_speed() - 1.0).abs() < 1e-15);
    Ok(())
}
