//! What measures and contract checks see of the law.

use fissure_tensor::{Matrix3, Sym, Vector3};

use super::{IncrementalDamage, IncrementalState};
use crate::{Crack, Cracking, Initiation, MaterialError, Scale, Softening};

impl<const ELLIPSE: bool, N: Softening, T: Softening> Cracking
    for IncrementalDamage<ELLIPSE, N, T>
{
    fn toughness(&self, scale: &Scale) -> f64 {
        self.parameters.toughness(scale)
    }

    fn strength(&self, scale: &Scale) -> f64 {
        self.parameters.strength(scale)
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.parameters.critical_opening(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        self.parameters.band_limit(scale)
    }

    fn driving_stress(&self, f: &Matrix3<f64>, cauchy: &Sym) -> Result<Sym, MaterialError> {
        self.parameters.driving_stress(f, cauchy)
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.parameters.failure_along(stress, normal, scale)
    }

    fn associated(&self) -> bool {
        false
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.parameters.initiation(stress, scale)
    }

    fn failure_in_plane(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.parameters.failure_in_plane(stress, normal, scale)
    }

    fn initiation_in_plane(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.parameters.initiation_in_plane(stress, scale)
    }

    fn cracks(&self, state: &IncrementalState) -> Vec<Crack> {
        if state.width == 0.0 {
            return Vec::new();
        }
        let modes = self.modes::<false>(state.width, &Scale::default());
        let [first, second] = state.sheared.map(|s| modes.shear.dissipated_fraction(s));
        let fraction = modes.opening.dissipated_fraction(state.opened) + first + second;
        vec![Crack {
            normal: Vector3::from(state.normal),
            opening: state.opening,
            width: state.width,
            strength_ratio: if state.failed {
                0.0
            } else {
                self.parameters.opening.softening.ratio(state.opened)
            },
            dissipated_fraction: if state.failed { 1.0 } else { fraction.min(1.0) },
            failed: state.failed,
        }]
    }

    fn irreversible(&self, state: &IncrementalState) -> Vec<f64> {
        let [first, second] = state.sheared;
        vec![
            state.opened,
            first,
            second,
            f64::from(u8::from(state.failed)),
        ]
    }
}
