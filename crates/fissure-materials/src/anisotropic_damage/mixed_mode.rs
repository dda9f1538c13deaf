//! When opening and sliding together have broken a crack.

use crate::{MaterialError, check_parameter};

/// When a crack that opens and shears at once has failed [Nairn 2017, eq. 34].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MixedMode {
    /// When `(G_I/𝒢_I)^m + (G_II/𝒢_II)^n` reaches 1. What the crack then still carries drops to
    /// zero; the energy is booked as dissipated.
    Coupled {
        /// Exponent m of the opening mode; > 0.
        opening_exponent: f64,
        /// Exponent n of the shear mode; > 0.
        shear_exponent: f64,
    },
    /// Each mode softens to its own end: the stress has no jump.
    Uncoupled,
}

impl MixedMode {
    pub(super) fn check(&self, law: &'static str) -> Result<(), MaterialError> {
        let Self::Coupled {
            opening_exponent,
            shear_exponent,
        } = *self
        else {
            return Ok(());
        };
        let rule = "finite and > 0";
        let (m, n) = (opening_exponent, shear_exponent);
        check_parameter(law, "mixed.opening_exponent", m, m > 0.0, rule)?;
        check_parameter(law, "mixed.shear_exponent", n, n > 0.0, rule)
    }
}

impl Default for MixedMode {
    /// Both exponents 1.
    fn default() -> Self {
        Self::Coupled {
            opening_exponent: 1.0,
            shear_exponent: 1.0,
        }
    }
}
