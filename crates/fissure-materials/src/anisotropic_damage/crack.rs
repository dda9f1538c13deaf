//! One crack of a material point through a step: softening, failure, contact, friction.

use fissure_tensor::{Sym, Vector3};
use serde::{Deserialize, Serialize};

use super::elasticity::Elastic;
use super::mixed_mode::MixedMode;
use super::mode::ModeAt;
use crate::{Crack, Softening};

/// History of the anisotropic damage law. All zero until a crack starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AnisotropicDamageState {
    /// Unit normal of the crack in the reference configuration; zero if there is none.
    pub normal: [f64; 3],
    /// Band of the crack, m; zero if there is none.
    pub width: f64,
    /// Dimensionless opening `δ_n L σ_n/𝒢_I` up to which the crack has softened; never falls.
    pub opened: f64,
    /// Dimensionless sliding `δ_t L τ_t/𝒢_II` up to which it has softened; never falls.
    pub sheared: f64,
    /// Opening now, m.
    pub opening: f64,
    /// Shear strain of the crack at which friction carries nothing; zero without friction.
    pub slip: [f64; 3],
    /// Energy per area that was left when the crack failed in mixed mode, J/m².
    pub left_over: f64,
    /// Whether the crack carries no more tension.
    pub failed: bool,
}

impl AnisotropicDamageState {
    /// Unit normal of the crack, reference axes; `None` before it starts.
    pub(super) fn started_normal(&self) -> Option<Vector3<f64>> {
        (self.width > 0.0).then(|| Vector3::from(self.normal))
    }

    /// What never falls.
    pub(super) fn irreversible(&self) -> Vec<f64> {
        vec![self.opened, self.sheared, f64::from(u8::from(self.failed))]
    }
}

/// What a strain does to a crack: the effective normal strain `ε_n` (eq. 9) and the engineering
/// shear strain `γ` in the crack's plane.
#[derive(Clone, Copy)]
pub(super) struct Demand {
    pub normal: f64,
    pub shear: Vector3<f64>,
}

impl Demand {
    pub fn new<const SHEET: bool>(
        elastic: &Elastic<SHEET>,
        normal: &Vector3<f64>,
        strain: &Sym,
    ) -> Self {
        let traction = strain.traction(normal);
        let along = normal.dot(&traction);
        Self {
            normal: elastic.normal_demand(strain, along),
            shear: (traction - normal * along) * 2.0,
        }
    }
}

/// The crack's constants at one particle.
pub(super) struct CrackAt<'a, N, T> {
    pub opening: ModeAt<'a, N>,
    pub shear: ModeAt<'a, T>,
    pub mixed: MixedMode,
    pub friction: f64,
    pub normal: Vector3<f64>,
}

/// The crack after a step.
pub(super) struct Moved {
    pub state: AnisotropicDamageState,
    /// Strain of the crack: normal, and engineering shear in its plane.
    pub normal_strain: f64,
    pub shear_strain: Vector3<f64>,
    /// The part of the shear strain that unloading does not take back: what friction holds.
    pub slipped: Vector3<f64>,
    /// J/m³.
    pub dissipated: f64,
    pub slopes: Slopes,
}

/// Derivatives of the tractions with the demand, over the virgin moduli.
#[derive(Clone, Copy, Default)]
pub(super) struct Slopes {
    pub normal: f64,
    /// Along the unit vector `direction` and across it in the crack's plane.
    pub along: f64,
    pub across: f64,
    pub direction: Vector3<f64>,
    /// Shear traction along `direction` with the normal demand, over the shear modulus (friction).
    pub pressed: f64,
    /// Changes of the tractions with the logarithm of the band, Pa.
    pub widening: [f64; 2],
}

impl<N: Softening, T: Softening> CrackAt<'_, N, T> {
    /// Moves the crack to a new demand; `old_demand` is asked for only where the step ends in
    /// failure.
    pub fn moved(
        &self,
        old: &AnisotropicDamageState,
        demand: &Demand,
        old_demand: impl Fn() -> Demand,
    ) -> Moved {
        let mut state = *old;
        let mut dissipated = 0.0;
        let (opened, sheared) = self.soften(&mut state, demand);
        if opened || sheared {
            if self.has_failed(&state) {
                dissipated += self.fail(&mut state, old, demand, &old_demand());
            }
            dissipated += self.spent(old, &state);
        }
        let (mut slopes, normal_strain) = self.normal_response(&mut state, demand, opened);
        let mut slipped = Vector3::zeros();
        let shear_strain = if self.is_free_to_slide(&state) {
            let (strain, work) = self.slide(&mut state, old, demand, &old_demand, &mut slopes);
            dissipated += work;
            slipped = strain;
            strain
        } else {
            self.shear_response(&state, demand, sheared, &mut slopes)
        };
        Moved {
            state,
            normal_strain,
            shear_strain,
            slipped,
            dissipated: dissipated.max(0.0),
            slopes,
        }
    }

    /// Softens both modes to a demand; which ones moved.
    fn soften(&self, state: &mut AnisotropicDamageState, demand: &Demand) -> (bool, bool) {
        let broken = self.is_broken(state);
        let opened = match self.opening.soften(demand.normal, state.opened) {
            Some(opened) if !broken => {
                state.opened = opened;
                true
            }
            _ => false,
        };
        let sheared = match self.shear.soften(demand.shear.norm(), state.sheared) {
            Some(sheared) if !broken => {
                state.sheared = sheared;
                true
            }
            _ => false,
        };
        if self.mixed == MixedMode::Uncoupled {
            state.failed = self.opening.is_spent(state.opened);
        }
        (opened, sheared)
    }

    /// Whether (34) has been met: neither mode carries anything.
    fn is_broken(&self, state: &AnisotropicDamageState) -> bool {
        state.failed && self.mixed != MixedMode::Uncoupled
    }

    /// The criterion (34).
    fn has_failed(&self, state: &AnisotropicDamageState) -> bool {
        let MixedMode::Coupled {
            opening_exponent,
            shear_exponent,
        } = self.mixed
        else {
            return false;
        };
        let power = |fraction: f64, exponent: f64| {
            if exponent == 1.0 {
                fraction
            } else {
                fraction.powf(exponent)
            }
        };
        let opening = self.opening.dissipated_fraction(state.opened);
        let shear = self.shear.dissipated_fraction(state.sheared);
        power(opening, opening_exponent) + power(shear, shear_exponent) >= 1.0
    }

    /// Energy dissipated from one state to another by what has softened, J/m³.
    fn spent(&self, old: &AnisotropicDamageState, new: &AnisotropicDamageState) -> f64 {
        let (mut opening, mut shear) = (0.0, 0.0);
        if new.opened > old.opened {
            opening = self.opening.dissipated_fraction(new.opened)
                - self.opening.dissipated_fraction(old.opened);
        }
        if new.sheared > old.sheared {
            shear = self.shear.dissipated_fraction(new.sheared)
                - self.shear.dissipated_fraction(old.sheared);
        }
        (opening * self.opening.toughness + shear * self.shear.toughness) / new.width
    }

    /// Fails the crack where on the straight way from the old demand to the new one (34) is met,
    /// and returns the energy it still stored there, J/m³.
    ///
    /// On that way the softening of either mode never falls (the normal demand is linear, the
    /// shear demand convex), so that the place can be bisected.
    fn fail(
        &self,
        state: &mut AnisotropicDamageState,
        old: &AnisotropicDamageState,
        to: &Demand,
        from: &Demand,
    ) -> f64 {
        let at = |part: f64| Demand {
            normal: from.normal + (to.normal - from.normal) * part,
            shear: from.shear + (to.shear - from.shear) * part,
        };
        let softened = |demand: &Demand| {
            let mut state = *old;
            state.normal = self.normal.into();
            self.soften(&mut state, demand);
            state
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.has_failed(&softened(&at(middle))) {
                high = middle;
            } else {
                low = middle;
            }
        }
        // At `part = 1` the demand can differ from `to` by round-off; then `to` is the place.
        let (mut demand, mut there) = (at(high), softened(&at(high)));
        if !self.has_failed(&there) {
            (demand, there) = (*to, *state);
        }
        state.opened = there.opened;
        state.sheared = there.sheared;
        state.failed = true;
        let normal = demand.normal.max(0.0);
        let left = 0.5
            * (self.opening.integrity(state.opened) * self.opening.modulus * normal * normal
                + self.shear.integrity(state.sheared)
                    * self.shear.modulus
                    * demand.shear.norm_squared());
        state.left_over = left * state.width;
        left
    }

    /// What measures see of the crack.
    pub fn described(&self, state: &AnisotropicDamageState) -> Crack {
        let fraction = self.opening.dissipated_fraction(state.opened)
            + self.shear.dissipated_fraction(state.sheared);
        Crack {
            normal: Vector3::from(state.normal),
            opening: state.opening,
            width: state.width,
            strength_ratio: if state.failed {
                0.0
            } else {
                self.opening.softening.ratio(state.opened)
            },
            dissipated_fraction: if state.failed { 1.0 } else { fraction.min(1.0) },
            failed: state.failed,
        }
    }

    /// `1 − d` in opening.
    pub fn opening_integrity(&self, state: &AnisotropicDamageState) -> f64 {
        if state.failed {
            0.0
        } else {
            self.opening.integrity(state.opened)
        }
    }

    /// `1 − d` in shear.
    pub fn shear_integrity(&self, state: &AnisotropicDamageState) -> f64 {
        if self.is_broken(state) {
            0.0
        } else {
            self.shear.integrity(state.sheared)
        }
    }

    /// Opening with the secant modulus; contact as if there were no crack (eq. 15).
    fn normal_response(
        &self,
        state: &mut AnisotropicDamageState,
        demand: &Demand,
        opened: bool,
    ) -> (Slopes, f64) {
        let mut slopes = Slopes {
            normal: 1.0,
            ..Slopes::default()
        };
        if !(demand.normal > 0.0) {
            state.opening = 0.0;
            return (slopes, 0.0);
        }
        let integrity = self.opening_integrity(state);
        slopes.normal = integrity;
        if opened && !state.failed {
            slopes.normal = self.opening.slope(state.opened);
            slopes.widening[0] = self.opening.widening(state.opened);
        }
        let strain = (1.0 - integrity) * demand.normal;
        state.opening = strain * state.width;
        (slopes, strain)
    }

    /// One shear damage: the crack's shear strain is along the shear demand, and so the traction,
    /// whose size is bounded by a circle.
    fn shear_response(
        &self,
        state: &AnisotropicDamageState,
        demand: &Demand,
        sheared: bool,
        slopes: &mut Slopes,
    ) -> Vector3<f64> {
        let integrity = self.shear_integrity(state);
        (slopes.along, slopes.across) = (integrity, integrity);
        if sheared && !self.is_broken(state) {
            // The demand is not zero: it has just moved the damage.
            slopes.direction = demand.shear.normalize();
            slopes.along = self.shear.slope(state.sheared);
            slopes.widening[1] = self.shear.widening(state.sheared);
        }
        demand.shear * (1.0 - integrity)
    }

    /// Whether nothing but friction holds the crack's faces from sliding.
    pub fn is_free_to_slide(&self, state: &AnisotropicDamageState) -> bool {
        self.is_broken(state) || self.shear.is_spent(state.sheared)
    }

    /// Friction between the faces of a failed crack under pressure: an elastic stick with the
    /// shear modulus of the bulk, and a radial return to `μ |T_n|`. The slip of the step works
    /// against the mean of its tractions at both ends. In the step of failure the faces are free.
    fn slide(
        &self,
        state: &mut AnisotropicDamageState,
        old: &AnisotropicDamageState,
        demand: &Demand,
        old_demand: &impl Fn() -> Demand,
        slopes: &mut Slopes,
    ) -> (Vector3<f64>, f64) {
        if self.friction == 0.0 {
            return (demand.shear, 0.0);
        }
        if !self.is_free_to_slide(old) {
            state.slip = demand.shear.into();
            return (demand.shear, 0.0);
        }
        let modulus = self.shear.modulus;
        let pressure = (-self.opening.modulus * demand.normal).max(0.0);
        let limit = self.friction * pressure / modulus;
        let slip = Vector3::from(old.slip);
        let stretch = demand.shear - slip;
        let size = stretch.norm();
        if size <= limit * (1.0 + 4.0 * f64::EPSILON) {
            (slopes.along, slopes.across) = (1.0, 1.0);
            return (slip, 0.0);
        }
        let direction = stretch / size;
        let next = demand.shear - direction * limit;
        state.slip = next.into();
        slopes.direction = direction;
        slopes.across = limit / size;
        if pressure > 0.0 {
            slopes.pressed = -self.friction * self.opening.modulus / modulus;
        }
        let old_traction = (old_demand().shear - slip) * modulus;
        let mean = (old_traction + direction * (limit * modulus)) * 0.5;
        (next, mean.dot(&(next - slip)).max(0.0))
    }
}
