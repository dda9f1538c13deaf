//! Part of the fracture energy comes back when the crack is unloaded.

use fissure_materials::{
    Band, Decohesive, DecohesiveState, Increment, Material, MaterialError, Matrix3, Response,
    Scale, Tangent,
};

/// Gives back a tenth of the energy that closing the material stores less.
pub struct NegativeDissipation(pub Decohesive);

impl Material for NegativeDissipation {
    type State = DecohesiveState;

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.0.check_band(band, scale)
    }

    fn density(&self) -> f64 {
        self.0.density()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &DecohesiveState, scale: &Scale) -> f64 {
        self.0.wave_speed(f, state, scale)
    }

    fn update(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<Response<DecohesiveState>, MaterialError> {
        let mut response = self.0.update(increment, old)?;
        let before = self.0.update(&increment.with_end(increment.f_old), old)?;
        if old.softened > 0.0 && response.dissipated == 0.0 {
            response.dissipated = 0.1 * (response.stored - before.stored).min(0.0);
        }
        Ok(response)
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<Tangent, MaterialError> {
        self.0.tangent(increment, old)
    }
}
