//! What hyperelastic laws on the left Cauchy-Green tensor need, without cancellation near rest.

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
