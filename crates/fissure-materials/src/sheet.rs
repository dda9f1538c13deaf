//! Plane stress in closed form, for isotropic laws whose cracks stand across the sheet.
//!
//! With `T = λ tr(Eᵉ) 1 + 2μ Eᵉ`, `Eᵉ = E − Σ cracks` and no crack strain along z, `T_zz = 0` gives
//! `E_zz = −λ/(λ+2μ) (Eᵉ_xx + Eᵉ_yy)`, and the in-plane stress is that of *plane strain* with the constants
//! of the sheet, `λ' = 2λμ/(λ+2μ)` and the same `μ`  (1). So the law itself, with those constants and at
//! a thickness that stays, does the step; the `T_zz` that it would need for that tells the thickening,
//! `E_zz = −T_zz/(2μ)`  (2). The same holds between Kirchhoff's stress and the logarithmic strain.
//!
//! Kirchhoff's stress in the plane does not see the thickness, so Cauchy's is that at a fixed one over
//! `F_zz`, and so is the spatial tangent for a `J` that goes with the thickness  (3).
//!
//! In a tension that starts a crack the fictitious `T_zz = λ'/(2(λ'+μ)) (T_xx + T_yy)` is below the
//! largest stress in the plane while ν ≥ 0.

use fissure_tensor::Tangent;

use crate::plane_stress::with_thickness;
use crate::{Increment, Isotropic, Material, MaterialError, Response, SheetStep};

/// The strain that goes with the stress of (2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Thickening {
    /// Biot's, `F_zz − 1`.
    Stretch,
    /// `ln F_zz`.
    Logarithm,
}

impl Isotropic {
    /// The constants of the sheet (1).
    pub(crate) fn sheet(&self) -> Self {
        let wider = 1.0 + self.poisson;
        Self {
            young: self.young * (1.0 + 2.0 * self.poisson) / (wider * wider),
            poisson: self.poisson / wider,
            ..*self
        }
    }
}

/// The increment of a sheet whose thickness stays.
pub(crate) fn flat(increment: &Increment) -> Increment {
    Increment {
        f_old: with_thickness(&increment.f_old, 0.0),
        f_new: with_thickness(&increment.f_new, 0.0),
        ..*increment
    }
}

/// A step of the law with the constants of the sheet; `solid` are the others.
pub(crate) fn in_sheet<M: Material>(
    law: &M,
    solid: &Isotropic,
    measure: Thickening,
    increment: &Increment,
    old: &M::State,
    with_tangent: bool,
) -> Result<SheetStep<M::State>, MaterialError> {
    let flat = flat(increment);
    let (response, tangent) = if with_tangent {
        let (response, tangent) = law.update_with_tangent(&flat, old)?;
        (response, Some(tangent))
    } else {
        (law.update(&flat, old)?, None)
    };
    thinned(&flat, response, tangent, solid, measure)
}

/// From a fixed thickness to that of no stress, (2) and (3).
pub(crate) fn thinned<S>(
    flat: &Increment,
    response: Response<S>,
    tangent: Option<Tangent>,
    solid: &Isotropic,
    measure: Thickening,
) -> Result<SheetStep<S>, MaterialError> {
    let shear = solid.scaled(&flat.external.scale).shear_modulus();
    let strain = -flat.jacobian() * response.stress.zz() / (2.0 * shear);
    let thickening = match measure {
        Thickening::Stretch => strain,
        Thickening::Logarithm => strain.exp_m1(),
    };
    let per_stretch = 1.0 / (1.0 + checked(flat, thickening)?);
    Ok(SheetStep {
        response: Response {
            stress: response.stress * per_stretch,
            ..response
        },
        thickening,
        tangent: tangent.map(|tangent| tangent * per_stretch),
    })
}

/// The thickening, if some thickness is left.
pub(crate) fn checked(flat: &Increment, thickening: f64) -> Result<f64, MaterialError> {
    let determinant = flat.jacobian() * (1.0 + thickening);
    if determinant > 0.0 && determinant.is_finite() {
        Ok(thickening)
    } else {
        Err(MaterialError::Deformation { determinant })
    }
}
