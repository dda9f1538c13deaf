//! A plane that flows, as a function of its opening.

use super::GeologicalFlow;
use crate::crossing::crossing;
use crate::{
    Softening,
    criteria::{OnPlane, Partials},
};

/// A plane with its shear direction, seen as a function of the opening.
pub(super) struct Opening<'a, S> {
    pub(super) law: &'a GeologicalFlow<S>,
    pub(super) rest: OnPlane,
    pub(super) old_opening: f64,
    /// Shear traction if nothing slid, Pa.
    pub(super) shear: f64,
    pub(super) normal_stiffness: f64,
    pub(super) lateral_stiffness: f64,
    pub(super) shear_stiffness: f64,
}

impl<S: Softening> Opening<'_, S> {
    pub(super) fn on_plane(&self, opening: f64) -> OnPlane {
        let lateral = self.lateral_stiffness * opening;
        OnPlane {
            normal: self.rest.normal - self.normal_stiffness * opening,
            shear_squared: 0.0,
            lateral_sum: self.rest.lateral_sum - 2.0 * lateral,
            lateral_determinant: self.rest.lateral_determinant - lateral * self.rest.lateral_sum
                + lateral * lateral,
        }
    }

    /// The share `κ` of the shear traction that an opening leaves, and `∂F/∂τ_n` and `−F_n` without shear.
    pub(super) fn share(&self, opening: f64) -> (f64, Partials) {
        let (law, plane) = (self.law, self.on_plane(opening));
        let partials = law.surface.flow_partials(&plane, law.left(opening));
        let push = partials.normal.max(0.0);
        let given = self.given_way(opening);
        // A plane that does not give way at all holds no shear either: `F_n` alone decides.
        let share = if push > 0.0 {
            push / (push + given)
        } else {
            0.0
        };
        (share, partials)
    }

    /// `2 (μ/L) Δu_n/τ_sf²`, 1/Pa.
    fn given_way(&self, opening: f64) -> f64 {
        let strength = self.law.surface.shear_strength;
        2.0 * self.shear_stiffness * (opening - self.old_opening) / (strength * strength)
    }

    /// `−F_n`: negative where more opening is needed.
    fn excess(&self, opening: f64) -> f64 {
        let (share, partials) = self.share(opening);
        let shear = share * self.shear / self.law.surface.shear_strength;
        -partials.value - shear * shear
    }

    /// The share of the shear traction that is kept at the end of the step, and the rest of [`share`](Self::share). Where
    /// the plane opens by next to nothing, as under strong pressure, the opening does not resolve it; there it follows from
    /// `F_n = 0`, which elsewhere loses it where it is small.
    pub(super) fn kept(&self, opening: f64) -> (f64, Partials) {
        let (share, partials) = self.share(opening);
        let capacity = -partials.value;
        if capacity * opening > opening - self.old_opening && self.shear > 0.0 {
            let surface = self.law.surface.shear_strength * capacity.sqrt();
            return (surface.min(self.shear) / self.shear, partials);
        }
        (share, partials)
    }

    /// The shear traction on the surface at the old opening, Pa.
    pub(super) fn shear_at_start(&self) -> f64 {
        let (_, partials) = self.share(self.old_opening);
        let capacity = (-partials.value).max(0.0);
        (self.law.surface.shear_strength * capacity.sqrt()).min(self.shear)
    }

    /// The opening at the end of the step; `None` if it is beyond the critical one.
    pub(super) fn solve(&self) -> Option<f64> {
        let critical = self.law.softening.critical() * self.law.length();
        let low = self.old_opening;
        let mut high = critical;
        if !critical.is_finite() {
            let free = (self.rest.normal / self.normal_stiffness).max(0.0);
            high = low.max(free) + self.law.length();
            for _ in 0..60 {
                if self.excess(high) >= 0.0 {
                    break;
                }
                high *= 2.0;
            }
        }
        // NaN fails the comparison: the plane fails, and the stress is refused as not finite.
        let values = [self.excess(low), self.excess(high)];
        if !(values[1] >= 0.0) {
            return None;
        }
        Some(crossing([low, high], values, |opening| self.excess(opening))[1])
    }
}
