//! Polar decomposition `F = R·U`.

use crate::eigen::power_of_two;
use crate::{Matrix3, Sym, Vector3};

/// Newton steps allowed; scaled, about ten are taken at a condition number of 1e16.
const MAXIMAL_STEPS: usize = 30;

/// Corrections of the rotation allowed; they converge quadratically.
const MAXIMAL_CORRECTIONS: usize = 6;

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
/// Plane deformation gradients take a closed form, the others Newton's iteration with Higham's
/// scaling (Higham 1986, SIAM J. Sci. Stat. Comput. 7, 1160), five steps as a rule. The factors
/// reproduce `F`, and the rotation is orthogonal, to a few units of round-off. The rotation itself
/// is determined by `F` to round-off times `σ₁/(σ₂+σ₃)` and no better.
pub fn polar(f: &Matrix3<f64>) -> Option<Polar> {
    // Magnitude near one, by a power of two: no determinant under- or overflows.
    let sum = (f.m11.abs() + f.m21.abs() + f.m31.abs())
        + (f.m12.abs() + f.m22.abs() + f.m32.abs())
        + (f.m13.abs() + f.m23.abs() + f.m33.abs());
    let scale = power_of_two(sum);
    let scaled: Matrix3<f64> = f * scale;
    let rotation = if f.m13 == 0.0 && f.m23 == 0.0 && f.m31 == 0.0 && f.m32 == 0.0 && f.m33 > 0.0 {
        plane_rotation(&scaled)?
    } else {
        newton_rotation(&scaled)?
    };
    let factors = corrected(&scaled, rotation);
    let stretch = factors.stretch / scale;
    stretch.is_finite().then_some(Polar {
        rotation: factors.rotation,
        stretch,
    })
}

/// In the plane `R` turns `(F11 + F22, F21 - F12)` onto the first axis.
fn plane_rotation(f: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let determinant = f.m11 * f.m22 - f.m12 * f.m21;
    if !determinant.is_finite() || determinant <= 0.0 {
        return None;
    }
    let (x, y) = (f.m11 + f.m22, f.m21 - f.m12);
    let length = (x * x + y * y).sqrt();
    let (c, s) = (x / length, y / length);
    Some(Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0))
}

/// `X ← (γX + X⁻ᵀ/γ)/2` from `X = F`.
fn newton_rotation(f: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let mut x = *f;
    for _ in 0..MAXIMAL_STEPS {
        let cofactors = cofactors(&x);
        let determinant = x.m11 * cofactors.m11 + x.m21 * cofactors.m21 + x.m31 * cofactors.m31;
        if !determinant.is_finite() || determinant <= 0.0 {
            return None;
        }
        let (gamma, reciprocal) = scaling(&x, &cofactors, determinant);
        let next = x * (0.5 * gamma) + cofactors * (0.5 * reciprocal / determinant);
        let change = squares(&(next - x));
        x = next;
        // The error left is half of the change squared: below round-off.
        if change <= 1e-16 {
            return Some(x);
        }
    }
    None
}

/// Higham's `γ = √(|X⁻¹|/|X|)` and its reciprocal, rounded to a power of two: any positive factor
/// keeps the rotation, this one costs no root or division, and it is exactly one where the
/// quadratic convergence sets in.
#[inline]
fn scaling(x: &Matrix3<f64>, cofactors: &Matrix3<f64>, determinant: f64) -> (f64, f64) {
    // The bits of a positive number are its binary logarithm, 52 places to the left, within 0.09.
    let logarithm = |value: f64| value.to_bits() as i64;
    let one = logarithm(1.0);
    let fourfold =
        logarithm(squares(cofactors)) - logarithm(squares(x)) - 2 * (logarithm(determinant) - one);
    let exponent = ((fourfold >> 2) + (1 << 51)) >> 52;
    // An exponent beyond the range of a factor is approached in several steps.
    let bits = exponent.clamp(-1000, 1000) << 52;
    (
        f64::from_bits((one + bits) as u64),
        f64::from_bits((one - bits) as u64),
    )
}

/// `Σ m_ij²`, summed by columns side by side.
#[inline]
fn squares(m: &Matrix3<f64>) -> f64 {
    (m.m11 * m.m11 + m.m21 * m.m21 + m.m31 * m.m31)
        + (m.m12 * m.m12 + m.m22 * m.m22 + m.m32 * m.m32)
        + (m.m13 * m.m13 + m.m23 * m.m23 + m.m33 * m.m33)
}

/// `det X · X⁻ᵀ`, written out: nalgebra's column views cost as much as the arithmetic.
#[inline]
fn cofactors(x: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::new(
        x.m22 * x.m33 - x.m23 * x.m32,
        x.m23 * x.m31 - x.m21 * x.m33,
        x.m21 * x.m32 - x.m22 * x.m31,
        x.m13 * x.m32 - x.m12 * x.m33,
        x.m11 * x.m33 - x.m13 * x.m31,
        x.m12 * x.m31 - x.m11 * x.m32,
        x.m12 * x.m23 - x.m13 * x.m22,
        x.m13 * x.m21 - x.m11 * x.m23,
        x.m11 * x.m22 - x.m12 * x.m21,
    )
}

/// Turns `R` until `RᵀF` is symmetric to round-off.
///
/// Cofactors of a strongly graded `F` carry more error than the problem; what they leave shows as
/// an asymmetry, and turning by `ω` with `(tr U - U) ω` equal to its axial vector removes it.
fn corrected(f: &Matrix3<f64>, rotation: Matrix3<f64>) -> Polar {
    let mut result = rotation;
    let tolerance = 64.0 * f64::EPSILON * f64::EPSILON * squares(f);
    for _ in 0..MAXIMAL_CORRECTIONS {
        let m = result.transpose() * f;
        let axial = Vector3::new(m.m32 - m.m23, m.m13 - m.m31, m.m21 - m.m12);
        let stretch = Sym::from_matrix(&m);
        if axial.norm_squared() <= tolerance {
            return Polar {
                rotation: result,
                stretch,
            };
        }
        let Some(inverse) = (Sym::IDENTITY * stretch.trace() - stretch).inverse() else {
            break;
        };
        let turn = inverse.traction(&axial);
        result *= crate::rotation(&turn, turn.norm());
    }
    Polar {
        rotation: result,
        stretch: Sym::from_matrix(&(result.transpose() * f)),
    }
}
