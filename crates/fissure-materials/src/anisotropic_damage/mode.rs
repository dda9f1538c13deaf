//! One mode of a crack, opening or shear: strength, toughness, softening, and what follows from
//! them on a band.
//!
//! With the effective strain `ε` of the mode (normal `ε_n` or engineering shear `γ`), its modulus
//! `M` (`C₁₁` or `G`) and the strain of the crack `δ`, the traction during damage is
//! `M(ε − δ) = σ f(δ)` (eqs 17 and 26). In the dimensionless opening `s = δ L σ/𝒢` of the softening
//! curves and with `k = M 𝒢/(σ² L)`, `x = M ε/σ`, that reads `x − k s = f(s)`.

use crate::{MaterialError, Scale, Softening, check_parameter, softening::opening};

/// Strength, toughness and softening of one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode<S> {
    /// Traction at which damage starts, Pa; > 0.
    pub strength: f64,
    /// Energy per crack area to failure, J/m²; > 0.
    pub toughness: f64,
    /// Softening curve.
    pub softening: S,
}

/// A mode at one particle: constants scaled, with its modulus and, once there is a crack, its band.
#[derive(Clone, Copy)]
pub(super) struct ModeAt<'a, S> {
    pub strength: f64,
    pub toughness: f64,
    pub modulus: f64,
    /// `k`; infinite without a band.
    pub stiffness: f64,
    pub softening: &'a S,
}

impl<S: Softening> Mode<S> {
    pub(super) fn check(
        &self,
        law: &'static str,
        names: [&'static str; 2],
    ) -> Result<(), MaterialError> {
        let (strength, toughness) = (self.strength, self.toughness);
        let rule = "finite and > 0";
        check_parameter(law, names[0], strength, strength > 0.0, rule)?;
        check_parameter(law, names[1], toughness, toughness > 0.0, rule)?;
        self.softening.check()
    }

    pub(super) fn at(&self, modulus: f64, width: f64, scale: &Scale) -> ModeAt<'_, S> {
        let strength = self.strength * scale.strength;
        let toughness = self.toughness * scale.toughness;
        ModeAt {
            strength,
            toughness,
            modulus,
            // Quotients, since a square of a strength in small units may be nothing.
            stiffness: (modulus / strength) * (toughness / strength) / width,
            softening: &self.softening,
        }
    }
}

impl<S: Softening> ModeAt<'_, S> {
    /// Largest band with a unique response, m: `M 𝒢/(σ² max(−f'))`, which is (36) with the factor
    /// `1/η = max(−f') ∫f` of (37), the area being one.
    pub fn band_limit(&self) -> f64 {
        (self.modulus / self.strength) * (self.toughness / self.strength)
            / self.softening.steepest()
    }

    /// Whether nothing is left to soften.
    pub fn is_spent(&self, softened: f64) -> bool {
        softened >= self.softening.critical()
    }

    /// The opening up to which a strain softens the mode, if it does (eqs 17, 26).
    pub fn soften(&self, strain: f64, softened: f64) -> Option<f64> {
        let load = self.modulus * strain / self.strength;
        // The slack keeps a zero increment on the softening branch from moving the state by
        // round-off.
        let slack = 8.0 * f64::EPSILON * (load + 1.0);
        let limit = self.stiffness * softened + self.softening.ratio(softened);
        if !(load > limit + slack) || self.is_spent(softened) {
            return None;
        }
        let next = opening(self.softening, load, self.stiffness, softened);
        Some(next.min(self.softening.critical()).max(softened))
    }

    /// `1 − d` (eqs 19 and 24): the secant modulus over the virgin one.
    pub fn integrity(&self, softened: f64) -> f64 {
        if softened == 0.0 {
            return 1.0;
        }
        let ratio = self.softening.ratio(softened);
        ratio / (self.stiffness * softened + ratio)
    }

    /// Slope of the traction over the strain during damage, over the modulus (eq. 17).
    pub fn slope(&self, softened: f64) -> f64 {
        let slope = self.softening.slope(softened);
        if self.is_spent(softened) {
            0.0
        } else {
            slope / (self.stiffness + slope)
        }
    }

    /// Change of the traction with the logarithm of the band during damage, at a given strain, Pa:
    /// `k` goes with `1/L`, so `dT/d ln L = σ f' s k/(k + f')`.
    pub fn widening(&self, softened: f64) -> f64 {
        self.strength * softened * self.stiffness * self.slope(softened)
    }

    /// Energy dissipated over the toughness (eq. 31): `∫₀ˢ f − s f(s)/2`.
    pub fn dissipated_fraction(&self, softened: f64) -> f64 {
        if self.is_spent(softened) {
            return 1.0;
        }
        let fraction =
            self.softening.area(softened) - 0.5 * softened * self.softening.ratio(softened);
        fraction.clamp(0.0, 1.0)
    }
}
