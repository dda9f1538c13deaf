//! What isotropic laws on the left Cauchy-Green tensor or the left stretch need, without cancellation near rest.

use std::f64::consts::SQRT_2;

use fissure_tensor::{Matrix3, Sym};

use crate::{EIGHT, EightPoints, MaterialError};

/// `b − 1` and `J − 1` from the displacement gradient `H = F − 1`.
///
/// `F − 1` is exact in floating point near rest, so both keep their relative accuracy down to the
/// smallest strains, where `F·Fᵀ − 1` and `det F − 1` would be round-off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeftStrain {
    /// `b − 1 = H + Hᵀ + H·Hᵀ`.
    pub excess: Sym,
    /// `J − 1 = I₁(H) + I₂(H) + I₃(H)`.
    pub dilation: f64,
    /// `tr b − 3 − 2(J − 1)`, of second order in the strain: `H:H − 2 I₂(H) − 2 I₃(H)`.
    pub distortion: f64,
}

impl LeftStrain {
    /// Of a deformation gradient.
    ///
    /// # Errors
    /// [`MaterialError::Deformation`] unless `F` is finite with positive determinant.
    #[inline(always)]
    pub fn new(f: &Matrix3<f64>) -> Result<Self, MaterialError> {
        let (strain, sound) = Self::of_rows(rows(f));
        if sound {
            Ok(strain)
        } else {
            let determinant = f.determinant();
            Err(MaterialError::Deformation { determinant })
        }
    }

    /// Of the deformation gradient with these components, row by row, and whether it is finite with
    /// positive determinant; without branches.
    #[inline(always)]
    pub fn of_rows(rows: [f64; 9]) -> (Self, bool) {
        let (strain, square) = Self::unchecked(rows);
        // `J` is had in two ways, which round apart: next to a singular gradient either may be zero
        // or less while the other is not. A component that is not finite makes the square so.
        let sound = keeps_orientation(rows) & (strain.dilation > -1.0) & (square < f64::INFINITY);
        (strain, sound)
    }

    /// The strain, and the sum of the squares of `H`.
    #[inline(always)]
    fn unchecked([xx, xy, xz, yx, yy, yz, zx, zy, zz]: [f64; 9]) -> (Self, f64) {
        let (xx, yy, zz) = (xx - 1.0, yy - 1.0, zz - 1.0);
        let second = (xx * yy - xy * yx) + (yy * zz - yz * zy) + (zz * xx - zx * xz);
        let third = xx * (yy * zz - yz * zy) - xy * (yx * zz - yz * zx) + xz * (yx * zy - yy * zx);
        let dilation = xx + yy + zz + second + third;
        let rows = [
            xx * xx + xy * xy + xz * xz,
            yx * yx + yy * yy + yz * yz,
            zx * zx + zy * zy + zz * zz,
        ];
        let square = rows[0] + rows[1] + rows[2];
        let strain = Self {
            excess: Sym {
                mandel: [
                    2.0 * xx + rows[0],
                    2.0 * yy + rows[1],
                    2.0 * zz + rows[2],
                    SQRT_2 * (yz + zy + (yx * zx + yy * zy + yz * zz)),
                    SQRT_2 * (xz + zx + (xx * zx + xy * zy + xz * zz)),
                    SQRT_2 * (xy + yx + (xx * yx + xy * yy + xz * yz)),
                ],
            },
            dilation,
            distortion: square - 2.0 * (second + third),
        };
        (strain, square)
    }

    /// The left stretch less one, `V − 1 = √b − 1 = R·(U − 1)·Rᵀ`, and the dilation, without a polar decomposition: of use to
    /// an isotropic law. `None` where `|b − 1|` is over 0.1, or `F` is not finite or turns space inside out.
    #[inline(always)]
    pub fn small(f: &Matrix3<f64>) -> Option<(Sym, f64)> {
        let (strain, _) = Self::unchecked(rows(f));
        // J is near one or minus one where b is near the identity.
        let root = strain.excess.root_of_one_plus()?;
        (strain.dilation > -1.0).then_some((root, strain.dilation))
    }

    /// [`small`](Self::small) of eight, to the last bit; `None` where it is for one.
    #[inline(always)]
    pub fn small_eight(points: &EightPoints) -> Option<([Sym; EIGHT], [f64; EIGHT])> {
        let mut excess = [Sym::ZERO; EIGHT];
        let mut dilation = [0.0; EIGHT];
        let mut outside_in = false;
        for place in 0..EIGHT {
            let (strain, _) = Self::unchecked(points.gradient(place));
            (excess[place], dilation[place]) = (strain.excess, strain.dilation);
            outside_in |= !(strain.dilation > -1.0);
        }
        if outside_in {
            return None;
        }
        Some((Sym::roots_of_one_plus(&excess)?, dilation))
    }

    /// `J`.
    #[inline(always)]
    pub fn jacobian(&self) -> f64 {
        1.0 + self.dilation
    }

    /// `ln J`.
    #[inline(always)]
    pub fn log_jacobian(&self) -> f64 {
        log_of_one_plus(self.dilation).0
    }
}

/// Components of a matrix, row by row.
#[inline(always)]
pub(crate) fn rows(f: &Matrix3<f64>) -> [f64; 9] {
    [
        f.m11, f.m12, f.m13, f.m21, f.m22, f.m23, f.m31, f.m32, f.m33,
    ]
}

/// Whether the determinant of a deformation gradient, given row by row and rounded as nalgebra does, is positive and finite;
/// without branches.
#[inline(always)]
pub(crate) fn keeps_orientation([xx, xy, xz, yx, yy, yz, zx, zy, zz]: [f64; 9]) -> bool {
    let determinant =
        xx * (yy * zz - yz * zy) - xy * (yx * zz - yz * zx) + xz * (yx * zy - yy * zx);
    (determinant > 0.0) & (determinant < f64::INFINITY)
}

/// `ln(1 + x)` and `x − ln(1 + x)`, the latter to round-off of its second order; `x > −1`.
///
/// Without branches and calls, so that several go on a vector unit at once. The steps are those of
/// fdlibm's `log1p`: `1 + x = 2^k (1 + f)` with `1 + f` within √2 of 1 and the remainder `c` of
/// rounding it; with `s = f/(2 + f)` the logarithm of `1 + f` is `2 artanh s = f − f²/2 + s (f²/2 + R)`,
/// `R = s² (L₁ + s² (L₂ + …))`.
#[inline(always)]
pub(crate) fn log_of_one_plus(x: f64) -> (f64, f64) {
    const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
    const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
    /// Bits of 1 and of √½, upper halves.
    const ONE: u64 = 0x3ff0_0000;
    const ROOT_HALF: u64 = 0x3fe6_a09e;
    let sum = 1.0 + x;
    let bits = sum.to_bits();
    let high = (bits >> 32) + (ONE - ROOT_HALF);
    let exponent = (high >> 20) as i32 - 0x3ff;
    let mantissa = ((high & 0xf_ffff) + ROOT_HALF) << 32 | (bits & 0xffff_ffff);
    let near = exponent == 0;
    let rounded = if exponent >= 2 {
        1.0 - (sum - x)
    } else {
        x - (sum - 1.0)
    };
    let c = if near { 0.0 } else { rounded * (1.0 / sum) };
    let f = if near {
        x
    } else {
        f64::from_bits(mantissa) - 1.0
    };
    let k = f64::from(exponent);
    let s = f / (2.0 + f);
    let z = s * s;
    // Even and odd powers by themselves: the chains of instructions are half as long.
    let w = z * z;
    let odd = 6.666_666_666_666_735e-1
        + w * (2.857_142_874_366_239e-1
            + w * (1.818_357_216_161_805e-1 + w * 1.479_819_860_511_658_6e-1));
    let even = 3.999_999_999_940_942e-1
        + w * (2.222_219_843_214_978_4e-1 + w * 1.531_383_769_920_937_3e-1);
    let series = z * odd + w * even;
    let half = 0.5 * f * f;
    let log = s * (half + series) + (k * LN_2_LOW + c) - half + f + k * LN_2_HIGH;
    // `x s − 2 (s³/3 + s⁵/5 + …)`, where `f = x`; the first term left out is below 1e-19 of the sum.
    let tail = (1.0 / 3.0 + w * (1.0 / 7.0 + w * (1.0 / 11.0)))
        + z * (1.0 / 5.0 + w * (1.0 / 9.0 + w * (1.0 / 13.0)));
    let small = x * s - 2.0 * s * z * tail;
    (log, if x.abs() <= 0.1 { small } else { x - log })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_excess_is_smooth_across_its_branches_and_second_order() {
        for x in [0.099_999, 0.100_001, -0.099_999, -0.100_001] {
            let direct = x - f64::ln_1p(x);
            assert!((log_of_one_plus(x).1 / direct - 1.0).abs() < 1e-13);
        }
        let x = 1e-12;
        assert!((log_of_one_plus(x).1 / (0.5 * x * x) - 1.0).abs() < 1e-11);
    }

    #[test]
    fn logarithms_are_those_of_the_library_to_the_last_place() {
        let sizes = (-300..300).map(|i| 10f64.powf(f64::from(i) * 0.05));
        for x in sizes.flat_map(|size| [size, -size, 0.37 * size, -0.61 * size]) {
            if x > -1.0 {
                let (found, exact) = (log_of_one_plus(x).0, x.ln_1p());
                let gap = (found - exact).abs();
                assert!(
                    gap <= f64::EPSILON * exact.abs(),
                    "{x:e}: {found:e}, {exact:e}"
                );
            }
        }
        assert_eq!(log_of_one_plus(0.0), (0.0, 0.0));
    }

    #[test]
    fn tiny_strains_keep_their_digits() -> Result<(), MaterialError> {
        let mut f = Matrix3::identity();
        f.m11 += 1e-12;
        let exact = f.m11 - 1.0;
        let strain = LeftStrain::new(&f)?;
        assert!((strain.excess.xx() / (2.0 * exact) - 1.0).abs() < 1e-11);
        assert!((strain.dilation / exact - 1.0).abs() < 1e-15);
        Ok(())
    }

    #[test]
    fn inverted_and_infinite_gradients_are_refused() {
        let mut f = Matrix3::identity();
        f.m11 = -1.0;
        assert!(LeftStrain::new(&f).is_err());
        f.m11 = f64::NAN;
        assert!(LeftStrain::new(&f).is_err());
        // Compressed to nothing along a turned axis: one of both determinants is above zero.
        for angle in 0..1000 {
            let (sin, cos) = (0.001 * f64::from(angle)).sin_cos();
            let n = fissure_tensor::Vector3::new(cos, 0.6 * sin, 0.8 * sin);
            let flat = Matrix3::identity() - n * n.transpose() / n.norm_squared();
            let strain = LeftStrain::new(&flat);
            assert!(strain.is_err() || strain.is_ok_and(|s| s.log_jacobian().is_finite()));
        }
    }
}
