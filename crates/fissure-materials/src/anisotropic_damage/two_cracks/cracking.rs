//! What measures and contract checks see of both cracks.

use fissure_tensor::{Matrix3, Sym, Vector3};

use super::{TwoCrackDamage, TwoCrackState};
use crate::{Crack, Cracking, Initiation, MaterialError, Scale, Softening};

impl<N: Softening, T: Softening> Cracking for TwoCrackDamage<N, T> {
    fn toughness(&self, scale: &Scale) -> f64 {
        self.0.toughness(scale)
    }

    fn strength(&self, scale: &Scale) -> f64 {
        self.0.strength(scale)
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.0.critical_opening(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        self.limit::<false>(scale)
    }

    fn driving_stress(&self, f: &Matrix3<f64>, cauchy: &Sym) -> Result<Sym, MaterialError> {
        self.0.driving_stress(f, cauchy)
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.0.failure_along(stress, normal, scale)
    }

    fn associated(&self) -> bool {
        self.0.associated()
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.0.initiation(stress, scale)
    }

    fn failure_in_plane(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.0.failure_in_plane(stress, normal, scale)
    }

    fn initiation_in_plane(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.0.initiation_in_plane(stress, scale)
    }

    fn cracks(&self, state: &TwoCrackState) -> Vec<Crack> {
        let mut cracks = self.0.cracks(&state.first);
        cracks.extend(self.0.cracks(&state.second));
        cracks
    }

    fn irreversible(&self, state: &TwoCrackState) -> Vec<f64> {
        let mut all = self.0.irreversible(&state.first);
        all.extend(self.0.irreversible(&state.second));
        all
    }
}
