//! Mazars' scalar damage in tension, called the Lemaitre model in [Rabczuk 2007, sec. 4.1.1].
//!
//! ```text
//! y = ε̄ = √(Σ ⟨ε_i⟩²)                                       (eq. 33, 34)     (1)
//! d = 1 − (1 − A) ε₀/κ − A exp(−B (κ − ε₀)),  κ ≥ ε₀         (eq. 32)         (2)
//! ∫ κ² dd = (1 − A) ε₀ (κ − ε₀) + A (p(ε₀) − p(κ))                           (3)
//! p(κ) = exp(−B (κ − ε₀)) (κ² + 2κ/B + 2/B²)
//! ```
//! As printed the constants A and B belong to the material, and the energy dissipated per crack area
//! then is proportional to the band; with `A < 1` a stress `(1 − A) E ε₀` stays for ever. The
//! alternative gives the toughness: A = 1, and B such that uniaxial strain dissipates `G/L`,
//!
//! ```text
//! C₁₁ (ε₀²/2 + ε₀/B + 1/B²) = G/L                                            (4)
//! 1/B = √(G/(L C₁₁) − ε₀²/4) − ε₀/2,   L < 2G/(C₁₁ ε₀²)                      (5)
//! ```

use fissure_tensor::Sym;

use super::{DamageEvolution, Evolved, Measure};
use crate::{Isotropic, MaterialError, Scale, check_parameter};

/// Where A and B of Mazars' law come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MazarsSoftening {
    /// As printed, equation (2): the dissipated energy per crack area depends on the band.
    Constants {
        /// A, dimensionless; in (0, 1]. The stress that stays is `(1 − A) E ε₀`.
        a: f64,
        /// B, dimensionless; > 0.
        b: f64,
    },
    /// Energy per crack area to failure in uniaxial strain G, J/m²; > 0. A = 1, B from the band.
    Toughness(f64),
}

/// Damage driven by the norm of the tensile principal strains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MazarsDamage {
    /// Strain at which damage starts ε₀; > 0. The strength in uniaxial stress is `E ε₀`; the scale
    /// of a particle's strength multiplies that.
    pub threshold_strain: f64,
    /// Where A and B come from.
    pub softening: MazarsSoftening,
}

/// A and B over one band, with `dB/dL`.
struct Constants {
    a: f64,
    b: f64,
    b_by_width: f64,
}

impl MazarsDamage {
    fn constants(&self, elastic: &Isotropic, scale: &Scale, start: f64, width: f64) -> Constants {
        match self.softening {
            MazarsSoftening::Constants { a, b } => Constants {
                a,
                b,
                b_by_width: 0.0,
            },
            MazarsSoftening::Toughness(toughness) => {
                let density = toughness * scale.toughness / (width * elastic.p_wave_modulus());
                let root = (density - 0.25 * start * start).sqrt();
                let b = 1.0 / (root - 0.5 * start);
                Constants {
                    a: 1.0,
                    b,
                    b_by_width: b * b * density / (2.0 * width * root),
                }
            }
        }
    }
}

impl DamageEvolution for MazarsDamage {
    const NAME: &'static str = "Mazars' damage";

    fn check(&self, _elastic: &Isotropic) -> Result<(), MaterialError> {
        let start = self.threshold_strain;
        let rule = "finite and > 0";
        check_parameter(Self::NAME, "threshold_strain", start, start > 0.0, rule)?;
        match self.softening {
            MazarsSoftening::Constants { a, b } => {
                check_parameter(Self::NAME, "a", a, a > 0.0 && a <= 1.0, "in (0, 1]")?;
                check_parameter(Self::NAME, "b", b, b > 0.0, rule)
            }
            MazarsSoftening::Toughness(toughness) => {
                check_parameter(Self::NAME, "toughness", toughness, toughness > 0.0, rule)
            }
        }
    }

    fn threshold(&self, _elastic: &Isotropic, scale: &Scale) -> f64 {
        self.threshold_strain * scale.strength / scale.stiffness
    }

    fn measure(&self, _elastic: &Isotropic, strain: &Sym) -> Measure {
        let tensile = strain.positive_part();
        let value = tensile.norm();
        Measure {
            value,
            gradient: if value > 0.0 {
                tensile / value
            } else {
                Sym::ZERO
            },
        }
    }

    /// `ε̄ ≤ |E|`.
    fn bound(&self, _elastic: &Isotropic, strain: &Sym) -> f64 {
        strain.norm()
    }

    fn band_limit(&self, elastic: &Isotropic, scale: &Scale) -> f64 {
        match self.softening {
            MazarsSoftening::Constants { .. } => f64::INFINITY,
            MazarsSoftening::Toughness(toughness) => {
                let start = self.threshold(elastic, scale);
                2.0 * toughness * scale.toughness / (elastic.p_wave_modulus() * start * start)
            }
        }
    }

    fn evolve(&self, elastic: &Isotropic, scale: &Scale, measure: f64, width: f64) -> Evolved {
        let start = self.threshold(elastic, scale);
        let Constants { a, b, b_by_width } = self.constants(elastic, scale, start, width);
        let beyond = (measure - start).max(0.0);
        let decay = (-b * beyond).exp();
        let part = |kappa: f64| kappa * kappa + 2.0 * kappa / b + 2.0 / (b * b);
        // 1 − e^(−x) by expm1: a small damage keeps its relative accuracy.
        let lost = -(-b * beyond).exp_m1();
        Evolved {
            damage: ((1.0 - a) * beyond / measure + a * lost).clamp(0.0, 1.0),
            by_measure: (1.0 - a) * start / (measure * measure) + a * b * decay,
            by_width: a * decay * beyond * b_by_width,
            spent: (1.0 - a) * start * beyond + a * (part(start) - decay * part(measure)),
        }
    }
}
