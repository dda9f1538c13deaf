//! Anisotropic damage with a second crack across the first [Nairn 2017, sec. 2.5.4].
//!
//! The document proposes a second damage tensor on the damaged material (eqs 45, 46) and leaves its evolution open. Here
//! both cracks have strains of their own, each driven by what the other leaves:
//!
//! 1. `T = C:(E − e₁ − e₂)`, `e_j = ε_cj n_j⊗n_j + sym(n_j⊗γ_cj)`, each crack by the equations of
//!    [`AnisotropicDamage`];
//! 2. the demand on a crack is that of `E` less the other's strain: `ε_n1 = A₁ − κ ε_c2`, `ε_n2 = A₂ − κ ε_c1`, with
//!    `A_j` the demand of `E` (eq. 9) and `κ = λ/C₁₁`;
//! 3. the second crack's normal is perpendicular to the first's. It starts where the stress that the first crack leaves
//!    reaches the tensile strength, or between such planes the shear strength, on a plane perpendicular to the first;
//! 4. the traction along `n₂` on the first plane is that along `n₁` on the second. The first crack softens by it; the
//!    second takes no part until nothing holds its faces from sliding, and then all;
//! 5. two cracks that open together have a unique response while the Hessian of `½(E−e₁−e₂):C:(E−e₁−e₂) + …` is
//!    positive, `C₁₁ − h > λ`: with `h = L σ_n²/(𝒢_I) max(−f')` the band is below `2G 𝒢_I/(σ_n² max(−f'))`, narrower
//!    than that of one crack by `2G/C₁₁`.
//!
//! Friction of closed faces is not offered: which of two failed cracks slides would be left to chance. In the step
//! in which the second crack starts the tangent is a difference.
//!
//! Cauchy's stress is `R·T·Rᵀ` as in the document; [`ConjugateDamage`](crate::ConjugateDamage) gives the one that does the
//! work `T : dU`.

mod cracking;
mod pair;
mod sheet;
#[cfg(test)]
mod tests;

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};
use serde::{Deserialize, Serialize};

use self::pair::{MovedPair, Pair};
use self::sheet::Sheet;
use super::conjugate::EitherStress;
use super::crack::Demand;
use super::step::Step;
use super::{AnisotropicDamage, AnisotropicDamageState};
use crate::error::check_below;
use crate::material::{DIFFERENCE_STEP, difference_tangent};
use crate::softening::Linear;
use crate::stress_measure::{StressMeasure, Turned};
use crate::tension_shear::TensionShear;
use crate::{
    Biot, Increment, Initiation, Material, MaterialError, Onset, Response, Scale, SheetStep,
    Softening, check_parameter,
};

const NAME: &str = "two-crack damage";

/// The law of one crack, given a second one across the first.
///
/// ```
/// use fissure_materials::{
///     AnisotropicDamage, Isotropic, Material, Mode, TwoCrackDamage, softening::Linear,
/// };
/// let elastic = Isotropic { density: 1000.0, young: 1e9, poisson: 0.33 };
/// let opening = Mode { strength: 30e6, toughness: 10e3, softening: Linear };
/// let shear = Mode { strength: 20e6, toughness: 10e3, softening: Linear };
/// let law = TwoCrackDamage(AnisotropicDamage::new(elastic, opening, shear));
/// law.check()?;
/// # Ok::<(), fissure_materials::MaterialError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoCrackDamage<N = Linear, T = Linear>(pub AnisotropicDamage<N, T>);

/// Histories of both cracks; all zero until one starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TwoCrackState {
    /// The crack that started first.
    pub first: AnisotropicDamageState,
    /// The one across it.
    pub second: AnisotropicDamageState,
    /// Normal strain of the first crack by which the second was relieved.
    pub relieving: f64,
}

/// A step that may have moved two cracks.
#[allow(clippy::large_enum_variant)] // an update takes nothing from the heap
enum Both {
    /// At most one crack, and what the law of one says of it.
    One(Step),
    /// Strain without heat, stress of the unturned material, both cracks, and whether the second has just
    /// started.
    Two(Sym, Sym, MovedPair, bool),
}

impl<N: Softening, T: Softening> TwoCrackDamage<N, T> {
    /// Where across the first crack's normal a second would start: value and normal.
    fn across<const SHEET: bool>(
        &self,
        stress: &Sym,
        first: &Vector3<f64>,
        scale: &Scale,
    ) -> Initiation {
        let surface = self.0.surface::<SHEET>(scale);
        if SHEET || surface.onset == Onset::InPlane {
            // Planes that contain z: one is across.
            let normal = Vector3::z().cross(first);
            let value = stress.normal_component(&normal) / surface.tensile - 1.0;
            return Initiation { value, normal };
        }
        // In axes of which z is the first normal, planes across it are planes that contain z.
        let axis = Vector3::ith(first.iamin(), 1.0).cross(first).normalize();
        let axes = Matrix3::from_rows(&[
            axis.transpose(),
            first.cross(&axis).transpose(),
            first.transpose(),
        ]);
        let surface = TensionShear {
            onset: Onset::InPlane,
            tensile: surface.tensile,
            shear: match surface.onset {
                Onset::Tension => f64::INFINITY,
                _ => surface.shear,
            },
        };
        let asked = surface.asked(&stress.rotated(&axes)).initiation;
        Initiation {
            value: asked.value,
            normal: axes.transpose() * asked.normal,
        }
    }

    fn step<const SHEET: bool>(
        &self,
        kinematics: &Biot,
        increment: &Increment,
        old: &TwoCrackState,
    ) -> Result<Both, MaterialError> {
        let scale = &increment.external.scale;
        let mut state = *old;
        let started = old.second.width == 0.0;
        if started {
            let step = self.0.step::<SHEET>(kinematics, increment, &old.first)?;
            let Some((moved, _)) = &step.crack else {
                return Ok(Both::One(step));
            };
            let normal = Vector3::from(moved.state.normal);
            let asked = self.across::<SHEET>(&step.biot_stress, &normal, scale);
            if !(asked.value > 0.0) {
                return Ok(Both::One(step));
            }
            (state.first.normal, state.first.width) = (moved.state.normal, moved.state.width);
            state.second.normal = asked.normal.into();
            state.second.width = increment.band.width(&(kinematics.rotation * asked.normal));
            for width in [state.first.width, state.second.width] {
                self.check_width::<SHEET>(width, scale)?;
            }
        }
        let elastic = self.0.elastic_at::<SHEET>(scale);
        let strain = self.0.mechanical(kinematics.strain(), increment);
        let old_strain = Biot::new(&increment.f_old).map_or(strain, |old| old.strain());
        let old_strain = self.0.mechanical(old_strain, increment);
        let first = self.0.crack_at::<SHEET>(scale, &state.first);
        let second = self.0.crack_at::<SHEET>(scale, &state.second);
        let normals = [first.normal, second.normal];
        let demands = |strain| normals.map(|normal| Demand::new(&elastic, &normal, strain));
        let moved = Pair {
            first,
            second,
            lateral: elastic.lateral_ratio(),
            old: &state,
            demands: demands(&strain),
            old_demands: demands(&old_strain),
        }
        .settle();
        let stress = elastic.stress(&(strain - moved.strain()));
        Ok(Both::Two(strain, stress, moved, started))
    }

    fn response<Measure: StressMeasure>(
        &self,
        kinematics: &Biot,
        step: &Both,
        old: &TwoCrackState,
    ) -> Response<TwoCrackState> {
        match step {
            Both::One(step) => {
                let one = self.0.response::<Measure>(kinematics, step, &old.first);
                with_first(&one, old)
            }
            Both::Two(strain, stress, moved, _) => Response {
                stress: Measure::cauchy(kinematics, stress),
                state: moved.state(),
                stored: 0.5 * stress.dot(strain),
                dissipated: moved.dissipated(),
            },
        }
    }

    /// `None` for the step in which the second crack starts: its plane still turns.
    fn step_tangent<const SHEET: bool, Measure: StressMeasure>(
        &self,
        kinematics: &Biot,
        step: &Both,
        increment: &Increment,
    ) -> Option<Tangent> {
        match step {
            Both::One(step) => Some(
                self.0
                    .step_tangent::<SHEET, Measure>(kinematics, step, increment),
            ),
            Both::Two(.., true) => None,
            Both::Two(_, stress, moved, _) => {
                let elastic = self.0.elastic_at::<SHEET>(&increment.external.scale);
                let modulus = moved.modulus(&elastic);
                Some(Measure::tangent(kinematics, stress, |rate, _| {
                    modulus.apply(rate)
                }))
            }
        }
    }

    /// Largest band, m, of two cracks that open together and of one that shears.
    fn limit<const SHEET: bool>(&self, scale: &Scale) -> f64 {
        let elastic = self.0.elastic_at::<SHEET>(scale);
        let both = 2.0 * elastic.shear_modulus();
        let opening = self.0.opening.at(both, 1.0, scale).band_limit();
        opening.min(self.0.limit::<SHEET>(scale))
    }

    fn check_width<const SHEET: bool>(
        &self,
        width: f64,
        scale: &Scale,
    ) -> Result<(), MaterialError> {
        self.0.check_width::<SHEET>(width, scale)?;
        check_below(NAME, width, self.limit::<SHEET>(scale))
    }
}

/// A response of the law of one crack.
fn with_first(
    one: &Response<AnisotropicDamageState>,
    old: &TwoCrackState,
) -> Response<TwoCrackState> {
    Response {
        stress: one.stress,
        state: TwoCrackState {
            first: one.state,
            ..*old
        },
        stored: one.stored,
        dissipated: one.dissipated,
    }
}

impl<N: Softening, T: Softening> EitherStress for TwoCrackDamage<N, T> {
    #[inline(always)]
    fn update_as<Measure: StressMeasure>(
        &self,
        increment: &Increment,
        old: &TwoCrackState,
    ) -> Result<Response<TwoCrackState>, MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step::<false>(&kinematics, increment, old)?;
        Ok(self.response::<Measure>(&kinematics, &step, old))
    }

    fn update_with_tangent_as<Measure: StressMeasure>(
        &self,
        increment: &Increment,
        old: &TwoCrackState,
    ) -> Result<(Response<TwoCrackState>, Option<Tangent>), MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step::<false>(&kinematics, increment, old)?;
        Ok((
            self.response::<Measure>(&kinematics, &step, old),
            self.step_tangent::<false, Measure>(&kinematics, &step, increment),
        ))
    }

    fn sound_speed(&self, scale: &Scale) -> f64 {
        self.0.sound_speed(scale)
    }

    fn normals(&self, state: &TwoCrackState) -> [Option<Vector3<f64>>; 2] {
        [state.first.started_normal(), state.second.started_normal()]
    }
}

impl<N: Softening, T: Softening> Material for TwoCrackDamage<N, T> {
    type State = TwoCrackState;
    const HYPERELASTIC: bool = false;
    const SPARSE: bool = true;
    const STRESS_FROM_GRADIENT: bool = true;
    const NAMES: &'static [&'static str] = &[
        "opening",
        "normal_damage",
        "shear_damage",
        "opening_energy",
        "shear_energy",
        "left_over_energy",
        "failed",
        "second_opening",
        "second_normal_damage",
        "second_shear_damage",
        "second_opening_energy",
        "second_shear_energy",
        "second_left_over_energy",
        "second_failed",
    ];
    const STEP_ERROR: f64 = 0.0;

    fn check(&self) -> Result<(), MaterialError> {
        self.0.check()?;
        let friction = self.0.friction;
        check_parameter(NAME, "friction", friction, friction == 0.0, "0")
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.check_width::<false>(band.max_width(), scale)
    }

    fn started_width(&self, old: &TwoCrackState, new: &TwoCrackState) -> f64 {
        self.0
            .started_width(&old.first, &new.first)
            .max(self.0.started_width(&old.second, &new.second))
    }

    fn isotropic(&self) -> bool {
        self.0.isotropic()
    }

    /// A second crack starts at once on a plane that a small change of stress may turn.
    fn continuous(&self) -> bool {
        false
    }

    fn density(&self) -> f64 {
        self.0.density()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &TwoCrackState, scale: &Scale) -> f64 {
        self.0.wave_speed(f, &state.first, scale)
    }

    fn has_history(&self, state: &TwoCrackState) -> bool {
        self.0.has_history(&state.first)
    }

    #[inline]
    fn update(
        &self,
        increment: &Increment,
        old: &TwoCrackState,
    ) -> Result<Response<TwoCrackState>, MaterialError> {
        if let Some(one) = self.0.sound::<false>(increment, &old.first) {
            return Ok(with_first(&one, old));
        }
        self.update_as::<Turned>(increment, old)
    }

    fn plane_stress(
        &self,
        increment: &Increment,
        old: &TwoCrackState,
        with_tangent: bool,
    ) -> Result<Option<SheetStep<TwoCrackState>>, MaterialError> {
        let Some(flat) = self.0.flattened(increment) else {
            return Ok(None);
        };
        let kinematics = Biot::new(&flat.f_new)?;
        let step = self.step::<true>(&kinematics, &flat, old)?;
        let response = self.response::<Turned>(&kinematics, &step, old);
        let thickening = self.0.thickening(&flat, &response.stress)?;
        let mut tangent = None;
        if with_tangent {
            let fixed = match self.step_tangent::<true, Turned>(&kinematics, &step, &flat) {
                Some(fixed) => fixed,
                None => difference_tangent(&Sheet(*self), &flat, old, DIFFERENCE_STEP)?,
            };
            tangent = Some(self.0.thinned(&flat, &response.stress, thickening, &fixed));
        }
        Ok(Some(SheetStep {
            response,
            thickening,
            tangent,
        }))
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &TwoCrackState,
    ) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    fn has_own_tangent(&self, old: &TwoCrackState, new: &TwoCrackState) -> bool {
        old.second.width == new.second.width
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &TwoCrackState,
    ) -> Result<(Response<TwoCrackState>, Tangent), MaterialError> {
        let (found, tangent) = self.update_with_tangent_as::<Turned>(increment, old)?;
        let response = match self.0.sound::<false>(increment, &old.first) {
            Some(one) => with_first(&one, old),
            None => found,
        };
        let tangent = match tangent {
            Some(tangent) => tangent,
            None => difference_tangent(self, increment, old, DIFFERENCE_STEP)?,
        };
        Ok((response, tangent))
    }

    fn values(&self, state: &TwoCrackState, out: &mut [f64]) {
        let (first, second) = out.split_at_mut(out.len() / 2);
        self.0.values(&state.first, first);
        self.0.values(&state.second, second);
    }
}
