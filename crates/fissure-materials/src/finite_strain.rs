//! What hyperelastic laws on the left Cauchy-Green tensor need, without cancellation near rest.

use std::f64::consts::FRAC_1_SQRT_2;

use fissure_tensor::{Matrix3, Sym};

use crate::MaterialError;

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
        let determinant = f.determinant();
        let h = f - Matrix3::identity();
        let second = h.m11 * h.m22 - h.m12 * h.m21 + h.m22 * h.m33 - h.m23 * h.m32 + h.m33 * h.m11
            - h.m31 * h.m13;
        let third = h.determinant();
        let dilation = h.trace() + second + third;
        let square = h.norm_squared();
        // `J` is had in two ways, which round apart: next to a singular gradient either may be zero
        // or less while the other is not. A component that is not finite makes the square so.
        let sound = determinant > 0.0 && determinant.is_finite() && dilation > -1.0;
        if !(sound && square.is_finite()) {
            return Err(MaterialError::Deformation { determinant });
        }
        Ok(Self {
            excess: Sym::from_matrix(&h) * 2.0 + Sym::from_matrix(&(h * h.transpose())),
            dilation,
            distortion: square - 2.0 * (second + third),
        })
    }

    /// `V − 1 = √b − 1`; `None` where `|b − 1|` is over 0.1.
    ///
    /// The binomial series of the root of `1 + A`, `A = b − 1`, by Horner's rule with the powers of
    /// `A` reduced by Cayley and Hamilton, is cut off where the terms are below round-off.
    #[inline]
    pub fn root(&self) -> Option<Sym> {
        let a = &self.excess;
        let squared = a.dot(a);
        let terms = if squared <= 1e-6 {
            6
        } else if squared <= 1e-4 {
            9
        } else if squared <= 1e-2 {
            16
        } else {
            return None;
        };
        let first = a.trace();
        let second = 0.5 * (first * first - squared);
        let third = a.determinant();
        let (mut p, mut q, mut r) = (ROOT[terms - 1], 0.0, 0.0);
        for c in ROOT[..terms - 1].iter().rev() {
            (p, q, r) = (c + third * r, p - second * r, q + first * r);
        }
        let powers = *a * (p - second * r) + product(a, a) * (q + first * r);
        Some(Sym::IDENTITY * (third * r) + powers)
    }

    /// `J`.
    #[inline(always)]
    pub fn jacobian(&self) -> f64 {
        1.0 + self.dilation
    }

    /// `ln J`.
    #[inline(always)]
    pub fn log_jacobian(&self) -> f64 {
        self.dilation.ln_1p()
    }
}

/// `√(1 + x) − 1 = Σ c_k x^k`, from `c_1`.
const ROOT: [f64; 16] = [
    0.5,
    -0.125,
    0.0625,
    -0.039_062_5,
    0.027_343_75,
    -0.020_507_812_5,
    0.016_113_281_25,
    -0.013_092_041_015_625,
    0.010_910_034_179_687_5,
    -0.009_273_529_052_734_375,
    0.008_008_956_909_179_688,
    -0.007_007_837_295_532_227,
    0.006_199_240_684_509_277,
    -0.005_535_036_325_454_712,
    0.004_981_532_692_909_241,
    -0.004_514_514_002_948_999,
];

/// The product of two symmetric tensors that commute, which is symmetric.
#[inline]
pub(crate) fn product(a: &Sym, b: &Sym) -> Sym {
    let (a, b) = (&a.mandel, &b.mandel);
    let (yz, xz, xy) = (0.5 * a[3] * b[3], 0.5 * a[4] * b[4], 0.5 * a[5] * b[5]);
    Sym {
        mandel: [
            a[0] * b[0] + (xy + xz),
            a[1] * b[1] + (xy + yz),
            a[2] * b[2] + (xz + yz),
            a[1] * b[3] + a[3] * b[2] + FRAC_1_SQRT_2 * a[5] * b[4],
            a[0] * b[4] + a[4] * b[2] + FRAC_1_SQRT_2 * a[5] * b[3],
            a[0] * b[5] + a[5] * b[1] + FRAC_1_SQRT_2 * a[4] * b[3],
        ],
    }
}

/// `x − ln(1 + x)`, of second order in `x`, to round-off.
///
/// With `r = x/(2 + x)` it is `x r − 2 (r³/3 + r⁵/5 + …)`, from `ln(1 + x) = 2 artanh r`.
#[inline(always)]
pub(crate) fn excess_over_log(x: f64) -> f64 {
    if x.abs() > 0.1 {
        return x - x.ln_1p();
    }
    let r = x / (2.0 + x);
    let q = r * r;
    // |r| < 0.053: the first term left out is below 1e-19 of the sum.
    let tail = 1.0 / 3.0
        + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0 + q * (1.0 / 11.0 + q / 13.0))));
    x * r - 2.0 * r * q * tail
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_excess_is_smooth_across_its_branches_and_second_order() {
        for x in [0.099_999, 0.100_001, -0.099_999, -0.100_001] {
            let direct = x - f64::ln_1p(x);
            assert!((excess_over_log(x) / direct - 1.0).abs() < 1e-13);
        }
        let x = 1e-12;
        assert!((excess_over_log(x) / (0.5 * x * x) - 1.0).abs() < 1e-11);
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
