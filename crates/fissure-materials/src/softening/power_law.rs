//! Power-law softening [Nairn 2017, app. I, eq. 47].
//!
//! ```text
//! f = 1 − (s/c)ⁿ,  c = (1 + n)/n                                             (1)
//! f' = −(n/c)(s/c)ⁿ⁻¹,  max(−f') = n/c = n²/(1 + n)                          (2)
//! ∫₀ˢ f = s (1 − (s/c)ⁿ/(1 + n))                                             (3)
//! ```
//! For `n < 1` the slope at the start is infinite, so no band is small enough: always unstable,
//! and refused. `n = 1` is [`Linear`](super::Linear).

use super::Softening;
use crate::{MaterialError, check_parameter};

/// Traction `1 − (s/c)ⁿ`: slow at first and then ever faster for `n > 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// Exponent n; finite and ≥ 1.
    pub exponent: f64,
}

impl Softening for PowerLaw {
    fn check(&self) -> Result<(), MaterialError> {
        let n = self.exponent;
        check_parameter(
            "power-law softening",
            "exponent",
            n,
            n >= 1.0,
            "finite and ≥ 1: below 1 the curve starts with an infinite slope and is unstable for \
             every band",
        )
    }
    #[inline]
    fn ratio(&self, s: f64) -> f64 {
        (1.0 - (s / self.critical()).powf(self.exponent)).max(0.0)
    }
    #[inline]
    fn slope(&self, s: f64) -> f64 {
        let critical = self.critical();
        if s >= critical {
            return 0.0;
        }
        -self.steepest() * (s / critical).powf(self.exponent - 1.0)
    }
    #[inline]
    fn area(&self, s: f64) -> f64 {
        let (n, critical) = (self.exponent, self.critical());
        let x = (s / critical).min(1.0);
        if x < 0.5 {
            return s * (1.0 - x.powf(n) / (1.0 + n));
        }
        if x == 1.0 {
            return 1.0;
        }
        // What is left is missing to 1: round-off never lowers it towards the end.
        let y = 1.0 - x;
        1.0 - critical * (y + ((1.0 + n) * (-y).ln_1p()).exp_m1() / (1.0 + n))
    }
    #[inline]
    fn critical(&self) -> f64 {
        (1.0 + self.exponent) / self.exponent
    }
    #[inline]
    fn steepest(&self) -> f64 {
        self.exponent / self.critical()
    }
}
