//! J2 (von Mises) plasticity with isotropic hardening at finite strain (Simo 1992; Simo and
//! Hughes 1998, ch. 9).
//!
//! Multiplicative split `F = Fᵉ·Fᵖ`, `det Fᵖ = 1`, Hencky elasticity in the elastic part:
//! `bᵉ = F·Cᵖ⁻¹·Fᵀ` with `Cᵖ = FᵖᵀFᵖ`, `h = ½ ln bᵉ`, `τ = K ln J 1 + 2μ dev h`  (1),
//! yield `q = √(3/2) |dev τ| ≤ σ(α)`  (2),
//! associated flow `−½ (L_v bᵉ)·bᵉ⁻¹ = α̇ √(3/2) n`, `n = dev τ/|dev τ|`  (3).
//!
//! The exponential map makes a step of (3) the radial return of small strain in the logarithmic
//! strain, on the axes of the trial `bᵉ` (plastic deformation held):
//! `q_trial − 3μ Δα = σ(α + Δα)`, `dev h = s dev h_trial`, `s = 1 − 3μ Δα/q_trial`  (4),
//! and keeps `det Cᵖ = 1`. `Cᵖ` lives in the reference configuration, so a rotation leaves the
//! state alone. `Cᵖ⁻¹ − 1` is stored, which keeps the smallest plastic strains exact.
//!
//! Free energy `ψ = K/2 (ln J)² + μ dev h : dev h + ∫₀^α (σ − σ(0))`: what hardening raises the
//! yield stress by is stored, and the dissipation is `σ(0) Δα ≥ 0`  (5). A step of (4) books both
//! exactly; the work of the stress along it is theirs to second order in the step, and exactly
//! where the strain keeps its direction.
//!
//! Tangent, in `logarithmic.rs`, with `n` on the principal axes and `H` the slope of `σ`:
//! `∂τ_i/∂h_j = K − 2μs/3 + 2μs δ_ij − 2μ (3μ/(3μ + H) − (1 − s)) n_i n_j`, shear modulus `μs`  (6).

use fissure_tensor::{Matrix3, Sym, Tangent};
use serde::{Deserialize, Serialize};

use crate::finite_strain::LeftStrain;
use crate::hardening::Hardening;
use crate::logarithmic::LogStrain;
use crate::{Increment, Isotropic, Material, MaterialError, Response, Scale};

const NAME: &str = "J2 plasticity";
const ITERATIONS: usize = 100;

/// Parameters of J2 plasticity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct J2<H> {
    /// Elastic constants and density.
    pub elastic: Isotropic,
    /// Yield stress over equivalent plastic strain.
    pub hardening: H,
}

/// History of J2 plasticity. All zero until the material yields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct J2State {
    /// `Cᵖ⁻¹ − 1`, in the reference configuration.
    pub plastic: Sym,
    /// Equivalent plastic strain α; never falls.
    pub equivalent: f64,
}

/// What a step came to.
struct Step {
    /// Trial elastic strain.
    trial: LogStrain,
    /// Kirchhoff stress on the axes of the trial strain, Pa.
    kirchhoff: [f64; 3],
    /// Share `s` of the trial deviator that is left, and the change of α with the trial q where
    /// the material flowed.
    left: f64,
    flowing: Option<f64>,
    state: J2State,
}

impl<H: Hardening> J2<H> {
    fn trial(&self, f: &Matrix3<f64>, old: &J2State) -> Result<LogStrain, MaterialError> {
        let left = LeftStrain::new(f)?;
        // F·Cᵖ⁻¹·Fᵀ − 1 as a sum of terms that are small with the strain.
        let excess = left.excess + old.plastic.congruence(f);
        LogStrain::new(&excess, left.dilation, NAME)
    }

    fn step(
        &self,
        elastic: &Isotropic,
        strength: f64,
        f: &Matrix3<f64>,
        old: &J2State,
    ) -> Result<Step, MaterialError> {
        let trial = self.trial(f, old)?;
        let shear = elastic.shear_modulus();
        let deviator = trial.deviator();
        let norm = deviator.iter().map(|d| d * d).sum::<f64>().sqrt();
        let mises = 6.0_f64.sqrt() * shear * norm;
        let limit = strength * self.hardening.stress(old.equivalent);
        let mut step = Step {
            kirchhoff: [0.0; 3],
            left: 1.0,
            flowing: None,
            state: *old,
            trial,
        };
        // Written so that a yield stress that is not a number is an error and not elastic.
        if !(mises <= limit + slack(&step.trial, f, old, shear, limit)) {
            let flow = self.flow(mises, 3.0 * shear, strength, old.equivalent)?;
            step.left = 1.0 - 3.0 * shear * flow / mises;
            step.state.equivalent += flow;
            let slope = strength * self.hardening.slope(step.state.equivalent);
            step.flowing = Some(1.0 / (3.0 * shear + slope));
            step.state.plastic += relaxed(&step.trial, &deviator, step.left, f);
        }
        let pressure = elastic.bulk_modulus() * step.trial.log_jacobian;
        step.kirchhoff = deviator.map(|d| pressure + 2.0 * shear * step.left * d);
        Ok(step)
    }

    /// `Δα` of eq. 4: the yield stress does not fall faster than `3μ`, so the root is unique; Newton's
    /// method inside a shrinking bracket takes one step where it is a straight line.
    fn flow(
        &self,
        mises: f64,
        stiffness: f64,
        strength: f64,
        equivalent: f64,
    ) -> Result<f64, MaterialError> {
        let limit = |flow: f64| strength * self.hardening.stress(equivalent + flow);
        // A falling yield stress is still positive.
        let (mut low, mut high) = (0.0, mises / stiffness);
        let (mut flow, mut excess) = (0.0, f64::NAN);
        for _ in 0..ITERATIONS {
            excess = mises - stiffness * flow - limit(flow);
            if excess > 0.0 {
                low = flow;
            } else {
                high = flow;
            }
            let slope = strength * self.hardening.slope(equivalent + flow);
            let newton = flow + excess / (stiffness + slope);
            let next = if newton >= low && newton <= high {
                newton
            } else {
                0.5 * (low + high)
            };
            // To round-off of the flow, or of the stresses whose difference gives it.
            let round_off = next.max(mises / stiffness);
            if (next - flow).abs() <= 2.0 * f64::EPSILON * round_off {
                return Ok(next);
            }
            flow = next;
        }
        Err(MaterialError::NoConvergence {
            law: NAME,
            iterations: ITERATIONS,
            residual: excess / mises,
        })
    }

    fn response(
        &self,
        elastic: &Isotropic,
        strength: f64,
        step: &Step,
        old: &J2State,
    ) -> Result<Response<J2State>, MaterialError> {
        let stress = step.trial.cauchy(&step.kirchhoff);
        let log = step.trial.log_jacobian;
        let deviator = step.trial.deviator();
        let distortion = deviator.iter().map(|d| d * d).sum::<f64>() * step.left * step.left;
        let initial = self.hardening.stress(0.0);
        let equivalent = step.state.equivalent;
        let hardening = strength * (self.hardening.work(equivalent) - initial * equivalent);
        let response = Response {
            stress,
            state: step.state,
            stored: 0.5 * elastic.bulk_modulus() * log * log
                + elastic.shear_modulus() * distortion
                + hardening,
            dissipated: strength * initial * (equivalent - old.equivalent),
        };
        if stress.is_finite() && response.stored.is_finite() && step.state.plastic.is_finite() {
            Ok(response)
        } else {
            Err(MaterialError::NotFinite { law: NAME })
        }
    }

    fn tangent_of(&self, elastic: &Isotropic, step: &Step) -> Tangent {
        let shear = elastic.shear_modulus();
        let (left, bulk) = (step.left, elastic.bulk_modulus());
        let deviator = step.trial.deviator();
        let norm = deviator.iter().map(|d| d * d).sum::<f64>().sqrt();
        let radial = step.flowing.map_or(0.0, |rate| {
            2.0 * shear * (3.0 * shear * rate - (1.0 - left)) / (norm * norm)
        });
        let reduced = 2.0 * shear * left;
        step.trial
            .spatial_tangent(&step.kirchhoff, shear * left, |i, j| {
                let diagonal = if i == j { reduced } else { 0.0 };
                bulk - reduced / 3.0 + diagonal - radial * deviator[i] * deviator[j]
            })
    }
}

/// Stress below which an overshoot of the yield stress is round-off, Pa: that of `bᵉ`, relative to
/// its smallest principal value. It keeps a zero increment from moving the state.
fn slack(trial: &LogStrain, f: &Matrix3<f64>, old: &J2State, shear: f64, limit: f64) -> f64 {
    let smallest = trial.values.iter().copied().fold(f64::INFINITY, f64::min);
    let condition = f.norm_squared() * (1.0 + old.plastic.norm()) * (-2.0 * smallest).exp();
    64.0 * f64::EPSILON * (shear * condition + limit)
}

/// Change of `Cᵖ⁻¹` as the elastic deviator shrinks to its share `left`:
/// `F⁻¹·(bᵉ − bᵉ_trial)·F⁻ᵀ` with `bᵉ = exp 2h`. The volume of `bᵉ` is set to that of `F`, so that
/// round-off does not add up in `det Cᵖ`.
fn relaxed(trial: &LogStrain, deviator: &[f64; 3], left: f64, f: &Matrix3<f64>) -> Sym {
    // Not reached without an inverse: the trial strain refused a singular gradient.
    let inverse = f.try_inverse().unwrap_or_else(Matrix3::zeros);
    let change: Sym = (0..3)
        .map(|i| {
            let target = trial.log_jacobian / 3.0 + left * deviator[i];
            let change = (2.0 * (target - trial.values[i])).exp_m1();
            Sym::dyad(&trial.axes[i]) * ((2.0 * trial.values[i]).exp() * change)
        })
        .sum();
    change.congruence(&inverse)
}

impl<H: Hardening> Material for J2<H> {
    type State = J2State;
    const NAMES: &'static [&'static str] = &["equivalent_plastic_strain"];
    const STEP_ERROR: f64 = 0.05;
    const STEP_ERROR_IN_PLANE_STRESS: f64 = 0.08;

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic.check_for(NAME)?;
        self.hardening.check()
    }

    fn density(&self) -> f64 {
        self.elastic.density
    }

    /// Of the elastic waves, which plastic flow only slows down, along the principal axes of the
    /// elastic strain in the current configuration; never below the speed at rest.
    fn wave_speed(&self, f: &Matrix3<f64>, state: &J2State, scale: &Scale) -> f64 {
        let elastic = self.elastic.scaled(scale);
        let rest = elastic.p_wave_modulus();
        let modulus = self.trial(f, state).map_or(rest, |strain| {
            let pressure = elastic.bulk_modulus() * strain.log_jacobian;
            let shear = elastic.shear_modulus();
            let kirchhoff = strain.deviator().map(|d| pressure + 2.0 * shear * d);
            strain.wave_modulus(&elastic, &kirchhoff)
        });
        (modulus.max(rest) / elastic.density).sqrt()
    }

    fn update(
        &self,
        increment: &Increment,
        old: &J2State,
    ) -> Result<Response<J2State>, MaterialError> {
        let scale = &increment.external.scale;
        let elastic = self.elastic.scaled(scale);
        let step = self.step(&elastic, scale.strength, &increment.f_new, old)?;
        self.response(&elastic, scale.strength, &step, old)
    }

    fn tangent(&self, increment: &Increment, old: &J2State) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &J2State,
    ) -> Result<(Response<J2State>, Tangent), MaterialError> {
        let scale = &increment.external.scale;
        let elastic = self.elastic.scaled(scale);
        let step = self.step(&elastic, scale.strength, &increment.f_new, old)?;
        let response = self.response(&elastic, scale.strength, &step, old)?;
        Ok((response, self.tangent_of(&elastic, &step)))
    }

    fn values(&self, state: &J2State, out: &mut [f64]) {
        out[0] = state.equivalent;
    }
}

#[cfg(test)]
mod tests;
