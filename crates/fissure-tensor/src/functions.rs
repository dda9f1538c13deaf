//! Isotropic functions of symmetric tensors: exponential, logarithm, square root, inverse, parts.

use crate::Sym;
use crate::eigen::power_of_two;

/// Distance from the identity below which a logarithm is that of the difference.
const NEAR_IDENTITY: f64 = 0.5;

impl Sym {
    /// Exponential `Σ exp(λ_i) n_i ⊗ n_i`; [`exponential`](crate::exponential) takes any matrix.
    pub fn exp(&self) -> Self {
        self.spectrum().map(f64::exp)
    }

    /// `exp(A) - I` to full relative accuracy for small `A`.
    pub fn exp_minus_one(&self) -> Self {
        self.spectrum().map(f64::exp_m1)
    }

    /// Logarithm, or `None` unless the tensor is positive definite and finite.
    ///
    /// Near the identity it is that of the exact difference, so that nothing is lost but what the
    /// rounding of `A` itself has taken; where the difference is known better than `A`, use
    /// [`Sym::log_of_one_plus`].
    pub fn log(&self) -> Option<Self> {
        let difference = *self - Self::IDENTITY;
        if difference.max_abs() <= NEAR_IDENTITY {
            return difference.log_of_one_plus();
        }
        let spectrum = self.spectrum();
        (self.is_finite() && spectrum.values[2] > 0.0).then(|| spectrum.map(f64::ln))
    }

    /// `log(I + E)` to full relative accuracy for small `E`, or `None` unless `I + E` is positive
    /// definite and finite.
    ///
    /// With `E = (H + Hᵀ + Hᵀ·H)/2` from a displacement gradient `H`, the Hencky strain `ln U` is
    /// half of `(2E).log_of_one_plus()`, without the cancellation of `F - I`.
    pub fn log_of_one_plus(&self) -> Option<Self> {
        let spectrum = self.spectrum();
        (self.is_finite() && spectrum.values[2] > -1.0).then(|| spectrum.map(f64::ln_1p))
    }

    /// The positive semidefinite square root, or `None` for other tensors.
    ///
    /// A smallest eigenvalue below zero by round-off, 4 epsilons of the norm, counts as zero.
    pub fn sqrt(&self) -> Option<Self> {
        let spectrum = self.spectrum();
        let allowed = 4.0 * f64::EPSILON * self.norm();
        (self.is_finite() && spectrum.values[2] >= -allowed)
            .then(|| spectrum.map(|value| value.max(0.0).sqrt()))
    }

    /// Inverse, or `None` if elimination meets a zero pivot, or tensor or result is not finite.
    ///
    /// By elimination with pivoting: the error is of the order of round-off times the condition
    /// number, at any magnitude, where cofactors would lose up to its square.
    pub fn inverse(&self) -> Option<Self> {
        // A power of two brings the largest component into [1, 2), so that no product is lost.
        let scale = power_of_two(self.max_abs());
        if !self.is_finite() {
            return None;
        }
        let inverse = (*self * scale).to_matrix().lu().try_inverse()?;
        let inverse = Self::from_matrix(&inverse) * scale;
        inverse.is_finite().then_some(inverse)
    }

    /// Adjugate, `A·adj A = det A · I`.
    #[inline]
    pub fn adjugate(&self) -> Self {
        let (xx, yy, zz) = (self.xx(), self.yy(), self.zz());
        let (yz, xz, xy) = (self.yz(), self.xz(), self.xy());
        Self::new(
            yy * zz - yz * yz,
            xx * zz - xz * xz,
            xx * yy - xy * xy,
            xy * xz - xx * yz,
            xy * yz - yy * xz,
            xz * yz - zz * xy,
        )
    }

    /// The part with the positive eigenvalues, `Σ max(λ_i, 0) n_i ⊗ n_i`.
    ///
    /// The tensor itself, to the last bit, if none is negative, and zero if none is positive.
    pub fn positive_part(&self) -> Self {
        let spectrum = self.spectrum();
        if spectrum.values[2] >= 0.0 {
            *self
        } else if spectrum.values[0] <= 0.0 {
            Self::ZERO
        } else {
            // NaN must survive, which `f64::max` would not let it.
            spectrum.map(|value| if value < 0.0 { 0.0 } else { value })
        }
    }

    /// The part with the negative eigenvalues, so that both parts add up to the tensor.
    pub fn negative_part(&self) -> Self {
        *self - self.positive_part()
    }
}
