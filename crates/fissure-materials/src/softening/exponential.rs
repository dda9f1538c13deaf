//! Exponential softening [Nairn 2017, app. I, eq. 49].
//!
//! `f = e⁻ˢ`, `∫₀ˢ f = 1 − e⁻ˢ`, `max(−f') = 1`. The traction never vanishes: such a crack does not
//! fail, and has spent all but `e⁻ˢ` of its toughness. It is not cut off.

use super::Softening;

/// Traction `e⁻ˢ`; the critical opening is infinite.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exponential;

impl Softening for Exponential {
    #[inline]
    fn ratio(&self, s: f64) -> f64 {
        (-s).exp()
    }
    #[inline]
    fn slope(&self, s: f64) -> f64 {
        -(-s).exp()
    }
    #[inline]
    fn area(&self, s: f64) -> f64 {
        -(-s).exp_m1()
    }
    #[inline]
    fn critical(&self) -> f64 {
        f64::INFINITY
    }
    #[inline]
    fn steepest(&self) -> f64 {
        1.0
    }
}
