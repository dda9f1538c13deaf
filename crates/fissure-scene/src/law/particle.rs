//! The law asked for one particle, and artificial viscosity.

use fissure_materials::{External, Increment, Material, MaterialError, Matrix3, Response};
use fissure_tensor::{Band, Sym};

use super::windows::{Part, Sweep};
use crate::states::Fresh;
use crate::sweep::{SweepCause, SweepFailure, SweepTotals, Tangents, Viscosity};

impl<M: Material, const D: usize> Sweep<'_, M, D> {
    /// Calls the law on one particle; energies per reference volume.
    #[inline(always)]
    pub(super) fn particle(
        &self,
        row: usize,
        index: usize,
        external: External,
        band: Band,
        part: &mut Part<'_, M, D>,
        fresh: &mut Fresh<M::State>,
    ) -> Result<SweepTotals, SweepFailure> {
        let law = self.law;
        let increment = Increment {
            f_old: part.old.deformation_gradient[row],
            f_new: part.new.deformation_gradient[row],
            dt: self.settings.dt,
            band,
            external,
        };
        let slot = part.states.slot(row);
        let blank;
        let state = match slot {
            Some(slot) => part.states.present(slot),
            None => {
                blank = law.without_history(&increment.f_old);
                &blank
            }
        };
        let answer = match &mut part.tangents {
            Tangents::None => law.update(&increment, state),
            Tangents::Into(tangents) => {
                law.update_with_tangent(&increment, state)
                    .map(|(response, tangent)| {
                        tangents[row] = tangent;
                        response
                    })
            }
        };
        let response = match answer.and_then(finite::<M>) {
            Ok(response) => response,
            Err(source) => {
                let cause = SweepCause::Law {
                    source,
                    deformation_gradient: Box::new(increment.f_new),
                    state: format!("{state:?}"),
                };
                return Err(self.failure(index, cause));
            }
        };
        if self.settings.in_place
            && let Some(slot) = slot
        {
            part.states.keep_stress(slot, part.new.stress[row]);
        }
        part.new.stress[row] = response.stress;
        let stretch = law.out_of_plane_stretch(&response.state);
        if let Some(stretch) = stretch {
            part.new.deformation_gradient[row].m33 = stretch;
        }
        let wave_speed = law.wave_speed(&increment.f_new, &response.state, &external.scale);
        match slot {
            Some(slot) => part.states.set_trial(slot, response.state),
            None if law.has_history(&response.state) => {
                fresh.push((index as u32, response.state));
            }
            None => {}
        }
        Ok(SweepTotals {
            stored: response.stored,
            dissipated: response.dissipated,
            viscous: self.add_viscosity(part, row, wave_speed, stretch.is_some()),
            wave_speed,
            ..SweepTotals::default()
        })
    }

    /// Takes artificial pressure off the stress of a row; its work per reference volume, J/m³. In a
    /// `sheet` none acts across.
    #[inline(always)]
    fn add_viscosity(
        &self,
        part: &mut Part<'_, M, D>,
        row: usize,
        wave_speed: f64,
        sheet: bool,
    ) -> f64 {
        let Some(viscosity) = &self.settings.viscosity else {
            return 0.0;
        };
        let old = &part.old.deformation_gradient[row];
        let new = &part.new.deformation_gradient[row];
        let (pressure, work) = self.viscous_pressure(viscosity, old, new, wave_speed, sheet);
        if pressure > 0.0 {
            let mut viscous = Sym::IDENTITY * pressure;
            if sheet {
                viscous.mandel[2] = 0.0;
            }
            part.new.stress[row] -= viscous;
            return work;
        }
        0.0
    }

    /// Artificial pressure, Pa, and its work per reference volume, J/m³; zero in expansion. In a
    /// `sheet` under plane stress no pressure acts across, so it is the area that counts.
    fn viscous_pressure(
        &self,
        viscosity: &Viscosity,
        f_old: &Matrix3<f64>,
        f_new: &Matrix3<f64>,
        wave_speed: f64,
        sheet: bool,
    ) -> (f64, f64) {
        let jacobian = f_new.determinant();
        let (mut before, mut now, mut thickness) = (f_old.determinant(), jacobian, 1.0);
        if sheet {
            thickness = f_new.m33;
            before /= f_old.m33;
            now /= thickness;
        }
        let rate = (before - now) / (now * self.settings.dt);
        if rate <= 0.0 {
            return (0.0, 0.0);
        }
        let speed = rate * viscosity.length;
        let density = self.constants.density / jacobian;
        let pressure =
            density * speed * (viscosity.linear * wave_speed + viscosity.quadratic * speed);
        (pressure, pressure * (before - now) * thickness)
    }

    pub(super) fn failure(&self, index: usize, cause: SweepCause) -> SweepFailure {
        SweepFailure {
            id: self.constants.id[index],
            index,
            cause,
        }
    }
}

/// A law must not hand over NaN in silence.
fn finite<M: Material>(response: Response<M::State>) -> Result<Response<M::State>, MaterialError> {
    let energies = response.stored + response.dissipated;
    if response.stress.is_finite() && energies.is_finite() {
        Ok(response)
    } else {
        let law = std::any::type_name::<M>();
        Err(MaterialError::NotFinite { law })
    }
}
