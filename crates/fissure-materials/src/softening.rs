//! Softening laws: the traction a crack still carries, dimensionless.
//!
//! With strength `σ`, toughness `G` and opening `w` the argument is `s = w σ/G` and the traction is
//! `σ·f(s)`, `f` being [`Softening::ratio`]. Every law has unit area, so none can miscount the
//! toughness. In the notation of [Nairn 2017, app. I] the crack's strain is `δ = s·G/(σL)` with the
//! band `L = V_p/A_c`, so his `sG_c` is `G/(σL)` and his `δ_max` is `critical·G/(σL)`.
//!
//! | law | `f(s)` | critical | steepest | η |
//! |---|---|---|---|---|
//! | [`Linear`] | `1 − s/2` | 2 | 1/2 | 2 |
//! | [`Bilinear`] | two straight lines, kink at `(s₁, r)` | `(2 − s₁)/r` | of the steeper line | 1/steepest |
//! | [`PowerLaw`] | `1 − (s/c)ⁿ`, n ≥ 1 | `c = (1 + n)/n` | `n/c` | `(1 + n)/n²` |
//! | [`Exponential`] | `e⁻ˢ` | ∞ | 1 | 1 |
//! | [`CubicStep`] | `1 − 3(s/2)² + 2(s/2)³` | 2 | 3/4 | 4/3 |
//! | [`DoubleExponential`] | `(e⁻ᵏˢ − β e⁻ᵅᵏˢ)/(1 − β)` | ∞ | see there | 1/steepest |
//!
//! η is the stability factor of [Nairn 2017, eq. 37]: a material point follows the curve uniquely
//! while its band is below `η C G/σ²` (eq. 36). Among curves of one area the straight line has the
//! largest η, 2. A curve of one's own implements [`Softening`];
//! [`contract::check_softening`](crate::contract::check_softening) then checks it.

mod bilinear;
mod cubic_step;
mod double_exponential;
mod exponential;
mod linear;
mod opening;
mod power_law;
#[cfg(test)]
mod tests;

use std::fmt::Debug;

use crate::MaterialError;

pub use bilinear::Bilinear;
pub use cubic_step::CubicStep;
pub use double_exponential::DoubleExponential;
pub use exponential::Exponential;
pub use linear::Linear;
pub use opening::opening;
pub use power_law::PowerLaw;

/// A dimensionless softening curve with `∫ratio ds = 1`.
pub trait Softening: Copy + Debug + Send + Sync + 'static {
    /// Traction over strength at opening `s ≥ 0`; 1 at 0, never rising, 0 from `critical` on.
    fn ratio(&self, s: f64) -> f64;

    /// Derivative of `ratio`.
    fn slope(&self, s: f64) -> f64;

    /// `∫₀ˢ ratio`: work done on the crack over toughness, which is what it has dissipated if its
    /// opening is permanent.
    fn area(&self, s: f64) -> f64;

    /// Opening at which the traction vanishes (may be infinite).
    fn critical(&self) -> f64;

    /// Largest `−slope`; a point is stable if its stiffness over the band exceeds it.
    fn steepest(&self) -> f64;

    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`] with the field, the value and the rule.
    fn check(&self) -> Result<(), MaterialError> {
        Ok(())
    }

    /// Nairn's dimensionless stability factor η, `1/(steepest · ∫ratio)` [Nairn 2017, eq. 37]; at
    /// most 2. The largest stable band is η times stiffness times toughness over strength squared.
    fn stability(&self) -> f64 {
        1.0 / self.steepest()
    }

    /// `∫₀ˢ ratio − s·ratio/2`: energy dissipated over toughness if the crack unloads elastically
    /// to the origin, which gives the second term back [Nairn 2017, eq. 31]; 1 when failed.
    fn dissipated_to_origin(&self, s: f64) -> f64 {
        if s >= self.critical() {
            return self.area(s);
        }
        self.area(s) - 0.5 * s * self.ratio(s)
    }
}
