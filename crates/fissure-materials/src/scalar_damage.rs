//! Isotropic damage with one scalar [Nairn 2017, sec. 2.5.1; Rabczuk 2007, eq. 31].
//!
//! ```text
//! T = (1 − d) C:E                                     E = U − 1, T conjugate (1)
//! κ = max over the past of a measure y(E)                                    (2)
//! d = d(κ), 0 while κ ≤ κ₀, never falling                                    (3)
//! dΩ = ψ₀ dd,  ψ₀ = ½ E:C:E                      [Nairn 2017, eq. 43]        (4)
//! ∂T/∂E = (1 − d) C − d'(κ) (C:E) ⊗ ∂y/∂E         while κ grows             (5)
//! ```
//! What y and d are is the [`DamageEvolution`]: [`RankineDamage`] follows a softening curve with the
//! largest effective principal stress, [`MazarsDamage`] the norm of the tensile principal strains.
//!
//! Over a step (4) is integrated with `ψ₀ = α + γ y²`, fitted to where the damage starts to grow and
//! to the end of the step; `∫ dd` and `∫ y² dd` are in closed form. On a proportional path from
//! rest `α = 0`, and the energy is exact for steps of any size.
//!
//! The band is that across the first principal direction where the damage starts; it makes the
//! energy per crack area the toughness in uniaxial strain, which is how a band localises. In uniaxial
//! stress it is `C₁₁/E` times as much, since the same `d` also takes the stress along the band.
//!
//! This is a comparison, not a crack: all strains are affected, in all directions and in
//! compression too, so the inelastic strain has components that no crack has (P14), a closed crack
//! does not bear (P15), and [`Cracking`](crate::Cracking) does not apply.

mod mazars;
mod rankine;
#[cfg(test)]
mod tests;

use std::fmt::Debug;

use fissure_tensor::{Band, Matrix3, Sym, Tangent};
use serde::{Deserialize, Serialize};

use crate::{
    Biot, Extrapolated, Increment, Isotropic, Material, MaterialError, Response, Scale,
    error::{check_below, check_scaled_toughness},
    turning::Turning,
};

pub use mazars::{MazarsDamage, MazarsSoftening};
pub use rankine::RankineDamage;

/// What makes a scalar damage grow, and how fast.
pub trait DamageEvolution: Copy + Debug + Send + Sync + 'static {
    /// The law's name, for messages.
    const NAME: &'static str;

    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`].
    fn check(&self, elastic: &Isotropic) -> Result<(), MaterialError>;

    /// Measure at which damage starts, κ₀; > 0. `elastic` is scaled already, here and below.
    fn threshold(&self, elastic: &Isotropic, scale: &Scale) -> f64;

    /// The measure y of a strain; homogeneous of degree one and convex.
    fn measure(&self, elastic: &Isotropic, strain: &Sym) -> Measure;

    /// A cheap upper bound of the measure, which spares most states a spectrum.
    fn bound(&self, _elastic: &Isotropic, _strain: &Sym) -> f64 {
        f64::INFINITY
    }

    /// Widest band with a unique response, m; infinite if any does.
    fn band_limit(&self, elastic: &Isotropic, scale: &Scale) -> f64;

    /// The damage at the largest measure met so far, over a band of `width` m.
    fn evolve(&self, elastic: &Isotropic, scale: &Scale, measure: f64, width: f64) -> Evolved;
}

/// A measure of strain and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// y.
    pub value: f64,
    /// `∂y/∂E`.
    pub gradient: Sym,
}

/// Damage as a function of the measure and the band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evolved {
    /// d; in [0, 1].
    pub damage: f64,
    /// `∂d/∂κ`.
    pub by_measure: f64,
    /// `∂d/∂L`, 1/m.
    pub by_width: f64,
    /// `∫ κ² dd` from the threshold on.
    pub spent: f64,
}

/// Parameters of a law with scalar damage.
///
/// ```
/// use fissure_materials::{
///     Isotropic, Material, MazarsDamage, MazarsSoftening, ScalarDamage, RankineDamage, contract,
/// };
/// let elastic = Isotropic { density: 2450.0, young: 32e9, poisson: 0.2 };
/// // Rabczuk 2007, eq. 32, with the constants of its reference [36].
/// let printed = ScalarDamage {
///     elastic,
///     evolution: MazarsDamage {
///         threshold_strain: 8.5e-5,
///         softening: MazarsSoftening::Constants { a: 1.0, b: 7300.0 },
///     },
/// };
/// // The same with a toughness, so that the band does not matter.
/// let regularised = ScalarDamage {
///     evolution: MazarsDamage {
///         softening: MazarsSoftening::Toughness(100.0),
///         ..printed.evolution
///     },
///     ..printed
/// };
/// assert!(printed.check().is_ok() && regularised.check().is_ok());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalarDamage<E = RankineDamage> {
    /// Elastic constants and density.
    pub elastic: Isotropic,
    /// What makes the damage grow.
    pub evolution: E,
}

/// History of scalar damage. All zero until it starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ScalarDamageState {
    /// Largest measure met, κ; never falls.
    pub largest: f64,
    /// Damage d; never falls.
    pub damage: f64,
    /// Band, m.
    pub width: f64,
}

/// What a step came to.
struct Step {
    strain: Sym,
    /// `C:E`.
    effective: Sym,
    state: ScalarDamageState,
    /// The measure's derivative and the damage, if it grew.
    moving: Option<(Sym, Evolved)>,
    started: bool,
}

impl<E: DamageEvolution> ScalarDamage<E> {
    /// Widest band with a unique response, m; infinite if any does.
    pub fn band_limit(&self, scale: &Scale) -> f64 {
        self.evolution
            .band_limit(&self.elastic.scaled(scale), scale)
    }

    fn check_width(&self, width: f64, scale: &Scale) -> Result<(), MaterialError> {
        // Infinite for an evolution without a toughness, with which the scale has nothing to do.
        check_scaled_toughness(E::NAME, scale.toughness)?;
        check_below(E::NAME, width, self.band_limit(scale))
    }

    fn step(
        &self,
        kinematics: &Biot,
        increment: &Increment,
        old: &ScalarDamageState,
    ) -> Result<Step, MaterialError> {
        let scale = &increment.external.scale;
        let elastic = self.elastic.scaled(scale);
        let strain = kinematics.strain();
        let mut step = Step {
            strain,
            effective: elastic.stress(&strain),
            state: *old,
            moving: None,
            started: false,
        };
        let reached = old.largest.max(self.evolution.threshold(&elastic, scale));
        if self.evolution.bound(&elastic, &strain) <= reached {
            return Ok(step);
        }
        let measure = self.evolution.measure(&elastic, &strain);
        if measure.value <= reached {
            return Ok(step);
        }
        if old.width == 0.0 {
            let normal = strain.spectrum().vectors[0];
            step.state.width = increment.band.width(&(kinematics.rotation * normal));
            self.check_width(step.state.width, scale)?;
            step.started = true;
        }
        let width = step.state.width;
        let evolved = self.evolution.evolve(&elastic, scale, measure.value, width);
        step.state.largest = measure.value;
        step.state.damage = old.damage.max(evolved.damage);
        step.moving = Some((measure.gradient, evolved));
        Ok(step)
    }

    /// Energy dissipated in a step, equation (4), J/m³.
    fn dissipated(
        &self,
        step: &Step,
        increment: &Increment,
        old: &ScalarDamageState,
    ) -> Result<f64, MaterialError> {
        let Some((_, evolved)) = step.moving else {
            return Ok(0.0);
        };
        let scale = &increment.external.scale;
        let elastic = self.elastic.scaled(scale);
        let before = old.largest.max(self.evolution.threshold(&elastic, scale));
        let start = self
            .evolution
            .evolve(&elastic, scale, before, step.state.width);
        let from = Biot::new(&increment.f_old)?.strain();
        let onset = self.onset(&elastic, &from, &step.strain, before);
        let energy = |strain: &Sym| 0.5 * elastic.stress(strain).dot(strain);
        let (first, last) = (energy(&onset), energy(&step.strain));
        let growth = (evolved.damage - start.damage).max(0.0);
        // ∫ (κ² − κ_a²)/(κ_b² − κ_a²) dd, which lies between 0 and the growth.
        let (low, high) = (before * before, step.state.largest * step.state.largest);
        let share = (evolved.spent - start.spent - low * growth) / (high - low);
        let dissipated = first * growth + (last - first) * share.clamp(0.0, growth);
        // In units in which the square of a stress is zero or infinite.
        if dissipated.is_finite() {
            Ok(dissipated)
        } else {
            Err(MaterialError::NotFinite { law: E::NAME })
        }
    }

    /// Where a straight step to `to` comes to the measure `level`, which its end exceeds.
    ///
    /// Newton's method from the end: the measure is convex along the step, so it comes down to the
    /// crossing monotonically.
    fn onset(&self, elastic: &Isotropic, from: &Sym, to: &Sym, level: f64) -> Sym {
        let step = *to - *from;
        let mut left = 1.0;
        for _ in 0..50 {
            let strain = *from + step * left;
            let measure = self.evolution.measure(elastic, &strain);
            let change = (measure.value - level) / measure.gradient.dot(&step);
            if !(change > 1e-12 && left > 0.0) {
                break;
            }
            left = (left - change).max(0.0);
        }
        *from + step * left
    }

    fn response(
        &self,
        kinematics: &Biot,
        step: &Step,
        increment: &Increment,
        old: &ScalarDamageState,
    ) -> Result<Response<ScalarDamageState>, MaterialError> {
        let left = 1.0 - step.state.damage;
        Ok(Response {
            stress: kinematics.cauchy(&(step.effective * left)),
            state: step.state,
            stored: 0.5 * left * step.effective.dot(&step.strain),
            dissipated: self.dissipated(step, increment, old)?,
        })
    }
}

impl<E: DamageEvolution> Material for ScalarDamage<E> {
    type State = ScalarDamageState;
    const SPARSE: bool = true;
    const STRESS_FROM_GRADIENT: bool = true;
    const NAMES: &'static [&'static str] = &["damage", "largest"];
    const STEP_ERROR: f64 = 0.0;

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic.check_for(E::NAME)?;
        self.evolution.check(&self.elastic)
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.check_width(band.max_width(), scale)
    }

    fn started_width(&self, old: &ScalarDamageState, new: &ScalarDamageState) -> f64 {
        if old.width == 0.0 { new.width } else { 0.0 }
    }

    fn density(&self) -> f64 {
        self.elastic.density
    }

    /// That of the sound material times the longest stretch, as for every law on the Biot strain.
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &ScalarDamageState, scale: &Scale) -> f64 {
        self.elastic.scaled(scale).p_wave_speed() * Biot::longest_stretch(f)
    }

    fn has_history(&self, state: &ScalarDamageState) -> bool {
        state.width != 0.0
    }

    fn update(
        &self,
        increment: &Increment,
        old: &ScalarDamageState,
    ) -> Result<Response<ScalarDamageState>, MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step(&kinematics, increment, old)?;
        self.response(&kinematics, &step, increment, old)
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &ScalarDamageState,
    ) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    /// The tangent is analytic, equation (5); in the step in which the damage starts it has one term
    /// more, for the band that turns with the principal direction.
    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &ScalarDamageState,
    ) -> Result<(Response<ScalarDamageState>, Tangent), MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step(&kinematics, increment, old)?;
        let left = 1.0 - step.state.damage;
        let mut modulus = self.elastic.scaled(&increment.external.scale).stiffness() * left;
        let mut widening = Tangent::zero();
        if let Some((gradient, evolved)) = &step.moving {
            modulus = modulus - Tangent::dyad(&step.effective, gradient) * evolved.by_measure;
            if step.started {
                let normal = step.strain.spectrum().vectors[0];
                let turning = Turning::principal(&step.strain, &normal);
                widening = kinematics.spatial_rate(&(step.effective * -evolved.by_width), |d| {
                    turning.of_width(&increment.band, &kinematics, d)
                });
            }
        }
        let biot_stress = step.effective * left;
        let tangent = kinematics.spatial_tangent(&biot_stress, &modulus) + widening;
        Ok((self.response(&kinematics, &step, increment, old)?, tangent))
    }

    fn values(&self, state: &ScalarDamageState, out: &mut [f64]) {
        out[0] = state.damage;
        out[1] = state.largest;
    }
}

impl<E: DamageEvolution> Extrapolated for ScalarDamage<E> {
    const NAMES_WITH_GAP: &'static [&'static str] = &["damage", "largest", "implex_gap"];

    /// The damage goes on, up to 1.
    fn frozen(
        &self,
        increment: &Increment,
        before: &ScalarDamageState,
        now: &ScalarDamageState,
        ratio: f64,
    ) -> Result<(Sym, Tangent), MaterialError> {
        let damage = (now.damage + ratio * (now.damage - before.damage)).clamp(0.0, 1.0);
        let kinematics = Biot::new(&increment.f_new)?;
        let elastic = self.elastic.scaled(&increment.external.scale);
        let left = 1.0 - damage;
        let stress = elastic.stress(&kinematics.strain()) * left;
        let tangent = kinematics.spatial_tangent(&stress, &(elastic.stiffness() * left));
        Ok((kinematics.cauchy(&stress), tangent))
    }
}
