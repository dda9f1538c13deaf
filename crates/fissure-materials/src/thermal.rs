//! Thermal expansion under any law: `Thermal` hands the law inside what the temperature leaves.
//!
//! `F = F_m·F_θ` with the stress-free stretch of the temperature change `ΔT`
//! ([`External::temperature`](crate::External), from the stress-free state),
//! `F_θ = 1 + ΔT Σ α_i a_i⊗a_i`  (1),
//! in axes `a_i` of the reference configuration; the law inside sees `F_m = F·F_θ⁻¹`  (2). A free
//! expansion `F = R·F_θ` is therefore free of stress, whatever the law.
//!
//! The reference volume of the law inside is the expanded one, so per volume of the undeformed
//! body energies are `J_θ = det F_θ` times its own, while Cauchy stress and spatial tangent are
//! the same (`F → (1 + d) F` is `F_m → (1 + d) F_m`)  (3). The mass per expanded volume is `ρ/J_θ`,
//! so wave speeds are `√J_θ` times those inside  (4).
//!
//! The work of the stress is stored plus dissipated energy at constant temperature. A change of
//! temperature of a held body changes `stored`, the free energy at that temperature, without work.
//! The state remembers the temperature, since the law inside may read the start of the step.

use fissure_tensor::{Band, Matrix3, Sym, Tangent, Vector3};
use serde::{Deserialize, Serialize};

use crate::isotropic::check_deformation;
use crate::orthotropic::check_axes;
use crate::wrapping::{hand_on_cracking, hand_on_material};
use crate::{
    Crack, Cracking, Increment, Initiation, Material, MaterialError, Response, Scale, SheetStep,
    check_parameter, sheet,
};

const NAME: &str = "thermal expansion";

/// Linear thermal expansion, with coefficients in 1/K; finite, of either sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expansion {
    /// The same in every direction.
    Isotropic(f64),
    /// One coefficient along each material axis.
    Orthotropic {
        /// Coefficients α₁, α₂, α₃, 1/K.
        coefficients: [f64; 3],
        /// Rotation whose columns are the material axes in the reference configuration.
        axes: Matrix3<f64>,
    },
}

/// The law inside, with thermal expansion.
///
/// ```
/// use fissure_materials::{Expansion, Hencky, Increment, Isotropic, Material, Matrix3, Thermal};
/// let steel = Isotropic { density: 7800.0, young: 210e9, poisson: 0.3 };
/// let law = Thermal { law: Hencky { elastic: steel }, expansion: Expansion::Isotropic(12e-6) };
/// let mut free = Increment::to(Matrix3::identity() * (1.0 + 12e-6 * 100.0));
/// free.external.temperature = 100.0;
/// let response = law.update(&free, &law.initial())?;
/// assert!(response.stress.max_abs() < 1e-3);
/// # Ok::<(), fissure_materials::MaterialError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thermal<M> {
    /// The law inside.
    pub law: M,
    /// How it expands.
    pub expansion: Expansion,
}

/// History of a law with thermal expansion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ThermalState<S> {
    /// History of the law inside.
    pub inner: S,
    /// Temperature change at the end of the last step, K.
    pub temperature: f64,
}

/// `F_θ` at one temperature.
struct Stretch {
    /// Principal stretches.
    values: [f64; 3],
    axes: Option<Matrix3<f64>>,
}

impl Stretch {
    /// `F·F_θ⁻¹`.
    fn taken_off(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        match &self.axes {
            // Divided, so that a free expansion leaves the identity to the last bit.
            None => f / self.values[0],
            Some(axes) => {
                let inverse = Matrix3::from_diagonal(&Vector3::from(self.values).map(f64::recip));
                f * (axes * inverse * axes.transpose())
            }
        }
    }

    /// `F_θ·n`.
    fn image(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        match &self.axes {
            None => direction * self.values[0],
            Some(axes) => {
                let stretch = Matrix3::from_diagonal(&Vector3::from(self.values));
                axes * (stretch * (axes.transpose() * direction))
            }
        }
    }

    fn jacobian(&self) -> f64 {
        self.values.iter().product()
    }
}

impl Expansion {
    /// `F_θ` of a temperature change.
    fn stretch(&self, temperature: f64) -> Result<Stretch, MaterialError> {
        let (coefficients, axes) = match self {
            Self::Isotropic(coefficient) => ([*coefficient; 3], None),
            Self::Orthotropic { coefficients, axes } => (*coefficients, Some(*axes)),
        };
        let values = coefficients.map(|coefficient| 1.0 + coefficient * temperature);
        for stretch in values {
            let rule = "finite, with 1 + coefficient x temperature > 0";
            check_parameter(NAME, "temperature", temperature, stretch > 0.0, rule)?;
        }
        Ok(Stretch { values, axes })
    }

    fn check(&self) -> Result<(), MaterialError> {
        let rule = "finite";
        match self {
            Self::Isotropic(coefficient) => {
                check_parameter(NAME, "coefficient", *coefficient, true, rule)
            }
            Self::Orthotropic { coefficients, axes } => {
                for coefficient in coefficients {
                    check_parameter(NAME, "coefficients", *coefficient, true, rule)?;
                }
                check_axes(NAME, axes)
            }
        }
    }
}

impl<M: Material> Thermal<M> {
    /// What the law inside is given, and the stretch at the end of the step.
    fn mechanical(
        &self,
        increment: &Increment,
        old: &ThermalState<M::State>,
    ) -> Result<(Increment, Stretch), MaterialError> {
        // Before the product, whose round-off can give a flattened body a volume.
        check_deformation(increment)?;
        let temperature = increment.external.temperature;
        let stretch = self.expansion.stretch(temperature)?;
        let before = self.expansion.stretch(old.temperature)?;
        let inner = Increment {
            f_old: before.taken_off(&increment.f_old),
            f_new: stretch.taken_off(&increment.f_new),
            ..*increment
        };
        Ok((inner, stretch))
    }

    fn response(
        inner: Response<M::State>,
        stretch: &Stretch,
        temperature: f64,
    ) -> Response<ThermalState<M::State>> {
        let jacobian = stretch.jacobian();
        Response {
            stress: inner.stress,
            state: ThermalState {
                inner: inner.state,
                temperature,
            },
            stored: inner.stored * jacobian,
            dissipated: inner.dissipated * jacobian,
        }
    }
}

impl<M: Material> Material for Thermal<M> {
    type State = ThermalState<M::State>;
    hand_on_material!(law);

    const STEP_ERROR: f64 = M::STEP_ERROR;
    const STEP_ERROR_IN_PLANE_STRESS: f64 = M::STEP_ERROR_IN_PLANE_STRESS;
    const PLANE: bool = M::PLANE;

    fn check(&self) -> Result<(), MaterialError> {
        self.law.check()?;
        self.expansion.check()
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.law.check_band(band, scale)
    }

    /// Whether the law inside is; at the temperature at rest the expansion prefers no direction.
    fn isotropic(&self) -> bool {
        self.law.isotropic() && matches!(self.expansion, Expansion::Isotropic(_))
    }

    /// Eq. 4, at the temperature of the state; that of the law inside where the expansion refuses
    /// it, which no update returns.
    fn wave_speed(&self, f: &Matrix3<f64>, state: &Self::State, scale: &Scale) -> f64 {
        match self.expansion.stretch(state.temperature) {
            Ok(stretch) => {
                let mechanical = stretch.taken_off(f);
                let inside = self.law.wave_speed(&mechanical, &state.inner, scale);
                inside * stretch.jacobian().sqrt()
            }
            Err(_) => self.law.wave_speed(f, &state.inner, scale),
        }
    }

    fn initial(&self) -> Self::State {
        ThermalState {
            inner: self.law.initial(),
            temperature: 0.0,
        }
    }

    /// At a temperature other than that at rest every particle has one.
    fn has_history(&self, state: &Self::State) -> bool {
        state.temperature != 0.0 || self.law.has_history(&state.inner)
    }

    fn without_history(&self, f: &Matrix3<f64>) -> Self::State {
        ThermalState {
            inner: self.law.without_history(f),
            temperature: 0.0,
        }
    }

    fn update(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError> {
        let (inner, stretch) = self.mechanical(increment, old)?;
        let response = self.law.update(&inner, &old.inner)?;
        let temperature = increment.external.temperature;
        Ok(Self::response(response, &stretch, temperature))
    }

    /// That of the law inside, where the expansion does not turn out of the sheet.
    fn plane_stress(
        &self,
        increment: &Increment,
        old: &Self::State,
        with_tangent: bool,
    ) -> Result<Option<SheetStep<Self::State>>, MaterialError> {
        if !matches!(self.expansion, Expansion::Isotropic(_)) {
            return Ok(None);
        }
        let (inner, stretch) = self.mechanical(&sheet::flat(increment), old)?;
        let Some(step) = self.law.plane_stress(&inner, &old.inner, with_tangent)? else {
            return Ok(None);
        };
        let [expansion, ..] = stretch.values;
        Ok(Some(SheetStep {
            response: Self::response(step.response, &stretch, increment.external.temperature),
            thickening: (1.0 + step.thickening) * expansion - 1.0,
            tangent: step.tangent,
        }))
    }

    fn tangent(&self, increment: &Increment, old: &Self::State) -> Result<Tangent, MaterialError> {
        let (inner, _) = self.mechanical(increment, old)?;
        self.law.tangent(&inner, &old.inner)
    }

    fn update_with_tangent(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<(Response<Self::State>, Tangent), MaterialError> {
        let (inner, stretch) = self.mechanical(increment, old)?;
        let (response, tangent) = self.law.update_with_tangent(&inner, &old.inner)?;
        let temperature = increment.external.temperature;
        Ok((Self::response(response, &stretch, temperature), tangent))
    }

    fn out_of_plane_stretch(&self, state: &Self::State) -> Option<f64> {
        let inner = self.law.out_of_plane_stretch(&state.inner)?;
        let stretch = self.expansion.stretch(state.temperature).ok()?;
        Some(inner * stretch.image(&Vector3::z()).z)
    }
}

/// As the law inside, whose reference configuration is the expanded one. Its failure function is
/// asked for stresses at the temperature at rest.
impl<M: Cracking> Cracking for Thermal<M> {
    hand_on_cracking!(law);

    fn critical_opening(&self, scale: &Scale) -> f64 {
        self.law.critical_opening(scale)
    }

    fn band_limit(&self, scale: &Scale) -> f64 {
        self.law.band_limit(scale)
    }

    fn failure_along(&self, stress: &Sym, normal: &Vector3<f64>, scale: &Scale) -> Option<f64> {
        self.law.failure_along(stress, normal, scale)
    }

    fn initiation(&self, stress: &Sym, scale: &Scale) -> Initiation {
        self.law.initiation(stress, scale)
    }

    /// Normals in the undeformed body: `F_θᵀ·n`, made unit.
    fn cracks(&self, state: &Self::State) -> Vec<Crack> {
        let mut cracks = self.law.cracks(&state.inner);
        if let Ok(stretch) = self.expansion.stretch(state.temperature)
            && stretch.axes.is_some()
        {
            for crack in &mut cracks {
                crack.normal = stretch.image(&crack.normal).normalize();
            }
        }
        cracks
    }
}

#[cfg(test)]
mod tests;
