//! The elasticity that the damage acts on: of a solid, or of a sheet in plane stress.
//!
//! A crack across a sheet has no strain along z, so `T_zz = 0` can be solved for `E_zz` once and for
//! all: every equation of the law holds with the constants of the sheet,
//! `T = λ' (E_xx + E_yy) 1₂ + 2G E`, `λ' = 2λG/(λ + 2G)`, `C₁₁ = λ' + 2G = E/(1 − ν²)`.

use fissure_tensor::{Sym, Tangent};

use crate::Isotropic;

/// Elastic constants of one particle. A sheet's stress has no component along z, and its strain
/// along z counts for nothing.
#[derive(Clone, Copy)]
pub(super) struct Elastic<const SHEET: bool> {
    lambda: f64,
    shear: f64,
}

impl<const SHEET: bool> Elastic<SHEET> {
    #[inline]
    pub fn new(solid: &Isotropic) -> Self {
        let (lambda, shear) = (solid.lambda(), solid.shear_modulus());
        let relieved = 2.0 * lambda * shear / (lambda + 2.0 * shear);
        Self {
            lambda: if SHEET { relieved } else { lambda },
            shear,
        }
    }

    pub fn shear_modulus(&self) -> f64 {
        self.shear
    }

    /// `C₁₁`.
    pub fn p_wave_modulus(&self) -> f64 {
        self.lambda + 2.0 * self.shear
    }

    /// `λ/C₁₁`, by which a strain along a plane counts for the demand on it (eq. 9).
    pub fn lateral_ratio(&self) -> f64 {
        self.lambda / self.p_wave_modulus()
    }

    #[inline]
    fn trace(strain: &Sym) -> f64 {
        if SHEET {
            strain.xx() + strain.yy()
        } else {
            strain.trace()
        }
    }

    #[inline]
    pub fn stress(&self, strain: &Sym) -> Sym {
        let pressure = Sym::IDENTITY * (self.lambda * Self::trace(strain));
        let mut stress = pressure + *strain * (2.0 * self.shear);
        if SHEET {
            stress.mandel[2] = 0.0;
        }
        stress
    }

    /// The strain, with what a sound sheet has along z.
    pub fn completed(&self, strain: &Sym) -> Sym {
        let mut strain = *strain;
        if SHEET {
            strain.mandel[2] = -self.lambda / (2.0 * self.shear) * Self::trace(&strain);
        }
        strain
    }

    pub fn stiffness(&self) -> Tangent {
        let mut stiffness = Tangent::isotropic(self.lambda, self.shear);
        if SHEET {
            stiffness.0.row_mut(2).fill(0.0);
            stiffness.0.column_mut(2).fill(0.0);
        }
        stiffness
    }

    /// The effective normal strain `n·C:E·n/C₁₁` of a plane with the strain `along` its normal (eq. 9).
    pub fn normal_demand(&self, strain: &Sym, along: f64) -> f64 {
        along + self.lateral_ratio() * (Self::trace(strain) - along)
    }
}
