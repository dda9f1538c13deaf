//! The cubic step function as a softening curve. It is one of the laws of Nairn's code that belongs
//! to [Nairn 2017] (OSUPDocs, "Cubic Step Function Softening", with zero initial slope); app. I of
//! the paper itself does not print it.
//!
//! ```text
//! f = 1 − 3x² + 2x³,  x = s/2                                                (1)
//! f' = −3x(1 − x),  max(−f') = 3/4 at x = 1/2                                (2)
//! ∫₀ˢ f = s (1 − x² + x³/2)                                                  (3)
//! ```

use super::Softening;

/// Traction that leaves the strength and reaches zero with no slope; η = 4/3.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CubicStep;

impl Softening for CubicStep {
    #[inline]
    fn ratio(&self, s: f64) -> f64 {
        let x = 0.5 * s;
        if x < 0.5 {
            return 1.0 - x * x * (3.0 - 2.0 * x);
        }
        // Equation (1) factored: no cancellation towards the critical opening.
        let left = (1.0 - x).max(0.0);
        left * left * (1.0 + s)
    }
    #[inline]
    fn slope(&self, s: f64) -> f64 {
        -1.5 * s * (1.0 - 0.5 * s).max(0.0)
    }
    #[inline]
    fn area(&self, s: f64) -> f64 {
        let x = 0.5 * s;
        if x < 0.5 {
            return s * (1.0 - x * x * (1.0 - 0.5 * x));
        }
        // What is left is missing to 1: round-off never lowers it towards the end.
        let left = (1.0 - x).max(0.0);
        1.0 - left * left * left * (2.0 - left)
    }
    #[inline]
    fn critical(&self) -> f64 {
        2.0
    }
    #[inline]
    fn steepest(&self) -> f64 {
        0.75
    }
}
