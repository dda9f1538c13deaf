//! The law in plane stress, in closed form.
//!
//! With the constants of a sheet (`elasticity.rs`) the in-plane strain gives the in-plane stress by the
//! same equations as in space, and `E_zz = αΔT − ν/E (T_xx + T_yy)`, since no crack has a strain along z.
//! As `σ = R·T·Rᵀ`, nothing else asks for the thickness. A search for it would have to follow the drop
//! of (34) and the switch between a plane in tension and one in shear.
//!
//! The spatial tangent is for `J` with the thickness: with the rate of the stress at a fixed one,
//! `c:d = c₀:d + σ d_zz`, `d_zz = −ν/E tr(Ṫ)/F_zz`, `tr(Ṫ) = tr(c₀:d) − tr(σ) tr(d) + 2 σ:d`.

use fissure_tensor::{Sym, Tangent};

use super::{AnisotropicDamage, AnisotropicDamageState};
use crate::plane_stress::with_thickness;
use crate::stress_measure::Turned;
use crate::{Biot, Increment, MaterialError, Onset, SheetStep, Softening};

impl<N: Softening, T: Softening> AnisotropicDamage<N, T> {
    /// The increment of a sheet of unit thickness; `None` where a crack may lean out of the plane.
    pub(super) fn flattened(&self, increment: &Increment) -> Option<Increment> {
        if let Onset::Prescribed(normal) = self.onset
            && normal.z != 0.0
        {
            return None;
        }
        Some(Increment {
            f_old: with_thickness(&increment.f_old, 0.0),
            f_new: with_thickness(&increment.f_new, 0.0),
            ..*increment
        })
    }

    /// `E_zz` of a stress.
    pub(super) fn thickening(&self, flat: &Increment, stress: &Sym) -> Result<f64, MaterialError> {
        let elastic = self.elastic.scaled(&flat.external.scale);
        let heat = self.thermal_expansion * flat.external.temperature;
        let thickening = heat - elastic.poisson / elastic.young * stress.trace();
        if thickening > -1.0 {
            return Ok(thickening);
        }
        Err(MaterialError::Deformation {
            determinant: flat.jacobian() * (1.0 + thickening),
        })
    }

    /// The tangent at this stress and thickening, from that at a fixed thickness.
    pub(super) fn thinned(
        &self,
        flat: &Increment,
        stress: &Sym,
        thickening: f64,
        fixed: &Tangent,
    ) -> Tangent {
        let elastic = self.elastic.scaled(&flat.external.scale);
        let per_trace = -elastic.poisson / elastic.young / (1.0 + thickening);
        thinned(fixed, stress, per_trace)
    }

    pub(super) fn in_sheet(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
        with_tangent: bool,
    ) -> Result<Option<SheetStep<AnisotropicDamageState>>, MaterialError> {
        let Some(flat) = self.flattened(increment) else {
            return Ok(None);
        };
        let sound = self.sound::<true>(&flat, old);
        if let (Some(response), false) = (&sound, with_tangent) {
            let thickening = self.thickening(&flat, &response.stress)?;
            return Ok(Some(SheetStep {
                response: *response,
                thickening,
                tangent: None,
            }));
        }
        let kinematics = Biot::new(&flat.f_new)?;
        let step = self.step::<true>(&kinematics, &flat, old)?;
        let response = sound.unwrap_or_else(|| self.response::<Turned>(&kinematics, &step, old));
        let thickening = self.thickening(&flat, &response.stress)?;
        let tangent = with_tangent.then(|| {
            let fixed = self.step_tangent::<true, Turned>(&kinematics, &step, &flat);
            self.thinned(&flat, &response.stress, thickening, &fixed)
        });
        Ok(Some(SheetStep {
            response,
            thickening,
            tangent,
        }))
    }
}

/// The tangent of a sheet whose thickness follows the trace of the stress.
pub(super) fn thinned(fixed: &Tangent, stress: &Sym, per_trace: f64) -> Tangent {
    *fixed
        + Tangent::from_columns(|d| {
            let convected = stress.trace() * d.trace() - 2.0 * stress.dot(d);
            *stress * (per_trace * (fixed.apply(d).trace() - convected))
        })
}
