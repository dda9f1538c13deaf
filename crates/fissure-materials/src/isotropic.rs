//! Isotropic linear elasticity at small strain: `σ = λ tr(ε) 1 + 2μ ε`, `ε = sym(F) − 1`.

use std::f64::consts::FRAC_1_SQRT_2;

use fissure_tensor::{Matrix3, Sym, Tangent};

use crate::finite_strain::keeps_orientation;
use crate::{
    EIGHT, EightPoints, EightResponses, Increment, Material, MaterialError, Response, Scale,
    SheetStep, check_parameter,
    sheet::{checked, flat},
};

/// Isotropic elastic constants, and the small-strain law of that name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isotropic {
    /// Reference mass density ρ, kg/m³; > 0.
    pub density: f64,
    /// Young's modulus E, Pa; > 0.
    pub young: f64,
    /// Poisson's ratio ν; in (−1, 0.5).
    pub poisson: f64,
}

impl Isotropic {
    /// Lamé's first constant λ, Pa.
    #[inline(always)]
    pub fn lambda(&self) -> f64 {
        self.young * self.poisson / ((1.0 + self.poisson) * (1.0 - 2.0 * self.poisson))
    }

    /// Shear modulus μ, Pa.
    #[inline(always)]
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.young / (1.0 + self.poisson)
    }

    /// Bulk modulus K, Pa.
    pub fn bulk_modulus(&self) -> f64 {
        self.young / (3.0 * (1.0 - 2.0 * self.poisson))
    }

    /// `λ + 2μ`, Pa.
    #[inline(always)]
    pub fn p_wave_modulus(&self) -> f64 {
        self.lambda() + 2.0 * self.shear_modulus()
    }

    /// Speed of dilatational waves, m/s.
    #[inline(always)]
    pub fn p_wave_speed(&self) -> f64 {
        (self.p_wave_modulus() / self.density).sqrt()
    }

    /// `λ tr(ε) 1 + 2μ ε`, Pa.
    #[inline(always)]
    pub fn stress(&self, strain: &Sym) -> Sym {
        Sym::IDENTITY * (self.lambda() * strain.trace()) + *strain * (2.0 * self.shear_modulus())
    }

    /// The elasticity tensor, Pa.
    pub fn stiffness(&self) -> Tangent {
        Tangent::isotropic(self.lambda(), self.shear_modulus())
    }

    /// The same constants with the stiffness scaled.
    #[inline]
    pub fn scaled(&self, scale: &Scale) -> Self {
        Self {
            young: self.young * scale.stiffness,
            ..*self
        }
    }

    /// Refuses constants outside their range, in the name of `law`.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`].
    pub fn check_for(&self, law: &'static str) -> Result<(), MaterialError> {
        let (density, young, poisson) = (self.density, self.young, self.poisson);
        check_parameter(law, "density", density, density > 0.0, "finite and > 0")?;
        check_parameter(law, "young", young, young > 0.0, "finite and > 0")?;
        check_parameter(
            law,
            "poisson",
            poisson,
            poisson > -1.0 && poisson < 0.5,
            "in (-1, 0.5)",
        )
    }
}

impl Material for Isotropic {
    type State = ();
    const STRESS_FROM_GRADIENT: bool = true;
    const OBJECTIVE: bool = false;
    const HYPERELASTIC: bool = false;
    const STEP_ERROR: f64 = 0.0;

    fn check(&self) -> Result<(), MaterialError> {
        self.check_for("isotropic elasticity")
    }

    fn density(&self) -> f64 {
        self.density
    }

    fn wave_speed(&self, _f: &Matrix3<f64>, _state: &(), scale: &Scale) -> f64 {
        self.scaled(scale).p_wave_speed()
    }

    #[inline]
    fn update(&self, increment: &Increment, _old: &()) -> Result<Response<()>, MaterialError> {
        check_deformation(increment)?;
        let strain = increment.small_strain();
        let stress = self.scaled(&increment.external.scale).stress(&strain);
        Ok(Response {
            stress,
            state: (),
            stored: 0.5 * stress.dot(&strain),
            dissipated: 0.0,
        })
    }

    #[inline(always)]
    fn update_eight(&self, points: &EightPoints) -> Option<EightResponses> {
        let mut responses = EightResponses::default();
        let mut all_sound = true;
        for place in 0..EIGHT {
            let f = points.gradient(place);
            all_sound &= keeps_orientation(f);
            let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = f;
            let strain = Sym {
                mandel: [
                    xx - 1.0,
                    yy - 1.0,
                    zz - 1.0,
                    FRAC_1_SQRT_2 * (yz + zy),
                    FRAC_1_SQRT_2 * (xz + zx),
                    FRAC_1_SQRT_2 * (xy + yx),
                ],
            };
            let elastic = Self {
                young: self.young * points.stiffness[place],
                ..*self
            };
            let stress = elastic.stress(&strain);
            let stored = 0.5 * stress.dot(&strain);
            responses.set(place, &stress, stored, elastic.p_wave_speed());
        }
        all_sound.then_some(responses)
    }

    fn tangent(&self, increment: &Increment, _old: &()) -> Result<Tangent, MaterialError> {
        check_deformation(increment)?;
        let elastic = self.scaled(&increment.external.scale);
        let stress = elastic.stress(&increment.small_strain());
        let stress_matrix = stress.to_matrix();
        Ok(Tangent::from_columns(|d| {
            let d_matrix = d.to_matrix();
            let strain_rate = Sym::from_matrix(&(d_matrix * increment.f_new));
            // δτ/J = δσ + tr(d) σ; the Truesdell rate takes dσ + σd off.
            elastic.stress(&strain_rate) + stress * d.trace()
                - Sym::from_matrix(&(d_matrix * stress_matrix)) * 2.0
        }))
    }

    /// As in `sheet.rs`, but for Cauchy's stress, which sees no thickness; its Truesdell rate does.
    fn plane_stress(
        &self,
        increment: &Increment,
        old: &(),
        with_tangent: bool,
    ) -> Result<Option<SheetStep<()>>, MaterialError> {
        let flat = flat(increment);
        let law = self.sheet();
        let response = law.update(&flat, old)?;
        let elastic = law.scaled(&flat.external.scale);
        let per_stress = -0.5 / elastic.shear_modulus();
        let thickening = checked(&flat, response.stress.zz() * per_stress)?;
        let tangent = if with_tangent {
            let fixed = law.tangent(&flat, old)?;
            let thinning = Tangent::from_columns(|d| {
                let strain_rate = Sym::from_matrix(&(d.to_matrix() * flat.f_new));
                let rate = elastic.lambda() * strain_rate.trace() * per_stress;
                response.stress * (rate / (1.0 + thickening))
            });
            Some(fixed + thinning)
        } else {
            None
        };
        Ok(Some(SheetStep {
            response,
            thickening,
            tangent,
        }))
    }
}

/// A NaN would otherwise pass through the linear law unseen.
#[inline]
pub(crate) fn check_deformation(increment: &Increment) -> Result<(), MaterialError> {
    let determinant = increment.jacobian();
    if determinant > 0.0 && determinant.is_finite() {
        Ok(())
    } else {
        Err(MaterialError::Deformation { determinant })
    }
}
