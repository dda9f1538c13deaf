//! What measures and contract checks see of the law.

use fissure_tensor::{Sym, Vector3};

use super::{Decohesive, DecohesiveState, Normal};
use crate::{Crack, Cracking, Initiation, Scale, Softening};

impl<S: Softening> Cracking for Decohesive<S> {
    fn toughness(&self, scale: &Scale) -> f64 {
        self.toughness * scale.toughness
    }

    fn strength(&self, scale: &Scale) -> f64 {
        self.strength * scale.strength
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.softening.critical() * self.toughness(scale) / self.strength(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        self.point(scale).band_limit()
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        let (traction, normal) = match self.normal {
            Normal::Prescribed(normal) => {
                let normal = normal.normalize();
                (stress.normal_component(&normal), normal)
            }
            Normal::Rankine => {
                let spectrum = stress.spectrum();
                (spectrum.values[0], spectrum.vectors[0])
            }
        };
        Initiation {
            value: traction / self.strength(scale) - 1.0,
            normal,
        }
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        let considered = match self.normal {
            Normal::Rankine => true,
            Normal::Prescribed(only) => only.normalize().cross(normal).norm() <= 1e-12,
        };
        considered.then(|| stress.normal_component(normal) / self.strength(scale) - 1.0)
    }

    fn cracks(&self, state: &DecohesiveState) -> Vec<Crack> {
        if state.width == 0.0 {
            return Vec::new();
        }
        vec![Crack {
            normal: Vector3::from(state.normal),
            opening: state.opening,
            width: state.width,
            strength_ratio: self.softening.ratio(state.softened),
            dissipated_fraction: self.softening.area(state.softened),
            failed: state.failed,
        }]
    }

    fn irreversible(&self, state: &DecohesiveState) -> Vec<f64> {
        vec![state.softened, f64::from(u8::from(state.failed))]
    }
}
