//! Anisotropic damage by one smeared crack that softens in opening and in shear
//! [Nairn, Hammerquist & Aimene 2017, sec. 2 and app. II].
//!
//! With the strain `E = U − 1 − αΔT 1` of `F = R·U`, the crack's normal `n` and the engineering
//! shear strain `γ` in its plane, the demands on the crack are
//!
//! 1. `ε_n = n·E·n + ν/(1−ν) (tr E − n·E·n)` (eq. 9) and `γ = 2 (E·n − (n·E·n) n)`;
//! 2. the crack's strains `ε_c = d_n ε_n` if `ε_n > 0`, else 0 (contact, eq. 15), `γ_c = d_t γ` (eq. 12);
//! 3. the stress `T = C:(E − ε_c n⊗n − sym(n⊗γ_c))` (eqs 1, 7), Cauchy's `σ = R·T·Rᵀ` (app. II);
//! 4. the tractions `T_n = (1−d_n) C₁₁ ε_n` and `τ = (1−d_t) G γ`;
//! 5. while damage grows `T_n = σ_n f_n(δ_n)` and `|τ| = τ_t f_t(δ_t)` (eqs 5, 18), hence
//!    `ε_n = δ_n + ε_n0 f_n(δ_n)`, `ε_n0 = σ_n/C₁₁` (eq. 17), and for `|γ|` alike (eq. 26);
//! 6. `d = δ/(δ + ε_0 f(δ))` (eqs 19, 24);
//! 7. the energy per crack area `G_I = 𝒢_I (∫₀ˢ f − s f(s)/2)` with `s = δ_n L σ_n/𝒢_I` (eqs 31,
//!    33), `L` the band, and `G_II` alike;
//! 8. failure when `(G_I/𝒢_I)^m + (G_II/𝒢_II)^n = 1` (eq. 34), then `d_n = d_t = 1` (sec. 2.4);
//! 9. a unique response while `L < min(C₁₁ 𝒢_I/(σ_n² max(−f_n')), G 𝒢_II/(τ_t² max(−f_t')))` (eq. 36).
//!
//! Differences from the document, each for a reason:
//! - Shear has *one* damage and the traction is bounded by a circle. The document's two damages on
//!   an ellipse (eqs 20-25) were withdrawn by its authors; see [`EllipticalDamage`](crate::EllipticalDamage).
//! - The document adds increments; here strain and damage give the total stress. It is the limit of
//!   small steps of the same equations, so a step may be of any size: reversed shear, or tension
//!   past the strength out of compression, in one step give what many steps give.
//! - A shut crack stays shut until its normal traction has come back to zero. The document's
//!   `max(d_n dε_n, −ε_c)` would open it while it is still pressed.
//! - The place of failure is found on the straight way through the step, and the energy the crack
//!   still stores there, which (34) lets go, is booked as dissipated.
//! - Friction of the faces of a failed crack is an option.
//!
//! In the step in which a crack starts its plane is that of the end of the step.

mod circle;
mod conjugate;
mod crack;
mod cracking;
mod elasticity;
mod ellipse;
mod incremental;
mod mixed_mode;
mod mode;
mod orthotropic;
mod sheet;
mod step;
mod tangent;
mod tensors;
#[cfg(test)]
mod tests;
mod two_cracks;

use fissure_tensor::{Matrix3, Tangent, Vector3};

pub use self::conjugate::ConjugateDamage;
use self::conjugate::EitherStress;
pub use self::crack::AnisotropicDamageState;
pub use self::incremental::{
    EllipticalDamage, IncrementalDamage, IncrementalState, SteppedCircleDamage,
};
pub use self::mixed_mode::MixedMode;
pub use self::mode::Mode;
pub use self::orthotropic::{DamagePlane, OrthotropicDamage};
pub use self::two_cracks::{TwoCrackDamage, TwoCrackState};

use crate::softening::Linear;
use crate::stress_measure::{StressMeasure, Turned};
use crate::{
    Biot, EightPoints, EightResponses, Increment, Isotropic, Material, MaterialError, Onset,
    Response, Scale, SheetStep, Softening, check_parameter,
};

const NAME: &str = "anisotropic damage";

/// Parameters of the anisotropic damage law.
///
/// ```
/// use fissure_materials::{AnisotropicDamage, Isotropic, Material, Mode, softening::Linear};
/// let elastic = Isotropic { density: 1000.0, young: 1e9, poisson: 0.33 };
/// let opening = Mode { strength: 30e6, toughness: 10e3, softening: Linear };
/// let shear = Mode { strength: 20e6, toughness: 10e3, softening: Linear };
/// let law = AnisotropicDamage::new(elastic, opening, shear);
/// law.check()?;
/// # Ok::<(), fissure_materials::MaterialError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnisotropicDamage<N = Linear, T = Linear> {
    /// Elastic constants and density.
    pub elastic: Isotropic,
    /// Tensile strength `σ_n`, toughness `𝒢_I` and softening in opening.
    pub opening: Mode<N>,
    /// Shear strength `τ_t`, toughness `𝒢_II` and softening in sliding.
    pub shear: Mode<T>,
    /// Which stress starts a crack, and on which plane.
    pub onset: Onset,
    /// When a crack that opens and slides has failed.
    pub mixed: MixedMode,
    /// Coefficient of friction of the faces of a failed crack; ≥ 0, 0 by default.
    pub friction: f64,
    /// Thermal expansion α, 1/K, for the temperature change of the increment; 0 by default.
    pub thermal_expansion: f64,
}

impl<N: Softening, T: Softening> AnisotropicDamage<N, T> {
    /// Cracks on any plane, (34) with exponents 1, no friction, no thermal expansion.
    pub fn new(elastic: Isotropic, opening: Mode<N>, shear: Mode<T>) -> Self {
        Self {
            elastic,
            opening,
            shear,
            onset: Onset::default(),
            mixed: MixedMode::default(),
            friction: 0.0,
            thermal_expansion: 0.0,
        }
    }

    /// The update with one of the stresses and its tangent.
    fn with_tangent_as<Measure: StressMeasure>(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<(Response<AnisotropicDamageState>, Tangent), MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step::<false>(&kinematics, increment, old)?;
        Ok((
            self.response::<Measure>(&kinematics, &step, old),
            self.step_tangent::<false, Measure>(&kinematics, &step, increment),
        ))
    }

    /// The update with everything. Out of line: the way through `sound` is not to pay for it.
    #[inline(never)]
    fn full_update(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<Response<AnisotropicDamageState>, MaterialError> {
        self.update_as::<Turned>(increment, old)
    }
}

impl<N: Softening, T: Softening> EitherStress for AnisotropicDamage<N, T> {
    #[inline(always)]
    fn update_as<Measure: StressMeasure>(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<Response<AnisotropicDamageState>, MaterialError> {
        let kinematics = Biot::new(&increment.f_new)?;
        let step = self.step::<false>(&kinematics, increment, old)?;
        Ok(self.response::<Measure>(&kinematics, &step, old))
    }

    fn update_with_tangent_as<Measure: StressMeasure>(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<(Response<AnisotropicDamageState>, Option<Tangent>), MaterialError> {
        let (response, tangent) = self.with_tangent_as::<Measure>(increment, old)?;
        Ok((response, Some(tangent)))
    }

    fn sound_speed(&self, scale: &Scale) -> f64 {
        self.elastic.scaled(scale).p_wave_speed()
    }

    fn normals(&self, state: &AnisotropicDamageState) -> [Option<Vector3<f64>>; 2] {
        [state.started_normal(), None]
    }
}

impl<N: Softening, T: Softening> Material for AnisotropicDamage<N, T> {
    type State = AnisotropicDamageState;
    /// `σ = R·T·Rᵀ` leaves out factors of stretch.
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
    ];
    /// From rest and from a uniaxial stretch a step gives what many give.
    const STEP_ERROR: f64 = 0.0;

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic.check_for(NAME)?;
        self.opening
            .check(NAME, ["opening.strength", "opening.toughness"])?;
        self.shear
            .check(NAME, ["shear.strength", "shear.toughness"])?;
        let (friction, expansion) = (self.friction, self.thermal_expansion);
        check_parameter(
            NAME,
            "friction",
            friction,
            friction >= 0.0,
            "finite and >= 0",
        )?;
        check_parameter(NAME, "thermal_expansion", expansion, true, "finite")?;
        self.mixed.check(NAME)?;
        if let Onset::Prescribed(normal) = self.onset {
            let length = normal.norm();
            check_parameter(NAME, "onset", length, length > 0.0, "finite, not zero")?;
        }
        Ok(())
    }

    fn check_band(&self, band: &fissure_tensor::Band, scale: &Scale) -> Result<(), MaterialError> {
        let width = match self.onset {
            Onset::Prescribed(normal) => band.width(&normal.normalize()),
            _ => band.max_width(),
        };
        self.check_width::<false>(width, scale)
    }

    fn started_width(&self, old: &AnisotropicDamageState, new: &AnisotropicDamageState) -> f64 {
        if old.width == 0.0 { new.width } else { 0.0 }
    }

    /// Of the two planes that are equal in shear a rule on axes takes one.
    fn isotropic(&self) -> bool {
        self.onset == Onset::Tension
    }

    /// The drop of (34) and, in a step beyond the surface, the switch between a plane in tension and
    /// one in shear are jumps.
    fn continuous(&self) -> bool {
        self.mixed == MixedMode::Uncoupled
            && matches!(self.onset, Onset::Tension | Onset::Prescribed(_))
    }

    fn density(&self) -> f64 {
        self.elastic.density
    }

    /// That of the sound material times the square of the longest stretch: with `σ = R·T·Rᵀ` the
    /// nominal stress is `T` times the change of the area it acts on.
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &AnisotropicDamageState, scale: &Scale) -> f64 {
        Turned::wave_speed(self.sound_speed(scale), Biot::longest_stretch(f))
    }

    fn has_history(&self, state: &AnisotropicDamageState) -> bool {
        state.width != 0.0
    }

    #[inline]
    fn update(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<Response<AnisotropicDamageState>, MaterialError> {
        match self.sound::<false>(increment, old) {
            Some(response) => Ok(response),
            None => self.full_update(increment, old),
        }
    }

    #[inline(always)]
    fn update_eight(&self, points: &EightPoints) -> Option<EightResponses> {
        self.sound_eight(points)
    }

    fn plane_stress(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
        with_tangent: bool,
    ) -> Result<Option<SheetStep<AnisotropicDamageState>>, MaterialError> {
        self.in_sheet(increment, old, with_tangent)
    }

    fn tangent(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
    ) -> Result<(Response<AnisotropicDamageState>, Tangent), MaterialError> {
        let (found, tangent) = self.with_tangent_as::<Turned>(increment, old)?;
        let response = self.sound::<false>(increment, old).unwrap_or(found);
        Ok((response, tangent))
    }

    fn values(&self, state: &AnisotropicDamageState, out: &mut [f64]) {
        out.fill(0.0);
        if state.width == 0.0 {
            return;
        }
        let crack = self.crack_at::<false>(&Scale::default(), state);
        out[0] = state.opening;
        out[1] = 1.0 - crack.opening_integrity(state);
        out[2] = 1.0 - crack.shear_integrity(state);
        out[3] = crack.opening.dissipated_fraction(state.opened) * self.opening.toughness;
        out[4] = crack.shear.dissipated_fraction(state.sheared) * self.shear.toughness;
        out[5] = state.left_over;
        out[6] = f64::from(u8::from(state.failed));
    }
}
