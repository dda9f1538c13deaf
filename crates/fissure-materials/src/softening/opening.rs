//! Where the unloading line of a material point meets its softening curve.

use super::Softening;

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
        // Converged in the opening, or in the traction to its own round-off.
        let settled = (next - s).abs() <= 2.0 * f64::EPSILON * next.abs();
        if settled || excess.abs() <= f64::EPSILON * load {
            return next;
        }
        s = next;
    }
    s
}
