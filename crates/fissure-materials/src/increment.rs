//! What a law is given and what it returns.

use fissure_tensor::{Band, Matrix3, Sym};
use serde::{Deserialize, Serialize};

/// Factors on a law's parameters at one particle; 1 by default.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scale {
    /// On every stiffness.
    pub stiffness: f64,
    /// On every strength.
    pub strength: f64,
    /// On every toughness.
    pub toughness: f64,
}

impl Default for Scale {
    fn default() -> Self {
        Self {
            stiffness: 1.0,
            strength: 1.0,
            toughness: 1.0,
        }
    }
}

/// What the solver or the particle sets and the law may read. The solvers at hand set the scale;
/// one of your own gives the rest through `RunKernel::external`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct External {
    /// Temperature change from the stress-free state, K.
    pub temperature: f64,
    /// Damage from a nodal field, 0 (sound) to 1 (broken).
    pub damage: f64,
    /// Share of an explosive that a detonation front has burnt, 0 to 1 (see
    /// [`ProgramBurn`](crate::ProgramBurn)).
    pub burned: f64,
    /// Factors on the law's parameters.
    pub scale: Scale,
}

/// A step of a material point: both deformation gradients, so that small-strain, hypoelastic and
/// hyperelastic laws implement one trait.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Increment {
    /// Deformation gradient at the start of the step.
    pub f_old: Matrix3<f64>,
    /// Deformation gradient at its end.
    pub f_new: Matrix3<f64>,
    /// Length of the step, s.
    pub dt: f64,
    /// Width over which the discretisation smears a crack.
    pub band: Band,
    /// What the solver or the particle sets.
    pub external: External,
}

impl Increment {
    /// From rest to `f_new` in one second with a band of 1 m.
    pub fn to(f_new: Matrix3<f64>) -> Self {
        Self {
            f_old: Matrix3::identity(),
            f_new,
            dt: 1.0,
            band: Band::Uniform(1.0),
            external: External::default(),
        }
    }

    /// The same step to another end.
    pub fn with_end(&self, f_new: Matrix3<f64>) -> Self {
        Self { f_new, ..*self }
    }

    /// `det F` at the end.
    #[inline]
    pub fn jacobian(&self) -> f64 {
        self.f_new.determinant()
    }

    /// Small strain at the end, `sym(F) − 1`.
    #[inline]
    pub fn small_strain(&self) -> Sym {
        Sym::from_matrix(&(self.f_new - Matrix3::identity()))
    }

    /// Small strain at the start.
    #[inline]
    pub fn small_strain_old(&self) -> Sym {
        Sym::from_matrix(&(self.f_old - Matrix3::identity()))
    }

    /// Mean velocity gradient over the step, `2 (F₁ − F₀)(F₁ + F₀)⁻¹ / Δt` (midpoint rule), 1/s;
    /// `None` if the sum is singular or `Δt` is zero.
    pub fn velocity_gradient(&self) -> Option<Matrix3<f64>> {
        let inverse = (self.f_new + self.f_old).try_inverse()?;
        (self.dt != 0.0).then(|| (self.f_new - self.f_old) * inverse * (2.0 / self.dt))
    }
}

/// What a law returns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response<S> {
    /// Cauchy stress, Pa.
    pub stress: Sym,
    /// New state.
    pub state: S,
    /// Stored energy (total), J per reference m³.
    pub stored: f64,
    /// Energy dissipated in this increment, J per reference m³.
    pub dissipated: f64,
}
