//! The small strain of F in a law that claims to be objective.

use fissure_materials::{
    Band, Decohesive, DecohesiveState, Increment, Material, MaterialError, Matrix3, Response, Scale,
};

/// Drops the rotation that it should have taken out.
pub struct NotObjective(pub Decohesive);

impl NotObjective {
    fn small(increment: &Increment) -> Increment {
        let strain = increment.small_strain().to_matrix();
        increment.with_end(Matrix3::identity() + strain)
    }
}

impl Material for NotObjective {
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
        // Refuses what every law has to refuse, so that only the rotation is wrong.
        self.0.update(increment, old)?;
        self.0.update(&Self::small(increment), old)
    }
}
