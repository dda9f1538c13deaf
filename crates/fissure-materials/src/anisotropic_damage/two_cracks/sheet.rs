//! The law of a sheet of fixed thickness.

use fissure_tensor::Matrix3;

use super::{TwoCrackDamage, TwoCrackState};
use crate::stress_measure::Turned;
use crate::{Biot, Increment, Material, MaterialError, Response, Scale, Softening};

/// The law of a sheet of fixed thickness, to take differences of.
pub(super) struct Sheet<N, T>(pub TwoCrackDamage<N, T>);

impl<N: Softening, T: Softening> Material for Sheet<N, T> {
    type State = TwoCrackState;
    const PLANE: bool = true;

    fn density(&self) -> f64 {
        self.0.density()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &TwoCrackState, scale: &Scale) -> f64 {
        self.0.wave_speed(f, state, scale)
    }

    fn update(
        &self,
        increment: &Increment,
        old: &TwoCrackState,
    ) -> Result<Response<TwoCrackState>, MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.0.step::<true>(&kinematics, increment, old)?;
        Ok(self.0.response::<Turned>(&kinematics, &step, old))
    }
}
