//! Traction over an effective opening, for normal, shear and mixed loading [Rabczuk 2007, sec. 4.3.2
//! and fig. 5; Camacho and Ortiz 1996; Ortiz and Pandolfi 1999].
//!
//! With the normal jump `δ_n = δ·n`, the sliding `δ_s = δ − δ_n n` [Rabczuk 2007, eqs 43, 44] and a
//! weight `β` of shear
//!
//! ```text
//! λ = √(⟨δ_n⟩² + β² |δ_s|²)                       effective opening          (1)
//! κ = max(λ over the past, δ_e),  δ_e = σ/K       irreversible               (2)
//! T(κ) = σ f((κ − δ_e) σ/G'),  G' = G − σ δ_e/2   envelope                   (3)
//! t = k (⟨δ_n⟩ n + β² δ_s),  k = T(κ)/κ           unloading to the origin    (4)
//! φ = k λ²/2                                      stored energy, t = ∂φ/∂δ   (5)
//! Ω = σδ_e/2 (1 − f) + G' (∫₀ˢ f − s f/2)          dissipated, G at failure   (6)
//! ∂t/∂δ = k M + (T' − k)/λ² (M δ) ⊗ (M δ)         while λ = κ grows          (7)
//! M = H(δ_n) n⊗n + β² (1 − n⊗n)
//! ```
//! `f` is a [`Softening`] curve, so linear, bilinear and exponential laws are one. Below `δ_e` the
//! crack is elastic with the stiffness K; it must be steep enough that the elastic triangle holds
//! less than the toughness, `K > σ²/(2G)`. In pure shear the traction peaks at `βσ` and the energy
//! is `G` too: this law has one toughness for all modes. Shear is carried while the crack is
//! pressed shut, until it has failed; friction belongs to the caller's contact.

use fissure_tensor::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::{Cohesive, Jump, Traction};
use crate::{MaterialError, Scale, Softening, check_parameter, softening::Linear};

const NAME: &str = "traction-separation law";

/// Parameters of a traction-separation law.
///
/// ```
/// use fissure_materials::{Cohesive, Jump, TractionSeparation, Vector3, softening::Exponential};
/// let law = TractionSeparation {
///     strength: 3e6,
///     toughness: 100.0,
///     stiffness: 1e13,
///     shear_weight: 0.7,
///     softening: Exponential,
/// };
/// let jump = Jump::new(Vector3::new(1e-5, 2e-5, 0.0), Vector3::x());
/// let open = law.update(&jump, &Default::default())?;
/// // Back at the origin nothing is stored, and what was dissipated stays so.
/// let shut = law.update(&Jump::new(Vector3::zeros(), Vector3::x()), &open.state)?;
/// assert!(open.dissipated > 0.0 && shut.stored == 0.0 && shut.dissipated == 0.0);
/// # Ok::<(), fissure_materials::MaterialError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TractionSeparation<S = Linear> {
    /// Largest normal traction σ, Pa; > 0.
    pub strength: f64,
    /// Energy per crack area to failure G, J/m²; > 0.
    pub toughness: f64,
    /// Stiffness before softening K, Pa/m; > σ²/(2G).
    pub stiffness: f64,
    /// Weight of sliding against opening β; ≥ 0. The strength in shear is βσ.
    pub shear_weight: f64,
    /// Softening curve.
    pub softening: S,
}

/// History of a traction-separation law. All zero until it softens.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TractionSeparationState {
    /// Largest effective opening, m; never falls.
    pub largest: f64,
    /// Energy dissipated over toughness; never falls, 1 when failed.
    pub dissipated_fraction: f64,
    /// Whether the crack carries nothing any more.
    pub failed: bool,
}

/// The envelope of one place: parameters times its scale.
struct Envelope<'a, S> {
    strength: f64,
    stiffness: f64,
    toughness: f64,
    /// End of the elastic part δ_e, m.
    elastic: f64,
    /// Energy left for softening G', J/m².
    remaining: f64,
    softening: &'a S,
}

impl<S: Softening> Envelope<'_, S> {
    /// Dimensionless softening opening.
    fn softened(&self, effective: f64) -> f64 {
        (effective - self.elastic) * self.strength / self.remaining
    }

    /// `T` at the opening κ ≥ δ_e.
    fn traction(&self, effective: f64) -> f64 {
        self.strength * self.softening.ratio(self.softened(effective))
    }

    /// `dT/dκ`.
    fn slope(&self, effective: f64) -> f64 {
        let slope = self.softening.slope(self.softened(effective));
        self.strength * self.strength / self.remaining * slope
    }

    /// Energy dissipated up to κ, equation (6), over the toughness.
    fn dissipated_fraction(&self, effective: f64) -> f64 {
        let s = self.softened(effective);
        let ramp = 0.5 * self.strength * self.elastic * (1.0 - self.softening.ratio(s));
        let softening = self.remaining * self.softening.dissipated_to_origin(s);
        ((ramp + softening) / self.toughness).min(1.0)
    }
}

impl<S: Softening> TractionSeparation<S> {
    fn envelope(&self, scale: &Scale) -> Result<Envelope<'_, S>, MaterialError> {
        let strength = self.strength * scale.strength;
        let stiffness = self.stiffness * scale.stiffness;
        let toughness = self.toughness * scale.toughness;
        let elastic = strength / stiffness;
        let remaining = toughness - 0.5 * strength * elastic;
        check_parameter(
            NAME,
            "stiffness",
            stiffness,
            remaining > 0.0,
            "over strength² / (2 toughness): the elastic part holds less than the toughness",
        )?;
        Ok(Envelope {
            strength,
            stiffness,
            toughness,
            elastic,
            remaining,
            softening: &self.softening,
        })
    }

    /// `M` of equation (7).
    fn metric(&self, normal: &Vector3<f64>, open: bool) -> Matrix3<f64> {
        let across = normal * normal.transpose();
        let weight = self.shear_weight * self.shear_weight;
        let along = (Matrix3::identity() - across) * weight;
        if open { across + along } else { along }
    }
}

impl<S: Softening> Cohesive for TractionSeparation<S> {
    type State = TractionSeparationState;

    fn check(&self) -> Result<(), MaterialError> {
        let rule = "finite and > 0";
        for (name, value) in [
            ("strength", self.strength),
            ("toughness", self.toughness),
            ("stiffness", self.stiffness),
        ] {
            check_parameter(NAME, name, value, value > 0.0, rule)?;
        }
        let weight = self.shear_weight;
        check_parameter(
            NAME,
            "shear_weight",
            weight,
            weight >= 0.0,
            "finite and ≥ 0",
        )?;
        self.softening.check()?;
        self.envelope(&Scale::default()).map(|_| ())
    }

    fn strength(&self, scale: &Scale) -> f64 {
        self.strength * scale.strength
    }

    fn toughness(&self, scale: &Scale) -> f64 {
        self.toughness * scale.toughness
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.envelope(scale).map_or(0.0, |envelope| {
            envelope.elastic + self.softening.critical() * envelope.remaining / envelope.strength
        })
    }

    fn stiffness(&self, scale: &Scale) -> f64 {
        self.stiffness * scale.stiffness * (self.shear_weight * self.shear_weight).max(1.0)
    }

    fn update(
        &self,
        jump: &Jump,
        old: &TractionSeparationState,
    ) -> Result<Traction<TractionSeparationState>, MaterialError> {
        let envelope = self.envelope(&jump.scale)?;
        let length = jump.normal.norm();
        check_parameter(NAME, "normal", length, length > 0.0, "finite, not zero")?;
        let normal = jump.normal / length;
        let opening = jump.opening.dot(&normal);
        let metric = self.metric(&normal, opening > 0.0);
        let weighted = metric * jump.opening;
        let effective = weighted.dot(&jump.opening).max(0.0).sqrt();
        if !effective.is_finite() || !opening.is_finite() {
            return Err(MaterialError::NotFinite { law: NAME });
        }
        let reached = old.largest.max(envelope.elastic);
        let mut state = *old;
        if effective > reached {
            state.largest = effective;
            state.failed = envelope.softened(effective) >= self.softening.critical();
            let fraction = envelope.dissipated_fraction(effective);
            state.dissipated_fraction = old.dissipated_fraction.max(fraction);
        }
        let greatest = reached.max(effective);
        let secant = if old.largest > 0.0 || effective > reached {
            envelope.traction(greatest) / greatest
        } else {
            envelope.stiffness
        };
        let mut tangent = metric * secant;
        if effective > reached {
            let bend = (envelope.slope(effective) - secant) / (effective * effective);
            tangent += weighted * weighted.transpose() * bend;
        }
        let spent = state.dissipated_fraction - old.dissipated_fraction;
        Ok(Traction {
            traction: weighted * secant,
            tangent,
            state,
            stored: 0.5 * secant * effective * effective,
            dissipated: envelope.toughness * spent,
        })
    }
}

#[cfg(test)]
mod tests;
