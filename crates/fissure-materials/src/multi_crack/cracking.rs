//! What measures and contract checks see of the law.

use fissure_tensor::{Sym, Vector3};

use super::{Decohesion, MultiCrack, Plane, Planes, Rank};
use crate::{Crack, Cracking, Initiation, Scale};

impl<const N: usize, D: Decohesion> Cracking for MultiCrack<N, D> {
    fn toughness(&self, scale: &Scale) -> f64 {
        self.decohesion.scaled(scale).toughness()
    }

    fn strength(&self, scale: &Scale) -> f64 {
        self.decohesion.scaled(scale).strength()
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        let decohesion = self.decohesion.scaled(scale);
        decohesion.critical() * decohesion.toughness() / decohesion.strength()
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        let law = self.scaled(scale);
        let one = law.limit();
        match self.planes {
            Planes::Multiple(Some(angle)) => one.min(angle.sin().powi(2) / law.unique_above(1.0)),
            _ => one,
        }
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        Some(
            self.decohesion
                .scaled(scale)
                .along(stress, normal, Rank::First),
        )
    }

    fn associated(&self) -> bool {
        self.planes != Planes::Rotating && self.decohesion.associated()
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.decohesion.scaled(scale).farthest(stress)
    }

    fn failure_of(&self, stress: &Sym, crack: &Crack, scale: &Scale) -> f64 {
        let decohesion = self.decohesion.scaled(scale);
        decohesion.on_plane(stress, &crack.normal, crack.strength_ratio)
    }

    fn cracks(&self, state: &Self::State) -> Vec<Crack> {
        let crack = |plane: &Plane| Crack {
            normal: plane.normal(),
            opening: plane.opening,
            width: plane.width,
            strength_ratio: self.decohesion.ratio(plane.softened),
            dissipated_fraction: self.decohesion.dissipated_fraction(plane.softened),
            failed: plane.failed,
        };
        state.planes().iter().map(crack).collect()
    }

    fn irreversible(&self, state: &Self::State) -> Vec<f64> {
        // Of all that there is room for, so that a plane that starts makes the list no longer.
        let number = |plane: &Plane| [plane.softened, f64::from(u8::from(plane.failed))];
        state.slots().iter().flat_map(number).collect()
    }
}
