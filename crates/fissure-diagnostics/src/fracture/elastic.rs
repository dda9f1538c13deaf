//! Elastic constants of a plane body.

use fissure_tensor::Sym;

use crate::MeasureError;
use crate::error::check_positive;

/// Isotropic elastic constants and the state of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneElastic {
    /// Young's modulus E, Pa.
    pub young: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
    /// Plane stress; plane strain if not.
    pub plane_stress: bool,
}

impl PlaneElastic {
    /// Refuses constants outside their range.
    ///
    /// # Errors
    /// [`MeasureError::Parameter`].
    pub fn check(&self) -> Result<(), MeasureError> {
        check_positive("Young's modulus", self.young)?;
        if self.poisson > -1.0 && self.poisson < 0.5 {
            return Ok(());
        }
        Err(MeasureError::Parameter {
            parameter: "Poisson's ratio",
            value: self.poisson,
            permitted: "in (-1, 0.5)",
        })
    }

    /// E′: E in plane stress, E/(1 − ν²) in plane strain, Pa.
    pub fn effective_modulus(&self) -> f64 {
        if self.plane_stress {
            self.young
        } else {
            self.young / (1.0 - self.poisson * self.poisson)
        }
    }

    /// Shear modulus μ, Pa.
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.young / (1.0 + self.poisson)
    }

    /// Kolosov's κ: (3 − ν)/(1 + ν) in plane stress, 3 − 4ν in plane strain.
    pub fn kolosov(&self) -> f64 {
        if self.plane_stress {
            (3.0 - self.poisson) / (1.0 + self.poisson)
        } else {
            3.0 - 4.0 * self.poisson
        }
    }

    /// Energy per volume that a stress has stored, J/m³: `((1 + ν) σ:σ − ν (tr σ)²)/(2E)`.
    pub fn stored_energy(&self, stress: &Sym) -> f64 {
        let trace = stress.trace();
        ((1.0 + self.poisson) * stress.dot(stress) - self.poisson * trace * trace)
            / (2.0 * self.young)
    }

    /// Energy release rate of stress intensities (Pa √m), J/m²: `(K_I² + K_II²)/E′` (Irwin).
    pub fn energy_release(&self, k1: f64, k2: f64) -> f64 {
        (k1 * k1 + k2 * k2) / self.effective_modulus()
    }
}
