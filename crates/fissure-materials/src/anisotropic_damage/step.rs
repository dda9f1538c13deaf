//! A step of the law, in a solid or in a sheet (`SHEET`).

use fissure_tensor::{Sym, Tangent, Vector3};

use super::crack::{CrackAt, Demand, Moved};
use super::elasticity::Elastic;
use super::tangent::{self, Start};
use super::{AnisotropicDamage, AnisotropicDamageState, NAME};
use crate::error::{check_below, check_scaled_toughness};
use crate::finite_strain::LeftStrain;
use crate::sound::sound_eight;
use crate::stress_measure::{StressMeasure, Turned};
use crate::tension_shear::TensionShear;
use crate::{
    Biot, EightPoints, EightResponses, Increment, MaterialError, Onset, Response, Scale, Softening,
};

/// What a step came to.
pub(super) struct Step {
    pub strain: Sym,
    pub biot_stress: Sym,
    pub crack: Option<(Moved, Started)>,
}

/// Components of a new crack's normal on the eigenvectors of the strain; `None` for an older crack.
pub(super) type Started = Option<[f64; 3]>;

impl<N: Softening, T: Softening> AnisotropicDamage<N, T> {
    #[inline]
    pub(super) fn surface<const SHEET: bool>(&self, scale: &Scale) -> TensionShear {
        TensionShear {
            onset: match self.onset {
                // A crack that leans out of a sheet would bring out-of-plane shear.
                Onset::TensionShear if SHEET => Onset::InPlane,
                onset => onset,
            },
            tensile: self.opening.strength * scale.strength,
            shear: self.shear.strength * scale.strength,
        }
    }

    #[inline]
    pub(super) fn elastic_at<const SHEET: bool>(&self, scale: &Scale) -> Elastic<SHEET> {
        Elastic::new(&self.elastic.scaled(scale))
    }

    #[inline]
    pub(super) fn crack_at<const SHEET: bool>(
        &self,
        scale: &Scale,
        state: &AnisotropicDamageState,
    ) -> CrackAt<'_, N, T> {
        let elastic = self.elastic_at::<SHEET>(scale);
        CrackAt {
            opening: self
                .opening
                .at(elastic.p_wave_modulus(), state.width, scale),
            shear: self.shear.at(elastic.shear_modulus(), state.width, scale),
            mixed: self.mixed,
            friction: self.friction,
            normal: Vector3::from(state.normal),
        }
    }

    /// Largest bands of the two modes.
    pub(super) fn limit<const SHEET: bool>(&self, scale: &Scale) -> f64 {
        let elastic = self.elastic_at::<SHEET>(scale);
        let opening = self.opening.at(elastic.p_wave_modulus(), 1.0, scale);
        let shear = self.shear.at(elastic.shear_modulus(), 1.0, scale);
        opening.band_limit().min(shear.band_limit())
    }

    pub(super) fn check_width<const SHEET: bool>(
        &self,
        width: f64,
        scale: &Scale,
    ) -> Result<(), MaterialError> {
        for mode in [self.opening.toughness, self.shear.toughness] {
            check_scaled_toughness(NAME, mode * scale.toughness)?;
        }
        check_below(NAME, width, self.limit::<SHEET>(scale))
    }

    /// `U − 1 − αΔT 1`, or `V − 1 − αΔT 1` from `V − 1`.
    #[inline]
    pub(super) fn mechanical(&self, strain: Sym, increment: &Increment) -> Sym {
        if self.thermal_expansion == 0.0 {
            return strain;
        }
        strain - Sym::IDENTITY * (self.thermal_expansion * increment.external.temperature)
    }

    /// The whole answer while no crack is near, from the left stretch: no spectrum, no rotation.
    #[inline(always)]
    pub(super) fn sound<const SHEET: bool>(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Option<Response<AnisotropicDamageState>> {
        if old.width != 0.0 {
            return None;
        }
        let (strain, _) = LeftStrain::small(&increment.f_new)?;
        let strain = self.mechanical(strain, increment);
        let scale = &increment.external.scale;
        let stress = self.elastic_at::<SHEET>(scale).stress(&strain);
        self.surface::<SHEET>(scale)
            .is_surely_below(&stress)
            .then(|| Response {
                stress,
                state: AnisotropicDamageState::default(),
                stored: 0.5 * stress.dot(&strain),
                dissipated: 0.0,
            })
    }

    /// [`sound`](Self::sound) of eight in a solid; `None` if a closer look is needed at one of them.
    #[inline(always)]
    pub(super) fn sound_eight(&self, points: &EightPoints) -> Option<EightResponses> {
        // The points bring no temperatures.
        if self.thermal_expansion != 0.0 {
            return None;
        }
        sound_eight::<Turned>(&self.elastic, points, |place, stress| {
            let scale = Scale {
                strength: points.strength[place],
                ..Scale::default()
            };
            self.surface::<false>(&scale).is_surely_below(stress)
        })
    }

    #[inline(always)]
    pub(super) fn step<const SHEET: bool>(
        &self,
        kinematics: &Biot,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<Step, MaterialError> {
        let scale = &increment.external.scale;
        let elastic = self.elastic_at::<SHEET>(scale);
        let strain = self.mechanical(kinematics.strain(), increment);
        let undamaged = elastic.stress(&strain);
        let mut state = *old;
        let mut started = None;
        if state.width == 0.0 {
            let surface = self.surface::<SHEET>(scale);
            let asked = if surface.is_surely_below(&undamaged) {
                None
            } else {
                Some(surface.asked(&undamaged)).filter(|asked| asked.initiation.value > 0.0)
            };
            let Some(asked) = asked else {
                return Ok(Step {
                    strain,
                    biot_stress: undamaged,
                    crack: None,
                });
            };
            let normal = asked.initiation.normal;
            state.normal = normal.into();
            state.width = increment.band.width(&(kinematics.rotation * normal));
            // The door saw neither this rotation nor, for a band with an edge of zero, this normal.
            self.check_width::<SHEET>(state.width, scale)?;
            started = Some(asked.weights);
        }
        let crack = self.crack_at::<SHEET>(scale, &state);
        let demand = Demand::new(&elastic, &crack.normal, &strain);
        let moved = crack.moved(&state, &demand, || {
            // The step starts where the last one ended: `f_old` was taken then.
            let strain = Biot::new(&increment.f_old).map_or(strain, |old| old.strain());
            let strain = self.mechanical(strain, increment);
            Demand::new(&elastic, &crack.normal, &strain)
        });
        let crack_strain = crack_strain(&crack.normal, &moved);
        Ok(Step {
            strain,
            biot_stress: undamaged - elastic.stress(&crack_strain),
            crack: Some((moved, started)),
        })
    }

    #[inline(always)]
    pub(super) fn response<Measure: StressMeasure>(
        &self,
        kinematics: &Biot,
        step: &Step,
        old: &AnisotropicDamageState,
    ) -> Response<AnisotropicDamageState> {
        // Unloading goes to the origin, so that all strain is recovered but what friction holds.
        let (mut recoverable, mut dissipated, mut state) = (step.strain, 0.0, *old);
        if let Some((moved, _)) = &step.crack {
            state = moved.state;
            dissipated = moved.dissipated;
            recoverable -= Sym::dyad_of(&state.normal.into(), &moved.slipped);
        }
        Response {
            stress: Measure::cauchy(kinematics, &step.biot_stress),
            state,
            stored: 0.5 * step.biot_stress.dot(&recoverable),
            dissipated,
        }
    }

    pub(super) fn step_tangent<const SHEET: bool, Measure: StressMeasure>(
        &self,
        kinematics: &Biot,
        step: &Step,
        increment: &Increment,
    ) -> Tangent {
        let scale = &increment.external.scale;
        let elastic = self.elastic_at::<SHEET>(scale);
        let fixed = |modulus: &Tangent| {
            Measure::tangent(kinematics, &step.biot_stress, |strain_rate, _| {
                modulus.apply(strain_rate)
            })
        };
        let Some((moved, started)) = &step.crack else {
            return fixed(&elastic.stiffness());
        };
        let normal = Vector3::from(moved.state.normal);
        let modulus = tangent::modulus(&elastic, &normal, &moved.slopes);
        let Some(weights) = started else {
            return fixed(&modulus);
        };
        Start {
            elastic: &elastic,
            kinematics,
            strain: &step.strain,
            band: &increment.band,
            moved,
            normal,
            weights: *weights,
            in_plane: self.surface::<SHEET>(scale).onset == Onset::InPlane,
            width: moved.state.width,
        }
        .tangent::<Measure>(&step.biot_stress, &modulus)
    }
}

/// `ε_c n⊗n + sym(n⊗γ_c)`.
#[inline]
fn crack_strain(normal: &Vector3<f64>, moved: &Moved) -> Sym {
    Sym::dyad(normal) * moved.normal_strain + Sym::dyad_of(normal, &moved.shear_strain)
}
