//! Polar decomposition `F = R·U`.

use crate::{Matrix3, Sym};

/// The factors of `F = R·U`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polar {
    /// Proper orthogonal factor.
    pub rotation: Matrix3<f64>,
    /// Right stretch, symmetric positive definite.
    pub stretch: Sym,
}

/// Polar decomposition of a deformation gradient, or `None` unless `det F > 0` and `F` is finite.
///
/// Plane deformation gradients take a closed form, the others Higham's scaled Newton iteration.
pub fn polar(f: &Matrix3<f64>) -> Option<Polar> {
    let determinant = f.determinant();
    if !(determinant > 0.0 && determinant.is_finite()) {
        return None;
    }
    let rotation = if f.m13 == 0.0 && f.m23 == 0.0 && f.m31 == 0.0 && f.m32 == 0.0 && f.m33 > 0.0 {
        plane_rotation(f)
    } else {
        newton_rotation(f)?
    };
    let stretch = Sym::from_matrix(&(rotation.transpose() * f));
    Some(Polar { rotation, stretch })
}

/// In the plane `R` turns `(F11 + F22, F21 - F12)` onto the first axis.
fn plane_rotation(f: &Matrix3<f64>) -> Matrix3<f64> {
    let (x, y) = (f.m11 + f.m22, f.m21 - f.m12);
    let length = x.hypot(y);
    let (c, s) = (x / length, y / length);
    Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

/// `R ← (γR + R⁻ᵀ/γ)/2` with Higham's scaling; quadratic, so two more digits-doublings after the
/// change falls below the square root of round-off are not needed.
fn newton_rotation(f: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let mut r = *f / f.determinant().cbrt();
    for _ in 0..60 {
        let inverse_transpose = r.try_inverse()?.transpose();
        let gamma = (inverse_transpose.norm() / r.norm()).sqrt();
        // Near convergence the scaling is 1 up to round-off; leave it out so that the iteration settles.
        let gamma = if (gamma - 1.0).abs() < 1e-2 {
            1.0
        } else {
            gamma
        };
        let next = (r * gamma + inverse_transpose / gamma) * 0.5;
        let change = (next - r).norm();
        r = next;
        if change <= 1e-15 * 3.0 {
            return Some(r);
        }
        if change <= 1e-9 {
            // One more step squares this change: done to round-off.
            let inverse_transpose = r.try_inverse()?.transpose();
            return Some((r + inverse_transpose) * 0.5);
        }
    }
    None
}
