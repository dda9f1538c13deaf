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
<<<<<<< HEAD

/// What all runs of a sweep share.
struct Sweep<'a, M: Material, const D: usize> {
    law: &'a M,
    constants: Constants<'a>,
    kernel: &'a dyn RunKernel<D>,
    settings: &'a SweepSettings,
}

/// The columns of some consecutive runs, cut out of the body's.
struct Part<'a, M: Material, const D: usize> {
    old: MotionSlices<'a, D>,
    new: MotionSlicesMut<'a, D>,
    states: StateColumns<'a, M>,
    tangents: Tangents<'a>,
}

impl<M: Material, const D: usize> Cut for Part<'_, M, D> {
    fn cut(self, row: usize) -> (Self, Self) {
        let (old_a, old_b) = self.old.split_at(row);
        let (new_a, new_b) = self.new.split_at(row);
        let (states_a, states_b) = self.states.cut(row);
        let (tangents_a, tangents_b) = self.tangents.split_at(row);
        (
            Self {
                old: old_a,
                new: new_a,
                states: states_a,
                tangents: tangents_a,
            },
            Self {
                old: old_b,
                new: new_b,
                states: states_b,
                tangents: tangents_b,
            },
        )
    }
}

impl<M: Material, const D: usize> Sweep<'_, M, D> {
    /// The runs of one window, one after another.
    fn window(&self, runs: &[Run], part: Part<'_, M, D>) -> Swept<M::State> {
        let mut swept = Swept::nothing();
        let mut rest = Some(part);
        let moved = self.kernel.on_window(runs[0].window, &mut |kernel| {
            for run in runs {
                let Some(part) = rest.take() else { continue };
                let (mut part, left) = part.cut(run.len());
                rest = Some(left);
                let constants = self.constants.of(run);
                let moved = kernel.gather(run, &constants, &part.old, &mut part.new);
                if let Err(failure) = moved {
                    let (old, new) = (&part.old, &mut part.new);
                    return Err(failure.lowest(kernel, run, &self.constants, old, new));
                }
                let mut totals = self.run(run, kernel, &mut part, &mut swept.fresh);
                if let Ok(totals) = &mut totals {
                    totals.work = kernel.scatter(run, &constants, &part.old, &part.new.as_slices());
                }
                let before = std::mem::replace(&mut swept.totals, Ok(SweepTotals::default()));
                swept.totals = SweepFailure::first(before, totals);
            }
            Ok(())
        });
        if let Err(KernelFailure { index }) = moved {
            swept.totals = Err(self.failure(index, SweepCause::Kernel));
        }
        swept
    }

    /// Calls the law on the particles of a run: by eights where it takes them so, else one by one.
    fn run(
        &self,
        run: &Run,
        kernel: &dyn WindowKernel<D>,
        part: &mut Part<'_, M, D>,
        fresh: &mut Fresh<M::State>,
    ) -> Result<SweepTotals, SweepFailure> {
        let first = run.start as usize;
        let mut totals = SweepTotals::default();
        let mut failure: Option<SweepFailure> = None;
        let asked = kernel.sets_external();
        let mut eights = ByEights::default();
        if !asked && matches!(part.tangents, Tangents::None) {
            self.settings.simd.run(AskByEights {
                law: self.law,
                scale: self.constants.scale.map(|scale| &scale[first..]),
                part,
                answers: &mut eights,
            });
        }
        for row in 0..part.old.len() {
            let index = first + row;
            let volume = self.constants.volume[index];
            let square = part.new.velocity[row].norm_squared();
            totals.kinetic += 0.5 * self.constants.mass[index] * square;
            totals.speed_squared = larger(totals.speed_squared, square);
            if eights.answered(row) {
                let (stored, speed) = (eights.stored[row], eights.wave_speed[row]);
                totals.stored += stored * volume;
                totals.wave_speed = larger(totals.wave_speed, speed);
                totals.viscous += self.add_viscosity(part, row, speed, false) * volume;
                continue;
            }
            let set = if asked {
                kernel.external(run, row)
            } else {
                External::default()
            };
            let scale = scale_of(self.constants.scale, index);
            match self.particle(row, index, External { scale, ..set }, part, fresh) {
                Ok(one) => {
                    totals.stored += one.stored * volume;
                    totals.dissipated += one.dissipated * volume;
                    totals.viscous += one.viscous * volume;
                    totals.wave_speed = totals.wave_speed.max(one.wave_speed);
                }
                Err(next) => {
                    if failure.as_ref().is_none_or(|failure| next.id < failure.id) {
                        failure = Some(next);
                    }
                }
            }
        }
        failure.map_or(Ok(totals), Err)
    }

    /// Calls the law on one particle; energies per reference volume.
    #[inline(always)]
    fn particle(
        &self,
        row: usize,
        index: usize,
        external: External,
        part: &mut Part<'_, M, D>,
        fresh: &mut Fresh<M::State>,
    ) -> Result<SweepTotals, SweepFailure> {
        let law = self.law;
        let increment = Increment {
            f_old: part.old.deformation_gradient[row],
            f_new: part.new.deformation_gradient[row],
            dt: self.settings.dt,
            band: self.settings.band,
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

    fn failure(&self, index: usize, cause: SweepCause) -> SweepFailure {
        SweepFailure {
            id: self.constants.id[index],
            index,
            cause,
        }
    }
}

/// What a law answered for the particles of a run by eights; their stresses are in the trial.
struct ByEights {
    /// A bit for each eight.
    answered: u8,
    stored: [f64; Run::MAX],
    wave_speed: [f64; Run::MAX],
}

impl Default for ByEights {
    fn default() -> Self {
        Self {
            answered: 0,
            stored: [0.0; Run::MAX],
            wave_speed: [0.0; Run::MAX],
        }
    }
}

impl ByEights {
    #[inline(always)]
    fn answered(&self, row: usize) -> bool {
        // A run of another solver may be longer.
        row < Run::MAX && self.answered >> (row / EIGHT) & 1 == 1
    }
}

/// Asks a law for the eights of a run that have no history.
struct AskByEights<'a, 'p, M: Material, const D: usize> {
    law: &'a M,
    /// Of the run's particles on.
    scale: Option<&'a [ParticleScale]>,
    part: &'a mut Part<'p, M, D>,
    answers: &'a mut ByEights,
}

impl<M: Material, const D: usize> SimdTask for AskByEights<'_, '_, M, D> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, _lanes: L) {
        let answers = self.answers;
        let Part { new, states, .. } = self.part;
        let count = new.len().min(Run::MAX);
        // All are brought into columns first: what has just been written number by number cannot be read by eights.
        let mut points = [EightPoints::of(&Matrix3::identity()); Run::MAX / EIGHT];
        for (row, f) in new.deformation_gradient.iter().enumerate().take(count) {
            let points = &mut points[row / EIGHT];
            points.set(row % EIGHT, f);
            if let Some(scale) = self.scale {
                points.stiffness[row % EIGHT] = scale[row].0.stiffness;
                points.strength[row % EIGHT] = scale[row].0.strength;
            }
        }
        for (first, points) in (0..count).step_by(EIGHT).zip(&points) {
            let rows = first..(first + EIGHT).min(count);
            let no_state = size_of::<M::State>() == 0;
            if !no_state && rows.clone().any(|row| states.slot(row).is_some()) {
                continue;
            }
            let Some(responses) = self.law.update_eight(points) else {
                continue;
            };
            if !responses.is_finite() {
                continue;
            }
            answers.answered |= 1 << (first / EIGHT);
            for row in rows {
                new.stress[row] = responses.stress(row - first);
            }
            answers.stored[first..first + EIGHT].copy_from_slice(&responses.stored);
            answers.wave_speed[first..first + EIGHT].copy_from_slice(&responses.wave_speed);
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
=======
>>>>>>> speed
