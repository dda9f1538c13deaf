//! Checks that the unit tests of several laws share.

use fissure_tensor::{Matrix3, Sym, Vector3, rotation};

use crate::material::difference_tangent;
use crate::{Increment, Material, MaterialError, Scale};

/// Rest, stretches with distinct and coinciding principal values, shear, and a rotated one.
pub(crate) fn gradients() -> Vec<Matrix3<f64>> {
    let diagonal = |x, y, z| Matrix3::from_diagonal(&Vector3::new(x, y, z));
    let mut shear = Matrix3::identity();
    shear.m12 = 0.4;
    let turn = rotation(&Vector3::new(0.3, -1.0, 0.6), 1.2);
    vec![
        Matrix3::identity(),
        diagonal(1.3, 0.9, 1.05),
        diagonal(1.2, 1.2, 0.8),
        diagonal(0.7, 0.7, 0.7),
        shear,
        turn * diagonal(1.4, 0.8, 1.1) * shear,
    ]
}

/// Difference between the law's tangent and central differences of its update, over the largest
/// entry.
pub(crate) fn tangent_error<M: Material>(
    law: &M,
    increment: &Increment,
    old: &M::State,
) -> Result<f64, MaterialError> {
    let analytic = law.tangent(increment, old)?;
    let difference = difference_tangent(law, increment, old, 1e-5)?;
    Ok((analytic - difference).max_abs() / difference.max_abs())
}

/// The law's tangent equals central differences of its update, to `tolerance` of its own size.
pub(crate) fn assert_tangent<M: Material>(
    law: &M,
    increment: &Increment,
    old: &M::State,
    tolerance: f64,
) -> Result<(), MaterialError> {
    let error = tangent_error(law, increment, old)?;
    assert!(
        error <= tolerance,
        "tangent is off by {error:e} of its largest entry, allowed {tolerance:e}"
    );
    Ok(())
}

/// The law's wave speed is at least that of the acoustic tensor in every direction of a coarse
/// sphere, and at most `slack` times the largest.
pub(crate) fn assert_wave_speed<M: Material>(
    law: &M,
    f: &Matrix3<f64>,
    state: &M::State,
    slack: f64,
) -> Result<(), MaterialError> {
    let increment = Increment::to(*f);
    let tangent = law.tangent(&increment, state)?;
    let stress = law.update(&increment, state)?.stress;
    let mut largest: f64 = 0.0;
    for i in 0..40 {
        for j in 0..80 {
            let (theta, phi) = (f64::from(i) * 0.0785, f64::from(j) * 0.0785);
            let n = Vector3::new(
                theta.sin() * phi.cos(),
                theta.sin() * phi.sin(),
                theta.cos(),
            );
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
            let acoustic = Matrix3::from_fn(|row, column| {
                let (a, b) = (
                    Sym::dyad_of(&axes[row], &n),
                    Sym::dyad_of(&axes[column], &n),
                );
                a.dot(&tangent.apply(&b))
            }) + Matrix3::identity() * stress.normal_component(&n);
            largest = largest.max(Sym::from_matrix(&acoustic).spectrum().values[0]);
        }
    }
    let sampled = (largest * increment.jacobian() / law.density()).sqrt();
    let speed = law.wave_speed(f, state, &Scale::default());
    assert!(
        speed >= sampled * (1.0 - 1e-12) && speed <= sampled * slack,
        "speed {speed} against {sampled}"
    );
    Ok(())
}
