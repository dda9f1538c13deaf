//! The elastic-decohesive law in mode I [Sanchez 2010, sec. 3.5.3 and 4.5].
//!
//! The strain splits into an elastic part and the opening `u` of one crack of normal `n` smeared
//! over the band `L`: `ε = εᵉ + (u/L) n⊗n`, `T = C:εᵉ`. The crack starts when the normal traction
//! reaches the strength `τ`; then the traction follows the softening law,
//! `T_nn = τ·ratio(u τ/G)` (linear: `τ(1 − u/u₀)`, `u₀ = 2G/τ`, eq. 3.5.63).
//! A step is a closed-form return for linear softening: with the trial normal traction `t₀` of the
//! uncracked strain, `t₀ − (C_nnnn/L) u = τ·ratio(u τ/G)` has one root while
//! `L < C_nnnn G/(τ² steepest)` (eq. 4.5.17).
//!
//! Choices where the source is silent: the opening is permanent on unloading (as printed), so a
//! partly open crack under compression answers elastically; a failed crack opens and closes freely
//! and carries compression when shut; shear along the crack stays elastic. The strain is Biot's,
//! `U − 1`: objective, and linear in the opening. The band is that of the normal where and when
//! the crack starts.

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};
use serde::{Deserialize, Serialize};

use crate::{
    Biot, EightPoints, EightResponses, Extrapolated, Increment, Isotropic, Material, MaterialError,
    Response, Scale, SheetStep, Softening, check_parameter,
    error::{check_below, check_scaled_toughness},
    sheet::{Thickening, in_sheet},
    softening::{Linear, opening},
    sound::{below, sound, sound_eight},
    stress_measure::Conjugate,
    turning::Turning,
};

const NAME: &str = "elastic-decohesive law";

/// Where the normal of a crack comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Normal {
    /// Direction of the largest principal stress when it reaches the strength (Rankine).
    #[default]
    Rankine,
    /// This direction in the reference configuration; need not be of unit length.
    Prescribed(Vector3<f64>),
}

/// Parameters of the elastic-decohesive law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decohesive<S = Linear> {
    /// Elastic constants and density.
    pub elastic: Isotropic,
    /// Tensile strength τ_nf, Pa; > 0.
    pub strength: f64,
    /// Fracture energy G_f, J/m²; > 0.
    pub toughness: f64,
    /// Softening curve.
    pub softening: S,
    /// Where the crack's normal comes from.
    pub normal: Normal,
}

/// History of the elastic-decohesive law. All zero until a crack starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DecohesiveState {
    /// Unit normal of the crack in the reference configuration; zero if there is none.
    pub normal: [f64; 3],
    /// Band of the crack, m.
    pub width: f64,
    /// Dimensionless opening `u τ/G` up to which the crack has softened; never falls.
    pub softened: f64,
    /// Opening now, m.
    pub opening: f64,
    /// Whether the crack carries no more tension.
    pub failed: bool,
}

/// The constants of one particle: parameters times its scale.
struct Point<'a, S> {
    elastic: Isotropic,
    strength: f64,
    toughness: f64,
    softening: &'a S,
}

/// What a step of the crack came to.
struct Step {
    biot_stress: Sym,
    state: DecohesiveState,
    /// Slope of the traction over the opening if the crack moved, Pa/m.
    moving: Option<f64>,
    started: bool,
}

impl<S: Softening> Decohesive<S> {
    fn point(&self, scale: &Scale) -> Point<'_, S> {
        Point {
            elastic: self.elastic.scaled(scale),
            strength: self.strength * scale.strength,
            toughness: self.toughness * scale.toughness,
            softening: &self.softening,
        }
    }

    /// Normal of the crack that this stress starts, if it does.
    fn onset(&self, point: &Point<'_, S>, stress: &Sym) -> Option<Vector3<f64>> {
        match self.normal {
            Normal::Prescribed(normal) => {
                let normal = normal.normalize();
                (stress.normal_component(&normal) > point.strength).then_some(normal)
            }
            Normal::Rankine => {
                // σ₁ ≤ mean + 2√(J₂/3): rejects most states before any spectrum.
                if stress.mean() + 2.0 * (stress.j2() / 3.0).sqrt() <= point.strength {
                    return None;
                }
                let spectrum = stress.spectrum();
                (spectrum.values[0] > point.strength).then_some(spectrum.vectors[0])
            }
        }
    }

    fn step(
        &self,
        point: &Point<'_, S>,
        kinematics: &Biot,
        band: &Band,
        old: &DecohesiveState,
    ) -> Result<Step, MaterialError> {
        let uncracked = point.elastic.stress(&kinematics.strain());
        let mut state = *old;
        let mut started = false;
        if state.width == 0.0 {
            match self.onset(point, &uncracked) {
                None => {
                    return Ok(Step {
                        biot_stress: uncracked,
                        state,
                        moving: None,
                        started,
                    });
                }
                Some(normal) => {
                    state.normal = normal.into();
                    state.width = band.width(&(kinematics.rotation * normal));
                    // The door saw neither this rotation nor, for a band with an edge of zero,
                    // this normal.
                    point.check_width(state.width)?;
                    started = true;
                }
            }
        }
        let normal = Vector3::from(state.normal);
        let moving = point.open(&mut state, uncracked.normal_component(&normal));
        let crack_strain = Sym::dyad(&normal) * (state.opening / state.width);
        Ok(Step {
            biot_stress: uncracked - point.elastic.stress(&crack_strain),
            state,
            moving,
            started,
        })
    }
}

impl<S: Softening> Point<'_, S> {
    /// Largest band with a unique response, m (eq. 4.5.17).
    fn band_limit(&self) -> f64 {
        self.elastic.p_wave_modulus() * self.toughness
            / (self.strength * self.strength * self.softening.steepest())
    }

    fn check_width(&self, width: f64) -> Result<(), MaterialError> {
        check_scaled_toughness(NAME, self.toughness)?;
        check_below(NAME, width, self.band_limit())
    }

    /// Moves the opening for the normal traction `uncracked` that the strain would give without
    /// the crack. Returns the slope of the traction over the opening if it moved.
    fn open(&self, state: &mut DecohesiveState, uncracked: f64) -> Option<f64> {
        let stiffness = self.elastic.p_wave_modulus() / state.width;
        if state.failed {
            state.opening = (uncracked / stiffness).max(0.0);
            return (state.opening > 0.0).then_some(0.0);
        }
        let per_opening = self.strength / self.toughness;
        let limit = self.strength * self.softening.ratio(state.softened);
        // The slack keeps a zero increment on the softening branch from moving the state by
        // round-off.
        let slack = 8.0 * f64::EPSILON * (uncracked.abs() + self.strength);
        if uncracked - stiffness * state.opening <= limit + slack {
            return None;
        }
        state.softened = opening(
            self.softening,
            uncracked / self.strength,
            stiffness / (self.strength * per_opening),
            state.softened,
        );
        state.failed = state.softened >= self.softening.critical();
        if state.failed {
            state.softened = self.softening.critical();
            // As in every later step, to the last bit: a zero increment must not move it.
            state.opening = uncracked / stiffness;
            return Some(0.0);
        }
        state.opening = state.softened / per_opening;
        Some(self.strength * per_opening * self.softening.slope(state.softened))
    }
}

impl<S: Softening> Material for Decohesive<S> {
    type State = DecohesiveState;
    const SPARSE: bool = true;
    const STRESS_FROM_GRADIENT: bool = true;
    const NAMES: &'static [&'static str] = &["opening", "softened", "failed"];
    const STEP_ERROR: f64 = 0.0;

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic.check_for(NAME)?;
        let (strength, toughness) = (self.strength, self.toughness);
        check_parameter(NAME, "strength", strength, strength > 0.0, "finite and > 0")?;
        check_parameter(
            NAME,
            "toughness",
            toughness,
            toughness > 0.0,
            "finite and > 0",
        )?;
        self.softening.check()?;
        if let Normal::Prescribed(normal) = self.normal {
            let length = normal.norm();
            check_parameter(NAME, "normal", length, length > 0.0, "finite, not zero")?;
        }
        Ok(())
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        let width = match self.normal {
            Normal::Prescribed(normal) => band.width(&normal.normalize()),
            Normal::Rankine => band.max_width(),
        };
        self.point(scale).check_width(width)
    }

    fn started_width(&self, old: &DecohesiveState, new: &DecohesiveState) -> f64 {
        if old.width == 0.0 { new.width } else { 0.0 }
    }

    fn isotropic(&self) -> bool {
        self.normal == Normal::Rankine
    }

    fn density(&self) -> f64 {
        self.elastic.density
    }

    /// That of the sound material times the longest stretch: what a law on the Biot strain
    /// reaches in the current configuration, along or across an open crack.
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &DecohesiveState, scale: &Scale) -> f64 {
        self.elastic.scaled(scale).p_wave_speed() * Biot::longest_stretch(f)
    }

    fn has_history(&self, state: &DecohesiveState) -> bool {
        state.width != 0.0
    }

    fn update(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<Response<DecohesiveState>, MaterialError> {
        let point = self.point(&increment.external.scale);
        if let Some(response) = point.sound(increment, old) {
            return Ok(response);
        }
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step(&point, &kinematics, &increment.band, old)?;
        Ok(point.response(&kinematics, &step, old))
    }

    fn plane_stress(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
        with_tangent: bool,
    ) -> Result<Option<SheetStep<DecohesiveState>>, MaterialError> {
        let across = match self.normal {
            Normal::Rankine => self.elastic.poisson >= 0.0,
            Normal::Prescribed(normal) => normal.z == 0.0,
        };
        if !across {
            return Ok(None);
        }
        let solid = &self.elastic;
        let law = Self {
            elastic: solid.sheet(),
            ..*self
        };
        let measure = Thickening::Stretch;
        in_sheet(&law, solid, measure, increment, old, with_tangent).map(Some)
    }

    #[inline(always)]
    fn update_eight(&self, points: &EightPoints) -> Option<EightResponses> {
        sound_eight::<Conjugate>(&self.elastic, points, |place, stress| {
            below(self.strength * points.strength[place], stress)
        })
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Result<(Response<DecohesiveState>, Tangent), MaterialError> {
        let point = self.point(&increment.external.scale);
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step(&point, &kinematics, &increment.band, old)?;
        let mut modulus = point.elastic.stiffness();
        let mut widening = Tangent::zero();
        if let Some(slope) = step.moving {
            let normal = Vector3::from(step.state.normal);
            let direction = point.elastic.stress(&Sym::dyad(&normal));
            let factor = point.elastic.p_wave_modulus() + slope * step.state.width;
            modulus = modulus - Tangent::dyad(&direction, &direction) * (1.0 / factor);
            if step.started {
                let turning = match self.normal {
                    Normal::Rankine => Turning::principal(&kinematics.strain(), &normal),
                    Normal::Prescribed(_) => Turning::fixed(&normal),
                };
                let crack_strain = step.state.opening / step.state.width;
                modulus = modulus - turning.of_crack_stress(&point.elastic) * crack_strain;
                let per_width = direction * (slope * crack_strain / factor);
                widening = kinematics.spatial_rate(&per_width, |d| {
                    turning.of_width(&increment.band, &kinematics, d)
                });
            }
        }
        let tangent = kinematics.spatial_tangent(&step.biot_stress, &modulus) + widening;
        let response = match point.sound(increment, old) {
            Some(response) => response,
            None => point.response(&kinematics, &step, old),
        };
        Ok((response, tangent))
    }

    fn values(&self, state: &DecohesiveState, out: &mut [f64]) {
        out[0] = state.opening;
        out[1] = state.softened;
        out[2] = f64::from(u8::from(state.failed));
    }
}

impl<S: Softening> Point<'_, S> {
    /// The response without a crack where there is none and a bound rules one out.
    #[inline]
    fn sound(
        &self,
        increment: &Increment,
        old: &DecohesiveState,
    ) -> Option<Response<DecohesiveState>> {
        if old.width != 0.0 {
            return None;
        }
        sound::<Conjugate, _>(&self.elastic, &increment.f_new, |stress| {
            below(self.strength, stress)
        })
    }

    fn response(
        &self,
        kinematics: &Biot,
        step: &Step,
        old: &DecohesiveState,
    ) -> Response<DecohesiveState> {
        let state = step.state;
        let (mut elastic_strain, mut dissipated) = (kinematics.strain(), 0.0);
        if state.width > 0.0 {
            let normal = Vector3::from(state.normal);
            elastic_strain -= Sym::dyad(&normal) * (state.opening / state.width);
            let spent = self.softening.area(state.softened) - self.softening.area(old.softened);
            // Where a curve is flat the difference of two areas can be round-off below zero.
            dissipated = self.toughness / state.width * spent.max(0.0);
        }
        Response {
            stress: kinematics.cauchy(&step.biot_stress),
            state,
            stored: 0.5 * step.biot_stress.dot(&elastic_strain),
            dissipated,
        }
    }
}

impl<S: Softening> Extrapolated for Decohesive<S> {
    const NAMES_WITH_GAP: &'static [&'static str] =
        &["opening", "softened", "failed", "implex_gap"];

    /// The opening goes on, not below zero; that of a failed crack, which moves freely, is found from the strain.
    fn frozen(
        &self,
        increment: &Increment,
        before: &DecohesiveState,
        now: &DecohesiveState,
        ratio: f64,
    ) -> Result<(Sym, Tangent), MaterialError> {
        let point = self.point(&increment.external.scale);
        let kinematics = Biot::new(&increment.f_new)?;
        let mut stress = point.elastic.stress(&kinematics.strain());
        let mut modulus = point.elastic.stiffness();
        if now.width > 0.0 {
            let normal = Vector3::from(now.normal);
            let direction = point.elastic.stress(&Sym::dyad(&normal));
            let mut opening = (now.opening + ratio * (now.opening - before.opening)).max(0.0);
            if now.failed {
                let mut state = *now;
                if point
                    .open(&mut state, stress.normal_component(&normal))
                    .is_some()
                {
                    let softer = 1.0 / point.elastic.p_wave_modulus();
                    modulus = modulus - Tangent::dyad(&direction, &direction) * softer;
                }
                opening = state.opening;
            }
            stress -= direction * (opening / now.width);
        }
        let tangent = kinematics.spatial_tangent(&stress, &modulus);
        Ok((kinematics.cauchy(&stress), tangent))
    }
}

mod cracking;
#[cfg(test)]
mod tests;
