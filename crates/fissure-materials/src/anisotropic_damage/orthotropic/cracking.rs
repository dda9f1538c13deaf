//! What measures and contract checks see of the law.

use fissure_tensor::{Matrix3, Sym, Vector3};

use super::OrthotropicDamage;
use crate::{
    AnisotropicDamageState, Biot, Crack, Cracking, Initiation, MaterialError, Scale, Softening,
};

/// Strength, toughness and critical opening are those of the first plane.
impl<const P: usize, N: Softening, T: Softening> Cracking for OrthotropicDamage<P, N, T> {
    fn toughness(&self, scale: &Scale) -> f64 {
        self.planes[0].opening.toughness * scale.toughness
    }

    fn strength(&self, scale: &Scale) -> f64 {
        self.planes[0].opening.strength * scale.strength
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        let critical = self.planes[0].opening.softening.critical();
        critical * self.toughness(scale) / self.strength(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        let limits = (0..P).map(|index| self.limit(index, scale));
        limits.fold(f64::INFINITY, f64::min)
    }

    fn driving_stress(&self, f: &Matrix3<f64>, cauchy: &Sym) -> Result<Sym, MaterialError> {
        Ok(cauchy.rotated(&Biot::new(f)?.rotation.transpose()))
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        let considered = |index: &usize| {
            let plane = &self.planes[*index];
            plane.normal.normalize().cross(normal).norm() <= 1e-12
        };
        let index = (0..P).find(considered)?;
        Some(self.value(index, stress, scale).value)
    }

    fn associated(&self) -> bool {
        false
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.asked(stress, scale).1
    }

    fn cracks(&self, state: &AnisotropicDamageState) -> Vec<Crack> {
        if state.width == 0.0 {
            return Vec::new();
        }
        let (index, scale) = (self.index(state), Scale::default());
        let plane = self.plane_at(index, &scale);
        vec![
            self.crack_at(index, &plane, state.width, &scale)
                .described(state),
        ]
    }

    fn irreversible(&self, state: &AnisotropicDamageState) -> Vec<f64> {
        state.irreversible()
    }
}
