//! Criteria whose maximum over all directions is known from the principal stresses.
//!
//! With `τ = σ·n`, `τ_n = n·τ` and `τ_s² = |τ|² − τ_n²` [Sanchez 2010, eq. 3.5.41]:
//! - Rankine (3.5.40): `F_n = τ_n/τ_nf − 1`, largest for `n = e₁`, `F = σ₁/τ_nf − 1`.
//! - Tresca (3.5.42): `F_n = τ_s/τ_sf − 1`, largest at 45° between `e₁` and `e₃`,
//!   `F = (σ₁ − σ₃)/(2 τ_sf) − 1`.
//! - Mohr-Coulomb (3.5.43): `F_n = τ_s/τ_sf + τ_n/τ_nf − 1`. On the largest of Mohr's circles,
//!   `τ_n = c + r cos 2θ`, `τ_s = r sin 2θ` with `θ` from `e₁`, it is largest at
//!   `tan 2θ = τ_nf/τ_sf`, `F = c/τ_nf + r √(τ_nf⁻² + τ_sf⁻²) − 1`.
//! - Tension/shear [Nairn 2017, fig. 1]: whichever of `τ_n/σ_n − 1` and `τ_s/τ_t − 1` is larger;
//!   `n = e₁` in tension, at 45° in shear, in tension where both tie.
//!
//! Bounds from `m = tr σ/3` and `J₂`: `σ₁ ≤ m + 2√(J₂/3)`, `(σ₁ − σ₃)/2 ≤ √J₂`. For Mohr-Coulomb
//! both attain their extremes at different Lode angles `φ` (from pure shear), `r = √J₂ cos φ`,
//! `c = m − √(J₂/3) sin φ`, so `F ≤ m/τ_nf + √J₂ √(k² + 1/(3τ_nf²)) − 1`,
//! `k² = τ_nf⁻² + τ_sf⁻²`.

use fissure_tensor::{Spectrum, Sym, Vector3};

use super::{FailureCriterion, canonical};
use crate::tension_shear::TensionShear as Surface;
use crate::{Initiation, MaterialError, Onset, Scale, check_parameter};

/// First principal stress against a tensile strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rankine {
    /// Tensile strength τ_nf, Pa; > 0.
    pub strength: f64,
}

/// Largest shear stress against a shear strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tresca {
    /// Shear strength τ_sf, Pa; > 0.
    pub shear_strength: f64,
}

/// Shear and normal traction together, a straight line in Mohr's plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MohrCoulomb {
    /// Normal traction at failure without shear τ_nf, Pa; > 0.
    pub strength: f64,
    /// Shear traction at failure without normal traction τ_sf (the cohesion), Pa; > 0. The
    /// coefficient of friction is `τ_sf/τ_nf`.
    pub shear_strength: f64,
}

/// Tension or shear, whichever is reached first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TensionShear {
    /// Tensile strength σ_n, Pa; > 0.
    pub strength: f64,
    /// Shear strength τ_t, Pa; > 0.
    pub shear_strength: f64,
}

/// Largest first principal stress of a given mean and `J₂`, Pa.
fn largest_principal(stress: &Sym) -> f64 {
    stress.mean() + 2.0 * (stress.j2() / 3.0).sqrt()
}

fn normal_traction(stress: &Sym, normal: &Vector3<f64>) -> f64 {
    stress.normal_component(normal)
}

fn shear_traction(stress: &Sym, normal: &Vector3<f64>) -> f64 {
    let traction = stress.traction(normal);
    (traction - normal * normal.dot(&traction)).norm()
}

/// The plane at `angle` from the first principal direction towards the third.
fn between(spectrum: &Spectrum, angle: f64) -> Vector3<f64> {
    let (sine, cosine) = angle.sin_cos();
    let (first, third) = (spectrum.vectors[0] * cosine, spectrum.vectors[2] * sine);
    canonical([first + third, first - third])
}

fn at_45_degrees(spectrum: &Spectrum) -> Vector3<f64> {
    between(spectrum, std::f64::consts::FRAC_PI_4)
}

fn check_strength(criterion: &'static str, value: f64) -> Result<(), MaterialError> {
    check_parameter(criterion, "strength", value, value > 0.0, "finite and > 0")
}

fn check_shear_strength(criterion: &'static str, value: f64) -> Result<(), MaterialError> {
    let valid = value > 0.0;
    check_parameter(criterion, "shear_strength", value, valid, "finite and > 0")
}

impl FailureCriterion for Rankine {
    fn check(&self) -> Result<(), MaterialError> {
        check_strength("Rankine criterion", self.strength)
    }

    fn scaled(&self, scale: &Scale) -> Self {
        let strength = self.strength * scale.strength;
        Self { strength }
    }

    fn along(&self, stress: &Sym, normal: &Vector3<f64>) -> f64 {
        normal_traction(stress, normal) / self.strength - 1.0
    }

    #[inline]
    fn upper_bound(&self, stress: &Sym) -> f64 {
        largest_principal(stress) / self.strength - 1.0
    }

    fn initiation(&self, stress: &Sym) -> Initiation {
        let spectrum = stress.spectrum();
        Initiation {
            value: spectrum.values[0] / self.strength - 1.0,
            normal: spectrum.vectors[0],
        }
    }
}

impl FailureCriterion for Tresca {
    fn check(&self) -> Result<(), MaterialError> {
        check_shear_strength("Tresca criterion", self.shear_strength)
    }

    fn scaled(&self, scale: &Scale) -> Self {
        let shear_strength = self.shear_strength * scale.strength;
        Self { shear_strength }
    }

    fn along(&self, stress: &Sym, normal: &Vector3<f64>) -> f64 {
        shear_traction(stress, normal) / self.shear_strength - 1.0
    }

    #[inline]
    fn upper_bound(&self, stress: &Sym) -> f64 {
        stress.j2().sqrt() / self.shear_strength - 1.0
    }

    fn initiation(&self, stress: &Sym) -> Initiation {
        let spectrum = stress.spectrum();
        let largest = 0.5 * (spectrum.values[0] - spectrum.values[2]);
        Initiation {
            value: largest / self.shear_strength - 1.0,
            normal: at_45_degrees(&spectrum),
        }
    }
}

impl FailureCriterion for MohrCoulomb {
    fn check(&self) -> Result<(), MaterialError> {
        check_strength("Mohr-Coulomb criterion", self.strength)?;
        check_shear_strength("Mohr-Coulomb criterion", self.shear_strength)
    }

    fn scaled(&self, scale: &Scale) -> Self {
        Self {
            strength: self.strength * scale.strength,
            shear_strength: self.shear_strength * scale.strength,
        }
    }

    fn along(&self, stress: &Sym, normal: &Vector3<f64>) -> f64 {
        shear_traction(stress, normal) / self.shear_strength
            + normal_traction(stress, normal) / self.strength
            - 1.0
    }

    fn upper_bound(&self, stress: &Sym) -> f64 {
        let (tension, shear) = (1.0 / self.strength, 1.0 / self.shear_strength);
        let slope = (tension * tension * (4.0 / 3.0) + shear * shear).sqrt();
        stress.mean() * tension + stress.j2().sqrt() * slope - 1.0
    }

    fn initiation(&self, stress: &Sym) -> Initiation {
        let spectrum = stress.spectrum();
        let [first, _, third] = spectrum.values;
        let (centre, radius) = (0.5 * (first + third), 0.5 * (first - third));
        let (tension, shear) = (1.0 / self.strength, 1.0 / self.shear_strength);
        let angle = 0.5 * shear.atan2(tension);
        Initiation {
            value: centre * tension + radius * tension.hypot(shear) - 1.0,
            normal: between(&spectrum, angle),
        }
    }
}

impl FailureCriterion for TensionShear {
    fn check(&self) -> Result<(), MaterialError> {
        check_strength("tension/shear criterion", self.strength)?;
        check_shear_strength("tension/shear criterion", self.shear_strength)
    }

    fn scaled(&self, scale: &Scale) -> Self {
        Self {
            strength: self.strength * scale.strength,
            shear_strength: self.shear_strength * scale.strength,
        }
    }

    fn along(&self, stress: &Sym, normal: &Vector3<f64>) -> f64 {
        self.surface().along(stress, normal)
    }

    #[inline]
    fn upper_bound(&self, stress: &Sym) -> f64 {
        let tension = largest_principal(stress) / self.strength;
        tension.max(stress.j2().sqrt() / self.shear_strength) - 1.0
    }

    fn initiation(&self, stress: &Sym) -> Initiation {
        self.surface().asked(stress).initiation
    }
}

impl TensionShear {
    fn surface(&self) -> Surface {
        Surface {
            onset: Onset::TensionShear,
            tensile: self.strength,
            shear: self.shear_strength,
        }
    }
}
