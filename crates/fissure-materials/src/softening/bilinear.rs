//! Two straight lines that meet in a kink [Petersson 1981; Rabczuk 2007, fig. 5b].
//!
//! ```text
//! f = 1 − (1 − r) s/s₁            s ≤ s₁                                     (1)
//! f = r (c − s)/(c − s₁)          s₁ < s < c                                 (2)
//! c = (2 − s₁)/r                  unit area: s₁(1 + r)/2 + r(c − s₁)/2 = 1   (3)
//! ```
//! with the kink at `(s₁, r)`. It must lie before the critical opening, `s₁ < c`, that is
//! `s₁ < 2/(1 + r)`.

use super::Softening;
use crate::{MaterialError, check_parameter};

const NAME: &str = "bilinear softening";

/// Two straight lines. The default is Petersson's curve of concrete: a third of the strength at
/// `0.8 G/σ`, none at `3.6 G/σ`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bilinear {
    /// Opening of the kink `s₁`, over `G/σ`; in (0, 2/(1 + `kink_ratio`)).
    pub kink_opening: f64,
    /// Traction at the kink over strength `r`; in (0, 1).
    pub kink_ratio: f64,
}

impl Default for Bilinear {
    fn default() -> Self {
        Self {
            kink_opening: 0.8,
            kink_ratio: 1.0 / 3.0,
        }
    }
}

impl Bilinear {
    /// `−slope` of the first and of the second line.
    #[inline]
    fn slopes(&self) -> (f64, f64) {
        let tail = self.critical() - self.kink_opening;
        (
            (1.0 - self.kink_ratio) / self.kink_opening,
            self.kink_ratio / tail,
        )
    }
}

impl Softening for Bilinear {
    fn check(&self) -> Result<(), MaterialError> {
        let (ratio, opening) = (self.kink_ratio, self.kink_opening);
        check_parameter(
            NAME,
            "kink_ratio",
            ratio,
            ratio > 0.0 && ratio < 1.0,
            "in (0, 1)",
        )?;
        check_parameter(
            NAME,
            "kink_opening",
            opening,
            opening > 0.0 && opening < 2.0 / (1.0 + ratio),
            "in (0, 2/(1 + kink_ratio)): beyond, the first line alone has more than unit area",
        )
    }
    #[inline]
    fn ratio(&self, s: f64) -> f64 {
        let (first, second) = self.slopes();
        if s <= self.kink_opening {
            1.0 - first * s
        } else {
            (second * (self.critical() - s)).max(0.0)
        }
    }
    #[inline]
    fn slope(&self, s: f64) -> f64 {
        let (first, second) = self.slopes();
        if s < self.kink_opening {
            -first
        } else if s < self.critical() {
            -second
        } else {
            0.0
        }
    }
    #[inline]
    fn area(&self, s: f64) -> f64 {
        let (first, second) = self.slopes();
        if s <= self.kink_opening {
            s - 0.5 * first * s * s
        } else {
            // What the triangle beyond s still has is missing to 1.
            let left = (self.critical() - s).max(0.0);
            1.0 - 0.5 * second * left * left
        }
    }
    #[inline]
    fn critical(&self) -> f64 {
        (2.0 - self.kink_opening) / self.kink_ratio
    }
    #[inline]
    fn steepest(&self) -> f64 {
        let (first, second) = self.slopes();
        first.max(second)
    }
}
