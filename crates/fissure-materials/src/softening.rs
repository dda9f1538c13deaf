//! Softening laws: the traction a crack still carries, dimensionless.
//!
//! With strength `σ`, toughness `G` and opening `w` the argument is `s = w σ / G` and the traction
//! is `σ·ratio(s)`. Every law has unit area, so none can miscount the toughness.

use std::fmt::Debug;

/// A dimensionless softening curve with `∫ratio ds = 1`.
pub trait Softening: Copy + Debug + Send + Sync + 'static {
    /// Traction over strength at opening `s ≥ 0`; 1 at 0, never rising, 0 from `critical` on.
    fn ratio(&self, s: f64) -> f64;
    /// Derivative of `ratio`.
    fn slope(&self, s: f64) -> f64;
    /// `∫₀ˢ ratio`: energy dissipated over toughness.
    fn area(&self, s: f64) -> f64;
    /// Opening at which the traction vanishes (may be infinite).
    fn critical(&self) -> f64;
    /// Largest `−slope`; a point is stable if its stiffness over the band exceeds it.
    fn steepest(&self) -> f64;
}

/// Traction falling in a straight line, `1 − s/2` [Sanchez 2010, eq. 3.5.63].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Linear;

impl Softening for Linear {
    #[inline]
    fn ratio(&self, s: f64) -> f64 {
        (1.0 - 0.5 * s).max(0.0)
    }
    #[inline]
    fn slope(&self, s: f64) -> f64 {
        if s < 2.0 { -0.5 } else { 0.0 }
    }
    #[inline]
    fn area(&self, s: f64) -> f64 {
        let s = s.min(2.0);
        s - 0.25 * s * s
    }
    #[inline]
    fn critical(&self) -> f64 {
        2.0
    }
    #[inline]
    fn steepest(&self) -> f64 {
        0.5
    }
}

/// The opening `s ≥ s_old` at which the elastic unloading line of a point meets its softening
/// curve: `load − stiffness·s = ratio(s)`, both over the strength.
///
/// `stiffness > softening.steepest()` makes the difference monotone, so the root is unique; it is
/// found by Newton's method inside a shrinking bracket, which takes one step where the curve is
/// straight. Returns `load / stiffness` (no traction left) if that is beyond `critical`.
pub fn opening(softening: &impl Softening, load: f64, stiffness: f64, s_old: f64) -> f64 {
    let traction_free = load / stiffness;
    if traction_free >= softening.critical() {
        return traction_free;
    }
    let (mut low, mut high) = (s_old, traction_free);
    let mut s = s_old;
    for _ in 0..100 {
        let excess = load - stiffness * s - softening.ratio(s);
        if excess > 0.0 {
            low = s
        } else {
            high = s
        }
        let newton = s + excess / (stiffness + softening.slope(s));
        let next = if newton >= low && newton <= high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - s).abs() <= 2.0 * f64::EPSILON * next.abs() {
            return next;
        }
        s = next;
    }
    s
}
