//! Scalar damage along a softening curve [Nairn 2017, sec. 2.5.1].
//!
//! The document finds that the traction on a crack cannot drive isotropic damage (its eq. 42) and
//! that an invariant has to: here the largest effective principal stress, `y = σ̃₁` of `σ̃ = C:E`,
//! with `κ₀ = σ`. In uniaxial strain the band then follows the softening curve `f` as a crack does
//! (eq. 40), with the opening `w = L d ε`:
//!
//! ```text
//! κ = σ f(s) + C₁₁ w/L,  w = s G/σ                   gives s(κ)              (1)
//! 1 − d = σ f(s)/κ                                                           (2)
//! ∫ κ² dd = (2 C₁₁ G/L) (∫₀ˢ f − s f/2)              [Nairn 2017, eq. 31]    (3)
//! ```
//! (1) has one root while `L < C₁₁G/(σ² max(−f'))`.

use fissure_tensor::Sym;

use super::{DamageEvolution, Evolved, Measure};
use crate::{
    Isotropic, MaterialError, Scale, Softening, check_parameter,
    softening::{Linear, opening},
};

/// Damage driven by the largest effective principal stress, along a softening curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RankineDamage<S = Linear> {
    /// Tensile strength σ, Pa; > 0.
    pub strength: f64,
    /// Energy per crack area to failure in uniaxial strain, G, J/m²; > 0.
    pub toughness: f64,
    /// Softening curve.
    pub softening: S,
}

impl<S: Softening> DamageEvolution for RankineDamage<S> {
    const NAME: &'static str = "scalar damage";

    fn check(&self, _elastic: &Isotropic) -> Result<(), MaterialError> {
        let (strength, toughness) = (self.strength, self.toughness);
        let rule = "finite and > 0";
        check_parameter(Self::NAME, "strength", strength, strength > 0.0, rule)?;
        check_parameter(Self::NAME, "toughness", toughness, toughness > 0.0, rule)?;
        self.softening.check()
    }

    fn threshold(&self, _elastic: &Isotropic, scale: &Scale) -> f64 {
        self.strength * scale.strength
    }

    fn measure(&self, elastic: &Isotropic, strain: &Sym) -> Measure {
        let spectrum = strain.spectrum();
        let (lambda, shear) = (elastic.lambda(), elastic.shear_modulus());
        Measure {
            value: lambda * strain.trace() + 2.0 * shear * spectrum.values[0],
            gradient: Sym::IDENTITY * lambda + Sym::dyad(&spectrum.vectors[0]) * (2.0 * shear),
        }
    }

    /// `σ₁ ≤ mean + 2√(J₂/3)`.
    fn bound(&self, elastic: &Isotropic, strain: &Sym) -> f64 {
        let stress = elastic.stress(strain);
        stress.mean() + 2.0 * (stress.j2() / 3.0).sqrt()
    }

    fn band_limit(&self, elastic: &Isotropic, scale: &Scale) -> f64 {
        let strength = self.strength * scale.strength;
        elastic.p_wave_modulus() * self.toughness * scale.toughness
            / (strength * strength * self.softening.steepest())
    }

    fn evolve(&self, elastic: &Isotropic, scale: &Scale, measure: f64, width: f64) -> Evolved {
        let strength = self.strength * scale.strength;
        let toughness = self.toughness * scale.toughness;
        let modulus = elastic.p_wave_modulus();
        // Both sides of (1) over the strength: κ/σ − stiffness·s = f(s).
        let stiffness = modulus * toughness / (strength * strength * width);
        let s = if measure > strength {
            opening(&self.softening, measure / strength, stiffness, 0.0)
        } else {
            0.0
        };
        let spent = 2.0 * modulus * toughness / width * self.softening.dissipated_to_origin(s);
        if s >= self.softening.critical() {
            return Evolved {
                damage: 1.0,
                by_measure: 0.0,
                by_width: 0.0,
                spent,
            };
        }
        let (ratio, slope) = (self.softening.ratio(s), self.softening.slope(s));
        let per_opening = -strength * slope / measure;
        let steepness = stiffness + slope;
        Evolved {
            damage: (1.0 - strength * ratio / measure).max(0.0),
            by_measure: strength * ratio / (measure * measure)
                + per_opening / (strength * steepness),
            by_width: per_opening * s * stiffness / (width * steepness),
            spent,
        }
    }
}
