//! The same call gives two answers.

use std::sync::atomic::{AtomicU64, Ordering};

use fissure_materials::{
    Band, Decohesive, DecohesiveState, Increment, Material, MaterialError, Matrix3, Response,
    Scale, Tangent,
};

/// Counts its calls, and every hundredth answer is off in the last digits.
pub struct HiddenState(pub Decohesive, pub AtomicU64);

impl Material for HiddenState {
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
        if self.1.fetch_add(1, Ordering::Relaxed) % 100 == 99 {
            response.stress = response.stress * (1.0 + 1e-12);
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
