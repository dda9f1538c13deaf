//! The law in plane stress, in closed form: the stiffness condensed by `T_zz = 0`.
//!
//! As in `AnisotropicDamage` (`anisotropic_damage/sheet.rs`): a crack across the sheet has no strain along z,
//! so `C_ab − C_az C_zb/C_zz` does in place of `C`, and `E_zz = S_z:T` with the compliance `S`. A plane across z
//! carries no traction and never starts. The spatial tangent has the further part `σ d_zz`,
//! `d_zz = S_z:Ṫ/F_zz`.

use fissure_tensor::{Sym, Tangent, Vector3, Vector6};

use super::OrthotropicDamage;
use crate::plane_stress::with_thickness;
use crate::{AnisotropicDamageState, Biot, Increment, MaterialError, SheetStep, Softening};

/// Mandel positions of zz, and of the shears out of the plane.
const ACROSS: usize = 2;
const OUT_OF_PLANE_SHEARS: [usize; 2] = [3, 4];

impl<const P: usize, N: Softening, T: Softening> OrthotropicDamage<P, N, T> {
    /// The law of the sheet; `None` where stress or a crack would lean out of the plane.
    fn sheet(&self) -> Option<Self> {
        let leans = |normal: &Vector3<f64>| normal.z != 0.0 && (normal.x != 0.0 || normal.y != 0.0);
        let c = &self.stiffness.0;
        let coupled = |shear: &usize| [0, 1, 2, 5].iter().any(|&i| c[(i, *shear)] != 0.0);
        if self.planes.iter().any(|plane| leans(&plane.normal))
            || OUT_OF_PLANE_SHEARS.iter().any(coupled)
        {
            return None;
        }
        let mut stiffness = c - c.column(ACROSS) * c.row(ACROSS) / c[(ACROSS, ACROSS)];
        stiffness.row_mut(ACROSS).fill(0.0);
        stiffness.column_mut(ACROSS).fill(0.0);
        Some(Self {
            stiffness: Tangent(stiffness),
            ..*self
        })
    }

    pub(super) fn in_sheet(
        &self,
        increment: &Increment,
        old: &AnisotropicDamageState,
        with_tangent: bool,
    ) -> Result<Option<SheetStep<AnisotropicDamageState>>, MaterialError> {
        let Some(sheet) = self.sheet() else {
            return Ok(None);
        };
        let flat = Increment {
            f_old: with_thickness(&increment.f_old, 0.0),
            f_new: with_thickness(&increment.f_new, 0.0),
            ..*increment
        };
        let kinematics = Biot::new(&flat.f_new)?;
        let step = sheet.step(&kinematics, &flat, old)?;
        let response = Self::response(&kinematics, &step, old);
        let compliance = self.compliance_across(flat.external.scale.stiffness);
        let thickening = compliance.dot(&step.biot_stress);
        if !(thickening > -1.0) {
            return Err(MaterialError::Deformation {
                determinant: flat.jacobian() * (1.0 + thickening),
            });
        }
        let tangent = with_tangent.then(|| {
            let rates = sheet.rates(&kinematics, &step, &flat);
            let thinning = Tangent::from_columns(|d| {
                let (strain_rate, rotation_rate) = kinematics.rates(d);
                let rate = compliance.dot(&rates(&strain_rate, &rotation_rate));
                response.stress * (rate / (1.0 + thickening))
            });
            kinematics.turned_tangent(&step.biot_stress, &rates) + thinning
        });
        Ok(Some(SheetStep {
            response,
            thickening,
            tangent,
        }))
    }

    /// `S_z`: strain along z of a stress, 1/Pa.
    fn compliance_across(&self, scale: f64) -> Sym {
        let mut unit = Vector6::zeros();
        unit[ACROSS] = 1.0 / scale;
        // The stiffness is positive definite.
        let solved = self.stiffness.0.lu().solve(&unit).unwrap_or(unit * 0.0);
        Sym {
            mandel: solved.into(),
        }
    }
}
