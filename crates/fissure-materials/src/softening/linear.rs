//! Traction falling in a straight line [Sanchez 2010, eq. 3.5.63; Nairn 2017, eq. 48].

use super::Softening;

/// Traction falling in a straight line, `1 − s/2`: the most stable curve, η = 2.
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
        if s < 1.0 {
            return s - 0.25 * s * s;
        }
        // What is left is missing to 1: round-off never lowers it towards the end.
        let left = (1.0 - 0.5 * s).max(0.0);
        1.0 - left * left
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
