//! Anisotropic damage with the stress that does the work.
//!
//! The law gives `T(U − 1)`, and the document takes `σ = R·T·Rᵀ` for Cauchy's stress [Nairn 2017, app. II], which leaves
//! out the factors of stretch between the two. A crack that is smeared over half a millimetre and opens by one has a
//! stretch of 3: then the work on the particle is wrong by as much, and the free vibration of a broken bar gains energy
//! from its cracks. Here `σ` is what is conjugate to the same `T` ([`Biot::cauchy`]), so that the work is `T : dU` exactly.
//!
//! Then `J σ_nn` of a mode with the stretch `λ_n` is `λ_n T_nn`, a wave along it has the speed `λ_n c₀`, and a crack
//! that has opened carries none across it: only the stretches in its plane limit the step.

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};

use super::AnisotropicDamage;
use crate::material::{DIFFERENCE_STEP, difference_tangent};
use crate::stress_measure::{Conjugate, StressMeasure};
use crate::{
    Biot, Crack, Cracking, Increment, Initiation, Material, MaterialError, Response, Scale,
};

/// A law of cracks on Biot's strain that can be had with either stress: the laws of one crack and of two.
pub trait EitherStress: Cracking {
    /// The update with this stress.
    ///
    /// # Errors
    /// As [`Material::update`].
    fn update_as<Measure: StressMeasure>(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError>;

    /// The update with this stress and its tangent; `None` for a step the tangent of which is not known in closed form.
    ///
    /// # Errors
    /// As [`Material::update`].
    #[allow(clippy::type_complexity)] // a pair, or what stopped it
    fn update_with_tangent_as<Measure: StressMeasure>(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<(Response<Self::State>, Option<Tangent>), MaterialError>;

    /// Speed of the fastest wave in what is neither cracked nor strained, m/s.
    fn sound_speed(&self, scale: &Scale) -> f64;

    /// Unit normals of the cracks there are, reference axes; perpendicular to each other.
    fn normals(&self, state: &Self::State) -> [Option<Vector3<f64>>; 2];
}

/// The law of one crack, or of two, with the Cauchy stress conjugate to its strain: for cracks that open by a sizeable part
/// of their band.
///
/// ```
/// use fissure_materials::{
///     AnisotropicDamage, ConjugateDamage, Isotropic, Material, Mode, TwoCrackDamage,
///     softening::Linear,
/// };
/// let elastic = Isotropic { density: 1000.0, young: 1e9, poisson: 0.33 };
/// let mode = Mode { strength: 30e6, toughness: 10e3, softening: Linear };
/// let one = AnisotropicDamage::new(elastic, mode, mode);
/// ConjugateDamage(one).check()?;
/// ConjugateDamage(TwoCrackDamage(one)).check()?;
/// # Ok::<(), fissure_materials::MaterialError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConjugateDamage<L = AnisotropicDamage>(pub L);

impl<L: EitherStress> Material for ConjugateDamage<L> {
    type State = L::State;
    const SPARSE: bool = true;
    const STRESS_FROM_GRADIENT: bool = true;
    const NAMES: &'static [&'static str] = L::NAMES;
    // A path that is straight in U − 1 has none; one that is straight in F has at strains of a quarter, five natural ones
    // of a weak law (measured 0.22).
    const STEP_ERROR: f64 = 0.25;

    fn check(&self) -> Result<(), MaterialError> {
        self.0.check()
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.0.check_band(band, scale)
    }

    fn started_width(&self, old: &Self::State, new: &Self::State) -> f64 {
        self.0.started_width(old, new)
    }

    fn isotropic(&self) -> bool {
        self.0.isotropic()
    }

    fn continuous(&self) -> bool {
        self.0.continuous()
    }

    fn density(&self) -> f64 {
        self.0.density()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &Self::State, scale: &Scale) -> f64 {
        let mut bearing = *f;
        for normal in self.0.normals(state).into_iter().flatten() {
            // Without what the crack opens by: F·(1 − n⊗n) + R n⊗n has the stretches in its plane.
            let opened = f * normal;
            let length = opened.norm();
            if length > 1.0 {
                bearing += (opened / length - opened) * normal.transpose();
            }
        }
        Conjugate::wave_speed(self.0.sound_speed(scale), Biot::longest_stretch(&bearing))
    }

    fn has_history(&self, state: &Self::State) -> bool {
        self.0.has_history(state)
    }

    fn update(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError> {
        self.0.update_as::<Conjugate>(increment, old)
    }

    fn tangent(&self, increment: &Increment, old: &Self::State) -> Result<Tangent, MaterialError> {
        Ok(self.update_with_tangent(increment, old)?.1)
    }

    fn has_own_tangent(&self, old: &Self::State, new: &Self::State) -> bool {
        self.0.has_own_tangent(old, new)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<(Response<Self::State>, Tangent), MaterialError> {
        let (response, tangent) = self.0.update_with_tangent_as::<Conjugate>(increment, old)?;
        let tangent = match tangent {
            Some(tangent) => tangent,
            None => difference_tangent(self, increment, old, DIFFERENCE_STEP)?,
        };
        Ok((response, tangent))
    }

    fn values(&self, state: &Self::State, out: &mut [f64]) {
        self.0.values(state, out);
    }
}

impl<L: EitherStress> Cracking for ConjugateDamage<L> {
    fn toughness(&self, scale: &Scale) -> f64 {
        self.0.toughness(scale)
    }

    fn strength(&self, scale: &Scale) -> f64 {
        self.0.strength(scale)
    }

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.0.critical_opening(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        self.0.band_limit(scale)
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.0.failure_along(stress, normal, scale)
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.0.initiation(stress, scale)
    }

    fn failure_in_plane(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.0.failure_in_plane(stress, normal, scale)
    }

    fn initiation_in_plane(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.0.initiation_in_plane(stress, scale)
    }

    fn cracks(&self, state: &Self::State) -> Vec<Crack> {
        self.0.cracks(state)
    }

    fn irreversible(&self, state: &Self::State) -> Vec<f64> {
        self.0.irreversible(state)
    }
}
