//! Two exponentials. One of the laws of Nairn's code that belongs to [Nairn 2017] (OSUPDocs, "Double
//! Exponential Softening"); app. I of the paper itself does not print it.
//!
//! ```text
//! f = (e⁻ᵏˢ − β e⁻ᵅᵏˢ)/(1 − β),  k = (α − β)/(α(1 − β))  for unit area        (1)
//! ∫₀ˢ f = (g(k) − β g(αk))/(1 − β),  g(x) = (1 − e⁻ˣˢ)/x                     (2)
//! max(−f') = k(1 − αβ)/(1 − β)  at s = 0               if α²β ≤ 1           (3)
//! max(−f') = k(α − 1)/(α(1 − β)) (α²β)^(−1/(α−1))      else                  (4)
//! ```
//! The traction never rises while `αβ ≤ 1`. `β = 1/α` starts with no slope, `β = 0` is
//! [`Exponential`](super::Exponential), `β < 0` adds a fast decay to a slow one.

use super::Softening;
use crate::{MaterialError, check_parameter};

const NAME: &str = "double-exponential softening";

/// Traction of two exponentials; the critical opening is infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleExponential {
    /// Decay of the second exponential over that of the first, α; finite and > 1.
    pub decay_ratio: f64,
    /// Weight of the second exponential β, taken away from the first; finite and ≤ 1/α.
    pub weight: f64,
}

impl DoubleExponential {
    /// Decay of the first exponential, `k` of equation (1).
    #[inline]
    fn decay(&self) -> f64 {
        (self.decay_ratio - self.weight) / (self.decay_ratio * (1.0 - self.weight))
    }
}

impl Softening for DoubleExponential {
    fn check(&self) -> Result<(), MaterialError> {
        let (alpha, beta) = (self.decay_ratio, self.weight);
        check_parameter(NAME, "decay_ratio", alpha, alpha > 1.0, "finite and > 1")?;
        check_parameter(
            NAME,
            "weight",
            beta,
            beta <= 1.0 / alpha,
            "finite and ≤ 1/decay_ratio: above, the traction would rise first",
        )
    }
    #[inline]
    fn ratio(&self, s: f64) -> f64 {
        let (first, beta) = (-self.decay() * s, self.weight);
        let second = self.decay_ratio * first;
        if second > -1.0 {
            // Without cancellation where the curve starts flat, so that round-off never lifts it.
            return 1.0 + (first.exp_m1() - beta * second.exp_m1()) / (1.0 - beta);
        }
        (first.exp() - beta * second.exp()) / (1.0 - beta)
    }
    #[inline]
    fn slope(&self, s: f64) -> f64 {
        let (k, alpha, beta) = (self.decay(), self.decay_ratio, self.weight);
        -k * ((-k * s).exp() - alpha * beta * (-alpha * k * s).exp()) / (1.0 - beta)
    }
    #[inline]
    fn area(&self, s: f64) -> f64 {
        let (k, beta) = (self.decay(), self.weight);
        let fast = self.decay_ratio * k;
        if k * s < 1.0 {
            let part = |decay: f64| -(-decay * s).exp_m1() / decay;
            return (part(k) - beta * part(fast)) / (1.0 - beta);
        }
        // What is left is missing to 1: round-off never lowers it towards the end.
        let left = |decay: f64| (-decay * s).exp() / decay;
        1.0 - (left(k) - beta * left(fast)) / (1.0 - beta)
    }
    #[inline]
    fn critical(&self) -> f64 {
        f64::INFINITY
    }
    #[inline]
    fn steepest(&self) -> f64 {
        let (k, alpha, beta) = (self.decay(), self.decay_ratio, self.weight);
        let factor = alpha * alpha * beta;
        if factor <= 1.0 {
            return k * (1.0 - alpha * beta) / (1.0 - beta);
        }
        k * (alpha - 1.0) / (alpha * (1.0 - beta)) * factor.powf(-1.0 / (alpha - 1.0))
    }
}
