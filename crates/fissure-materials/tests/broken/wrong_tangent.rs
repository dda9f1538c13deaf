//! The tangent is one per cent too stiff.

use fissure_materials::{
    Band, Decohesive, DecohesiveState, Increment, Material, MaterialError, Matrix3, Response,
    Scale, Tangent,
};

/// Right stress, wrong derivative.
pub struct WrongTangent(pub Decohesive);

impl Material for WrongTangent {
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
        self.0.update(increment, old)
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<Tangent, MaterialError> {
        Ok(self.0.tangent(increment, old)? * 1.01)
    }
}
