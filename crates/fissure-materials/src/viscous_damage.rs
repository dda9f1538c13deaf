//! Strain-rate dependent damage of concrete [Rabczuk 2007, sec. 4.1.2, after Rabczuk and Eibl].
//!
//! Stress and damage, with the strain `E = U − 1` and the stress `T` conjugate to it:
//! `T = (1 − D) C:E`, `D = D_st − D_dyn`  (1) [eq. 35, γ = 1: its function is not published].
//! Equivalent strain, the positive root of eq. 36 (`viscous_damage/surface.rs`):
//! `κ = (b + √(b² + 4 c₁ J₂))/2`, `b = c₂ √J₂ + c₃ e_max + c₄ I₁`  (2).
//! Static damage at the largest `κ` so far:
//! `D_st = 1 − exp(−((κ − e₀)/e_d)^g_d)` above `e₀`  (3) [eq. 37].
//! Dynamic damage, what the last increments of the static damage have not yet made felt:
//! `D_dyn(t) = ∫ Ḋ_st(τ) H(t − τ) dτ`, `H(s) = exp(−(s/ϑ)^g_h)`  (4) [eqs. 38-39],
//! `ϑ = ϑ₀ k^(c_t1 ln k − c_t2)`, `k = κ̇(τ)/(1 s⁻¹)` of the time of damage  (5) [eq. 40],
//! advanced step by step in `viscous_damage/history.rs`. `H` falls from 1 to 0, so
//! `0 ≤ D_dyn ≤ D_st` and `D` never falls, whatever the rates: the dissipation `Y Ḋ`, with
//! `Y = ½ E:C:E`, is never negative  (6).
//!
//! A step: `κ` rises evenly from its value at the old end; damage grows in the part of the step
//! beyond the largest `κ`, evenly in time. The energy booked is `½ (Y_a + Y₁) ΔD`, `Y_a` at the
//! start of that part (of the step, where damage is only felt late), the work to second order  (7).
//!
//! Choices where the source is silent: the plasticity, the function γ and the equation of state of
//! its reference are not published and not here; `k` is held within `10^±12`. Without a
//! [`Relaxation`] damage is felt at once and the law is independent of the rate. The damage is
//! local: where a crack is to follow, a cohesive law has to take over, since the energy to failure
//! is per volume and no band enters.

mod history;
mod surface;

use fissure_tensor::{Matrix3, Sym, Tangent};
use serde::{Deserialize, Serialize};

pub use history::Relaxation;
pub use surface::DamageSurface;

use self::history::{Growth, History};
use crate::{
    Biot, Increment, Isotropic, Material, MaterialError, Response, Scale, check_parameter,
};

const NAME: &str = "viscous damage";

/// Parameters of the rate-dependent damage law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViscousDamage {
    /// Elastic constants and density of the sound material.
    pub elastic: Isotropic,
    /// Which strains damage, eq. 2.
    pub surface: DamageSurface,
    /// Equivalent strain at which damage starts, e₀; > 0.
    pub threshold: f64,
    /// Equivalent strain over which it grows, e_d; > 0.
    pub spread: f64,
    /// Exponent g_d; ≥ 1.
    pub exponent: f64,
    /// How damage lags behind; `None` for a law independent of the rate.
    pub relaxation: Option<Relaxation>,
}

/// History of the rate-dependent damage law. All zero until damage starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ViscousDamageState {
    /// Largest equivalent strain, once above the threshold; never falls.
    pub equivalent: f64,
    /// Static damage; never falls.
    pub static_damage: f64,
    /// Damage that acts, `D_st − D_dyn`; never falls.
    pub damage: f64,
    /// Damage that is not yet felt.
    history: History,
}

/// A strain with what it would do to the sound material.
struct Strain {
    strain: Sym,
    stress: Sym,
    equivalent: f64,
}

impl Strain {
    fn release(&self) -> f64 {
        0.5 * self.stress.dot(&self.strain)
    }
}

/// What a step came to.
struct Step {
    now: Strain,
    state: ViscousDamageState,
    /// Derivative of the damage with the equivalent strain, where it grows.
    slope: f64,
    dissipated: f64,
}

impl ViscousDamage {
    /// Damage strains of one particle: strengths over stiffness.
    fn of_particle(&self, scale: &Scale) -> Self {
        let strain = scale.strength / scale.stiffness;
        Self {
            elastic: self.elastic.scaled(scale),
            threshold: self.threshold * strain,
            spread: self.spread * strain,
            ..*self
        }
    }

    fn strain(&self, kinematics: &Biot) -> Strain {
        self.measured(kinematics.strain())
    }

    fn measured(&self, strain: Sym) -> Strain {
        Strain {
            stress: self.elastic.stress(&strain),
            equivalent: self.surface.equivalent(&strain),
            strain,
        }
    }

    /// Static damage (eq. 3) and its slope.
    fn static_damage(&self, equivalent: f64) -> (f64, f64) {
        let x = (equivalent - self.threshold) / self.spread;
        if !(x > 0.0) {
            return (0.0, 0.0);
        }
        let power = x.powf(self.exponent);
        let slope = self.exponent / self.spread * x.powf(self.exponent - 1.0) * (-power).exp();
        (-(-power).exp_m1(), slope)
    }

    fn step(
        &self,
        kinematics: &Biot,
        increment: &Increment,
        old: &ViscousDamageState,
    ) -> Result<Step, MaterialError> {
        let now = self.strain(kinematics);
        let mut step = Step {
            now,
            state: *old,
            slope: 0.0,
            dissipated: 0.0,
        };
        let onset = old.equivalent.max(self.threshold);
        let grows = step.now.equivalent > onset;
        if !grows && old.history.is_empty() {
            return Ok(step);
        }
        let before = self.strain(&Biot::new(&increment.f_old)?);
        // Where on the way damage starts to grow; 0 where it only is felt.
        let mut start = 0.0;
        let history = &mut step.state.history;
        if grows {
            let (damage, slope) = self.static_damage(step.now.equivalent);
            step.state.equivalent = step.now.equivalent;
            step.state.static_damage = damage.max(old.static_damage);
            let growth = Growth {
                damage: step.state.static_damage - old.static_damage,
                slope,
                before: before.equivalent,
                onset,
                now: step.now.equivalent,
                dt: increment.dt,
            };
            start = growth.start();
            step.slope = match &self.relaxation {
                Some(relaxation) => history.advance(relaxation, &growth),
                None => slope,
            };
        } else if let Some(relaxation) = &self.relaxation {
            history.age(relaxation, increment.dt);
        }
        let felt = match &self.relaxation {
            Some(relaxation) => step.state.static_damage - history.dynamic_damage(relaxation),
            None => step.state.static_damage,
        };
        step.state.damage = felt.max(old.damage);
        let way = step.now.strain - before.strain;
        let from = self.measured(before.strain + way * start);
        let release = 0.5 * (from.release() + step.now.release());
        step.dissipated = release * (step.state.damage - old.damage);
        Ok(step)
    }

    fn response(&self, kinematics: &Biot, step: &Step) -> Response<ViscousDamageState> {
        let left = 1.0 - step.state.damage;
        Response {
            stress: kinematics.cauchy(&(step.now.stress * left)),
            state: step.state,
            stored: left * step.now.release(),
            dissipated: step.dissipated,
        }
    }
}

impl Material for ViscousDamage {
    type State = ViscousDamageState;
    const RATE_DEPENDENT: bool = true;
    const SPARSE: bool = true;
    const STRESS_FROM_GRADIENT: bool = true;
    const NAMES: &'static [&'static str] = &["damage", "static_damage", "equivalent_strain"];

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic.check_for(NAME)?;
        self.surface.check_for(NAME)?;
        let (threshold, spread, exponent) = (self.threshold, self.spread, self.exponent);
        check_parameter(
            NAME,
            "threshold",
            threshold,
            threshold > 0.0,
            "finite and > 0",
        )?;
        check_parameter(NAME, "spread", spread, spread > 0.0, "finite and > 0")?;
        check_parameter(
            NAME,
            "exponent",
            exponent,
            exponent >= 1.0,
            "finite and >= 1",
        )?;
        self.relaxation.map_or(Ok(()), |r| r.check_for(NAME))
    }

    fn density(&self) -> f64 {
        self.elastic.density
    }

    /// That of the sound material times the longest stretch.
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &Self::State, scale: &Scale) -> f64 {
        self.elastic.scaled(scale).p_wave_speed() * Biot::longest_stretch(f)
    }

    fn has_history(&self, state: &ViscousDamageState) -> bool {
        state.equivalent != 0.0
    }

    fn update(
        &self,
        increment: &Increment,
        old: &ViscousDamageState,
    ) -> Result<Response<ViscousDamageState>, MaterialError> {
        let law = self.of_particle(&increment.external.scale);
        let kinematics = Biot::new(&increment.f_new)?;
        let step = law.step(&kinematics, increment, old)?;
        Ok(law.response(&kinematics, &step))
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &ViscousDamageState,
    ) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    /// `∂T/∂E = (1 − D) C − (C:E) ⊗ (dD/dκ ∂κ/∂E)`; not symmetric.
    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &ViscousDamageState,
    ) -> Result<(Response<ViscousDamageState>, Tangent), MaterialError> {
        let law = self.of_particle(&increment.external.scale);
        let kinematics = Biot::new(&increment.f_new)?;
        let step = law.step(&kinematics, increment, old)?;
        let left = 1.0 - step.state.damage;
        let mut modulus = law.elastic.stiffness() * left;
        if step.slope != 0.0 {
            let gradient = law.surface.gradient(&step.now.strain) * step.slope;
            modulus = modulus - Tangent::dyad(&step.now.stress, &gradient);
        }
        let biot_stress = step.now.stress * left;
        let tangent = kinematics.spatial_tangent(&biot_stress, &modulus);
        Ok((law.response(&kinematics, &step), tangent))
    }

    fn values(&self, state: &ViscousDamageState, out: &mut [f64]) {
        out[0] = state.damage;
        out[1] = state.static_damage;
        out[2] = state.equivalent;
    }
}

#[cfg(test)]
mod tests;
