//! Elastic laws that are formulas: written once, asked one by one and by eights.

use fissure_tensor::{Matrix3, Sym};

use crate::finite_strain::{keeps_orientation, rows};
use crate::isotropic::check_deformation;
use crate::{
    EIGHT, EightPoints, EightResponses, Increment, Material, MaterialError, Response, Scale,
    check_parameter,
};

/// An elastic law whose stress follows from the deformation gradient by formulas, the same for every point.
/// [`Hyperelastic`] makes a [`Material`] of it.
///
/// ```
/// use fissure_materials::{Formula, FormulaAnswer, Hyperelastic, MaterialError, contract};
/// use fissure_tensor::Sym;
///
/// /// Gas: ψ = p₀ (J − 1 − ln J), σ = p₀ (1 − 1/J) 1; waves of speed √(p₀/ρ₀).
/// struct Gas {
///     density: f64,
///     pressure: f64,
/// }
///
/// impl Formula for Gas {
///     fn density(&self) -> f64 {
///         self.density
///     }
///     #[inline(always)]
///     fn answer(&self, [xx, xy, xz, yx, yy, yz, zx, zy, zz]: [f64; 9], stiffness: f64) -> FormulaAnswer {
///         let j = xx * (yy * zz - yz * zy) - xy * (yx * zz - yz * zx) + xz * (yx * zy - yy * zx);
///         let pressure = self.pressure * stiffness;
///         FormulaAnswer {
///             stress: Sym::IDENTITY * (pressure * (1.0 - 1.0 / j)),
///             stored: pressure * (j - 1.0 - j.ln()),
///             wave_speed: (pressure / self.density).sqrt(),
///         }
///     }
/// }
///
/// let gas = Hyperelastic(Gas { density: 1.2, pressure: 1e5 });
/// contract::check(&gas).map(|summary| println!("{summary}"))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Formula {
    /// Mass density at rest, kg/m³.
    fn density(&self) -> f64;

    /// Checks the parameters; by default the density alone.
    ///
    /// # Errors
    /// The parameter, its value and the permitted range.
    fn check(&self) -> Result<(), MaterialError> {
        let density = self.density();
        check_parameter("formula", "density", density, density > 0.0, "> 0")
    }

    /// Whether the law is the same in all directions, as [`Material::isotropic`].
    fn isotropic(&self) -> bool {
        true
    }

    /// What the law answers at a deformation gradient, row by row, where its moduli are `stiffness` times the usual ones. That
    /// the determinant is positive and finite is asked beside it.
    ///
    /// To run on a vector unit it must be `#[inline(always)]` with what it calls, and have no branches but choices between
    /// two numbers. With a call in it (a logarithm, a power) it is right, and slower.
    fn answer(&self, f: [f64; 9], stiffness: f64) -> FormulaAnswer;
}

/// What a [`Formula`] answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormulaAnswer {
    /// Cauchy stress, Pa.
    pub stress: Sym,
    /// Stored energy, J per reference m³.
    pub stored: f64,
    /// Speed of the fastest wave in the present configuration, from above, m/s.
    pub wave_speed: f64,
}

/// The law of a [`Formula`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hyperelastic<F>(pub F);

impl<F: Formula + Send + Sync + 'static> Material for Hyperelastic<F> {
    type State = ();
    const STRESS_FROM_GRADIENT: bool = true;

    fn check(&self) -> Result<(), MaterialError> {
        self.0.check()
    }

    fn isotropic(&self) -> bool {
        self.0.isotropic()
    }

    fn density(&self) -> f64 {
        self.0.density()
    }

    #[inline(always)]
    fn wave_speed(&self, f: &Matrix3<f64>, _: &(), scale: &Scale) -> f64 {
        self.0.answer(rows(f), scale.stiffness).wave_speed
    }

    #[inline(always)] // A call would copy the increment.
    fn update(&self, increment: &Increment, _: &()) -> Result<Response<()>, MaterialError> {
        check_deformation(increment)?;
        let stiffness = increment.external.scale.stiffness;
        let answer = self.0.answer(rows(&increment.f_new), stiffness);
        Ok(Response {
            stress: answer.stress,
            state: (),
            stored: answer.stored,
            dissipated: 0.0,
        })
    }

    #[inline(always)]
    fn update_eight(&self, points: &EightPoints) -> Option<EightResponses> {
        let mut responses = EightResponses::default();
        let mut all_sound = true;
        for place in 0..EIGHT {
            let f = points.gradient(place);
            let answer = self.0.answer(f, points.stiffness[place]);
            all_sound &= keeps_orientation(f);
            responses.set(place, &answer.stress, answer.stored, answer.wave_speed);
        }
        all_sound.then_some(responses)
    }
}
