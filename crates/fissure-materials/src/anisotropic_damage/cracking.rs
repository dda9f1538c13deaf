//! What measures and contract checks see of the law.

use fissure_tensor::{Matrix3, Sym, Vector3};

use super::{AnisotropicDamage, AnisotropicDamageState};
use crate::{Biot, Crack, Cracking, Initiation, MaterialError, Scale, Softening};

impl<N: Softening, T: Softening> Cracking for AnisotropicDamage<N, T> {
    fn toughness(&self, scale: &Scale) -> f64 {
        self.opening.toughness * scale.toughness
    }

    fn strength(&self, scale: &Scale) -> f64 {
        self.opening.strength * scale.strength
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.opening.softening.critical() * self.toughness(scale) / self.strength(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        self.limit::<false>(scale)
    }

    fn driving_stress(&self, f: &Matrix3<f64>, cauchy: &Sym) -> Result<Sym, MaterialError> {
        Ok(cauchy.rotated(&Biot::new(f)?.rotation.transpose()))
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.surface::<false>(scale).value_along(stress, normal)
    }

    /// The stress `R·T·Rᵀ` has no potential at finite strain.
    fn associated(&self) -> bool {
        false
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.surface::<false>(scale).asked(stress).initiation
    }

    fn failure_in_plane(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.surface::<true>(scale).value_along(stress, normal)
    }

    fn initiation_in_plane(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.surface::<true>(scale).asked(stress).initiation
    }

    fn cracks(&self, state: &AnisotropicDamageState) -> Vec<Crack> {
        if state.width == 0.0 {
            return Vec::new();
        }
        vec![
            self.crack_at::<false>(&Scale::default(), state)
                .described(state),
        ]
    }

    fn irreversible(&self, state: &AnisotropicDamageState) -> Vec<f64> {
        state.irreversible()
    }
}
