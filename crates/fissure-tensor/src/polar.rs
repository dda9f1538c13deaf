//! Polar decomposition `F = R·U`.

use crate::eigen::power_of_two;
use crate::{Matrix3, Sym, Vector3};

/// Newton steps allowed; scaled, about nine are taken at a condition number of 1e16.
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
/// Plane deformation gradients take a closed form, those of a strain up to a few hundredths the series of the root of `FᵀF`,
/// the others first some steps of Newton's iteration with Higham's scaling (Higham 1986, SIAM J. Sci. Stat. Comput. 7, 1160).
/// The factors reproduce `F`, and the rotation is orthogonal, to a few units of round-off. The rotation itself
/// is determined by `F` to round-off times `σ₁/(σ₂+σ₃)` and no better.
#[inline]
pub fn polar(f: &Matrix3<f64>) -> Option<Polar> {
    let plane = f.m13 == 0.0 && f.m23 == 0.0 && f.m31 == 0.0 && f.m32 == 0.0 && f.m33 > 0.0;
    let quick = if plane {
        plane_polar(f)
    } else {
        near_rotation(f)
    };
    quick.or_else(|| general_polar(f))
}

/// Sums of squares in between neither over- nor underflow, nor do their products.
const MODERATE: std::ops::Range<f64> = 1e-100..1e100;

/// In the plane `R` turns `(F11 + F22, F21 - F12)` onto the first axis, and that has at least the length of `F`: nothing
/// cancels. `None` where the numbers are not moderate, or `det F ≤ 0`.
#[inline]
fn plane_polar(f: &Matrix3<f64>) -> Option<Polar> {
    let determinant = f.m11 * f.m22 - f.m12 * f.m21;
    let (x, y) = (f.m11 + f.m22, f.m21 - f.m12);
    let squared = x * x + y * y;
    if !(MODERATE.contains(&determinant) && MODERATE.contains(&squared) && f.m33 < f64::INFINITY) {
        return None;
    }
    // Quotients: without rotation the stretch is `F` to the last bit.
    let length = squared.sqrt();
    let (c, s) = (x / length, y / length);
    let across = 0.5 * (c * (f.m12 + f.m21) + s * (f.m22 - f.m11));
    Some(Polar {
        rotation: Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
        stretch: Sym::new(
            c * f.m11 + s * f.m21,
            c * f.m22 - s * f.m12,
            f.m33,
            0.0,
            0.0,
            across,
        ),
    })
}

/// `U = √(FᵀF)` by its series and `R = F·U⁻¹`; `None` where the strain is not small, or `det F ≤ 0`.
#[inline]
fn near_rotation(f: &Matrix3<f64>) -> Option<Polar> {
    let cofactors = cofactors(f);
    let determinant = f.m11 * cofactors.m11 + f.m21 * cofactors.m21 + f.m31 * cofactors.m31;
    if !(determinant > 0.0) {
        return None;
    }
    series(f)
}

/// The same of a matrix with positive determinant.
#[inline(always)]
fn series(f: &Matrix3<f64>) -> Option<Polar> {
    let strain = Sym::new(
        f.m11 * f.m11 + f.m21 * f.m21 + f.m31 * f.m31 - 1.0,
        f.m12 * f.m12 + f.m22 * f.m22 + f.m32 * f.m32 - 1.0,
        f.m13 * f.m13 + f.m23 * f.m23 + f.m33 * f.m33 - 1.0,
        f.m12 * f.m13 + f.m22 * f.m23 + f.m32 * f.m33,
        f.m11 * f.m13 + f.m21 * f.m23 + f.m31 * f.m33,
        f.m11 * f.m12 + f.m21 * f.m22 + f.m31 * f.m32,
    );
    let stretch = Sym::IDENTITY + strain.root_of_one_plus()?;
    // The stretch is near the identity: cofactors lose nothing.
    let inverse = stretch.adjugate() * (1.0 / stretch.determinant());
    Some(Polar {
        rotation: f * inverse.to_matrix(),
        stretch,
    })
}

/// At any strain and size.
#[inline(never)]
fn general_polar(f: &Matrix3<f64>) -> Option<Polar> {
    // Magnitude near one, by a power of two: no determinant under- or overflows.
    let sum = (f.m11.abs() + f.m21.abs() + f.m31.abs())
        + (f.m12.abs() + f.m22.abs() + f.m32.abs())
        + (f.m13.abs() + f.m23.abs() + f.m33.abs());
    let scale = power_of_two(sum);
    let scaled: Matrix3<f64> = f * scale;
    let factors = corrected(&scaled, newton_rotation(&scaled)?);
    let stretch = factors.stretch / scale;
    stretch.is_finite().then_some(Polar {
        rotation: factors.rotation,
        stretch,
    })
}

/// `X ← (γX + X⁻ᵀ/γ)/2` from `X = F`, which has the same rotation, until the series takes over.
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
        // The strain left is half of this, which is the square of the strain there was.
        if change <= 0.1
            && let Some(factors) = series(&x)
        {
            return Some(factors.rotation);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation;

    /// Gradients of strain up to some percent and rotation of all sizes, in the plane or not.
    fn gradients(plane: bool) -> impl Iterator<Item = Matrix3<f64>> {
        (0..400).map(move |i| {
            let number = |k: i32| f64::from(i * k + k).sin();
            let size = 0.012 * 10f64.powf(-0.03 * f64::from(i));
            let mut strain = Sym::new(number(2), number(3), number(5), 0.0, 0.0, number(11));
            let mut axis = Vector3::new(0.0, 0.0, number(13));
            if !plane {
                strain += Sym::new(0.0, 0.0, 0.0, number(7), number(17), 0.0);
                axis += Vector3::new(number(19), number(23), 0.0);
            }
            let turn = axis * 1.8;
            rotation(&turn, turn.norm()) * (Matrix3::identity() + (strain * size).to_matrix())
        })
    }

    #[test]
    fn the_quick_ways_and_the_general_one_agree() {
        for (plane, quick) in [
            (true, plane_polar as fn(&Matrix3<f64>) -> Option<Polar>),
            (false, near_rotation),
        ] {
            for f in gradients(plane) {
                let (Some(quick), Some(general)) = (quick(&f), general_polar(&f)) else {
                    panic!("{f}");
                };
                let turn = (quick.rotation - general.rotation).abs().max();
                let stretch = (quick.stretch - general.stretch).max_abs();
                assert!(turn < 2e-15 && stretch < 2e-15, "{turn:e}, {stretch:e}");
            }
        }
    }

    #[test]
    fn the_quick_ways_leave_what_is_not_theirs() {
        let mirrored = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
        assert!(plane_polar(&mirrored).is_none() && near_rotation(&mirrored).is_none());
        assert!(plane_polar(&(Matrix3::identity() * 1e-60)).is_none());
        assert!(near_rotation(&(Matrix3::identity() * 1.2)).is_none());
        assert!(near_rotation(&Matrix3::from_element(f64::NAN)).is_none());
    }
}
