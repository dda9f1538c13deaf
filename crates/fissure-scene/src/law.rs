//! A body's law, erased once per body: the particle loop inside is static.

mod eights;
mod particle;
mod windows;

use fissure_materials::{External, Increment, Material, MaterialError, Matrix3, Scale};
use fissure_particles::{MotionSlices, MotionSlicesMut, ParticleId};
use fissure_tensor::{Band, Sym};

use self::windows::{Part, Sweep, Swept};
use crate::PersistError;
use crate::body::ParticleScale;
use crate::over_windows::{Cut, over_windows};
use crate::states::States;
use crate::sweep::{
    Run, RunConstants, RunKernel, SweepFailure, SweepSettings, SweepTotals, Tangents,
};

/// Columns of a body that a sweep reads besides the motion.
#[derive(Clone, Copy)]
pub(crate) struct Constants<'a> {
    pub id: &'a [ParticleId],
    pub mass: &'a [f64],
    pub volume: &'a [f64],
    pub density: f64,
    pub scale: Option<&'a [ParticleScale]>,
}

impl<'a> Constants<'a> {
    pub(crate) fn of(&self, run: &Run) -> RunConstants<'a> {
        let rows = run.start as usize..run.end as usize;
        RunConstants {
            mass: &self.mass[rows.clone()],
            volume: &self.volume[rows],
        }
    }
}

/// What a body asks of its law, whatever the law's type.
pub trait BodyLaw: Send + Sync {
    /// Names of the values that the law's state can show.
    fn names(&self) -> &'static [&'static str];
    /// One of those values of each particle, in the order of the columns, from their present
    /// deformation gradients.
    fn values(&self, value: usize, deformation_gradient: &[Matrix3<f64>]) -> Vec<f64>;
    /// Reference mass density, kg/m³.
    fn density(&self) -> f64;
    /// Refuses a band for which the response would not be unique.
    ///
    /// # Errors
    /// [`MaterialError::Band`].
    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError>;
    /// The states as bytes.
    ///
    /// # Errors
    /// A state that does not encode.
    fn save(&self) -> Result<Vec<u8>, postcard::Error>;
    /// Puts saved states back; `section` names them in errors.
    ///
    /// # Errors
    /// Bytes that do not decode, or another number of states than there are particles.
    fn restore(&mut self, bytes: &[u8], section: &str) -> Result<(), PersistError>;
}

/// The part of an erased law that only this crate calls.
pub(crate) trait SweepLaw<const D: usize>: BodyLaw {
    fn as_body_law(&self) -> &dyn BodyLaw;
    fn grow(&mut self, count: usize);
    fn reorder(&mut self, order: &[u32]);
    fn commit(&mut self);
    /// Whether stresses of points without a history can be made again.
    fn stress_from_gradient(&self) -> bool;
    /// Makes the stresses again that a sweep in place has written over, at these deformation gradients.
    fn restore_stress(
        &mut self,
        deformation_gradient: &[Matrix3<f64>],
        scale: Option<&[ParticleScale]>,
        stress: &mut [Sym],
    ) -> Result<(), MaterialError>;
    /// Forgets what the sweeps of a failed step have put aside.
    fn forget(&mut self);
    fn wave_speed(&self, motion: &MotionSlices<'_, D>, constants: &Constants<'_>) -> f64;
    #[allow(clippy::too_many_arguments)] // The columns are borrowed apart so that they split.
    fn sweep(
        &mut self,
        runs: &[Run],
        old: MotionSlices<'_, D>,
        new: MotionSlicesMut<'_, D>,
        constants: Constants<'_>,
        kernel: &dyn RunKernel<D>,
        settings: &SweepSettings,
        tangents: Tangents<'_>,
    ) -> Result<SweepTotals, SweepFailure>;
}

/// A law and the present and trial states of its particles.
pub(crate) struct TypedLaw<M: Material> {
    law: M,
    states: States<M>,
}

impl<M: Material> TypedLaw<M> {
    pub(crate) fn new(law: M) -> Self {
        Self {
            law,
            states: States::default(),
        }
    }
}

impl<M: Material> BodyLaw for TypedLaw<M> {
    fn names(&self) -> &'static [&'static str] {
        M::NAMES
    }

    fn values(&self, value: usize, deformation_gradient: &[Matrix3<f64>]) -> Vec<f64> {
        let mut row = vec![f64::NAN; M::NAMES.len()];
        let pick = |(i, f)| {
            let state = self.states.get(&self.law, i, f);
            self.law.values(&state, &mut row);
            row.get(value).copied().unwrap_or(f64::NAN)
        };
        deformation_gradient.iter().enumerate().map(pick).collect()
    }

    fn density(&self) -> f64 {
        self.law.density()
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.law.check_band(band, scale)
    }

    fn save(&self) -> Result<Vec<u8>, postcard::Error> {
        self.states.save()
    }

    fn restore(&mut self, bytes: &[u8], section: &str) -> Result<(), PersistError> {
        self.states.restore(bytes, section)
    }
}

impl<M: Material, const D: usize> SweepLaw<D> for TypedLaw<M> {
    fn as_body_law(&self) -> &dyn BodyLaw {
        self
    }

    fn grow(&mut self, count: usize) {
        self.states.grow(&self.law, count);
    }

    fn reorder(&mut self, order: &[u32]) {
        self.states.reorder(order);
    }

    fn commit(&mut self) {
        self.states.commit();
    }

    fn stress_from_gradient(&self) -> bool {
        M::STRESS_FROM_GRADIENT
    }

    fn restore_stress(
        &mut self,
        deformation_gradient: &[Matrix3<f64>],
        scale: Option<&[ParticleScale]>,
        stress: &mut [Sym],
    ) -> Result<(), MaterialError> {
        for (row, (f, stress)) in deformation_gradient.iter().zip(stress).enumerate() {
            if let Some(slot) = self.states.slot(row) {
                // None if the sweep had not come this far.
                *stress = self.states.overwritten(slot).unwrap_or(*stress);
                continue;
            }
            let scale = scale_of(scale, row);
            let external = External {
                scale,
                ..External::default()
            };
            let still = Increment {
                f_old: *f,
                external,
                ..Increment::to(*f)
            };
            *stress = self
                .law
                .update(&still, &self.law.without_history(f))?
                .stress;
        }
        Ok(())
    }

    fn forget(&mut self) {
        self.states.forget();
        self.states.forget_stresses();
    }

    fn wave_speed(&self, motion: &MotionSlices<'_, D>, constants: &Constants<'_>) -> f64 {
        let mut fastest: f64 = 0.0;
        for (i, f) in motion.deformation_gradient.iter().enumerate() {
            let state = self.states.get(&self.law, i, f);
            let scale = scale_of(constants.scale, i);
            fastest = fastest.max(self.law.wave_speed(f, &state, &scale));
        }
        fastest
    }

    fn sweep(
        &mut self,
        runs: &[Run],
        old: MotionSlices<'_, D>,
        new: MotionSlicesMut<'_, D>,
        constants: Constants<'_>,
        kernel: &dyn RunKernel<D>,
        settings: &SweepSettings,
        tangents: Tangents<'_>,
    ) -> Result<SweepTotals, SweepFailure> {
        let sweep = Sweep {
            law: &self.law,
            constants,
            kernel,
            settings,
        };
        let part = Part {
            old,
            new,
            states: self.states.columns(settings.in_place),
            tangents,
        };
        let (Some(first), Some(last)) = (runs.first(), runs.last()) else {
            return Ok(SweepTotals::default());
        };
        // The runs may be those of a part of the body.
        let (part, _) = part.cut(last.end as usize);
        let (_, part) = part.cut(first.start as usize);
        let leaf = |runs: &[Run], part| sweep.window(runs, part);
        let swept = over_windows(runs, part, &leaf, &Swept::join).unwrap_or_else(Swept::nothing);
        match swept {
            Swept {
                totals: Ok(totals),
                fresh,
            } => {
                self.states.put_aside(runs, fresh);
                Ok(totals)
            }
            Swept {
                totals: Err(failure),
                ..
            } => {
                self.states.forget();
                Err(failure)
            }
        }
    }
}

fn scale_of(scale: Option<&[ParticleScale]>, index: usize) -> Scale {
    scale.map_or_else(Scale::default, |scale| scale[index].0)
}
