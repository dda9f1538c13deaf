//! A body's law, erased once per body: the particle loop inside is static.

use fissure_materials::{External, Increment, Material, MaterialError, Matrix3, Response, Scale};
use fissure_particles::{MotionSlices, MotionSlicesMut, ParticleId};
use fissure_tensor::{Band, Sym};

use crate::PersistError;
use crate::body::ParticleScale;
use crate::over_windows::{Cut, over_windows};
use crate::states::{Fresh, StateColumns, States};
use crate::sweep::{
    KernelFailure, Run, RunConstants, RunKernel, SweepCause, SweepFailure, SweepSettings,
    SweepTotals, Tangents, WindowKernel,
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
            states: self.states.columns(),
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

/// What a sweep over some windows came to: sums or a failure, and the first histories of particles.
struct Swept<S> {
    totals: Result<SweepTotals, SweepFailure>,
    fresh: Fresh<S>,
}

impl<S> Swept<S> {
    fn nothing() -> Self {
        Self {
            totals: Ok(SweepTotals::default()),
            fresh: Vec::new(),
        }
    }

    /// Of two sets of particles, the first of which come first.
    fn join(mut self, mut other: Self) -> Self {
        self.fresh.append(&mut other.fresh);
        Self {
            totals: SweepFailure::first(self.totals, other.totals),
            fresh: self.fresh,
        }
    }
}

fn scale_of(scale: Option<&[ParticleScale]>, index: usize) -> Scale {
    scale.map_or_else(Scale::default, |scale| scale[index].0)
}

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
                let totals = self.run(run, kernel, &mut part, &mut swept.fresh);
                if totals.is_ok() {
                    kernel.scatter(run, &constants, &part.old, &part.new.as_slices());
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

    /// Calls the law on each particle of a run.
    fn run(
        &self,
        run: &Run,
        kernel: &dyn WindowKernel<D>,
        part: &mut Part<'_, M, D>,
        fresh: &mut Fresh<M::State>,
    ) -> Result<SweepTotals, SweepFailure> {
        let Part {
            old,
            new,
            states,
            tangents,
        } = part;
        let first = run.start as usize;
        let mut totals = SweepTotals::default();
        let mut failure: Option<SweepFailure> = None;
        let asked = kernel.sets_external();
        for row in 0..old.len() {
            let index = first + row;
            let scale = scale_of(self.constants.scale, index);
            let set = if asked {
                kernel.external(run, row)
            } else {
                External::default()
            };
            let mut increment = Increment {
                f_old: old.deformation_gradient[row],
                f_new: new.deformation_gradient[row],
                dt: self.settings.dt,
                band: self.settings.band,
                external: External { scale, ..set },
            };
            let slot = states.slot(row);
            let blank;
            let state = match slot {
                Some(slot) => states.present(slot),
                None => {
                    blank = self.law.without_history(&increment.f_old);
                    &blank
                }
            };
            let answer = match tangents {
                Tangents::None => self.law.update(&increment, state),
                Tangents::Into(tangents) => {
                    self.law
                        .update_with_tangent(&increment, state)
                        .map(|(response, tangent)| {
                            tangents[row] = tangent;
                            response
                        })
                }
            };
            match answer.and_then(finite::<M>) {
                Ok(response) => {
                    let volume = self.constants.volume[index];
                    new.stress[row] = response.stress;
                    totals.stored += response.stored * volume;
                    totals.dissipated += response.dissipated * volume;
                    if let Some(stretch) = self.law.out_of_plane_stretch(&response.state) {
                        new.deformation_gradient[row].m33 = stretch;
                    }
                    let law = &self.law;
                    let speed = law.wave_speed(&increment.f_new, &response.state, &scale);
                    totals.wave_speed = totals.wave_speed.max(speed);
                    // The law may have set its own thickness.
                    increment.f_new.m33 = new.deformation_gradient[row].m33;
                    let sheet = law.out_of_plane_stretch(&response.state).is_some();
                    match slot {
                        Some(slot) => states.set_trial(slot, response.state),
                        None if law.has_history(&response.state) => {
                            fresh.push((index as u32, response.state));
                        }
                        None => {}
                    }
                    let (pressure, work) = self.viscous_pressure(&increment, speed, sheet);
                    if pressure > 0.0 {
                        let mut viscous = Sym::IDENTITY * pressure;
                        if sheet {
                            viscous.mandel[2] = 0.0;
                        }
                        new.stress[row] -= viscous;
                        totals.viscous += work * volume;
                    }
                }
                Err(source) => {
                    let cause = SweepCause::Law {
                        source,
                        deformation_gradient: Box::new(increment.f_new),
                        state: format!("{state:?}"),
                    };
                    let next = self.failure(index, cause);
                    if failure.as_ref().is_none_or(|failure| next.id < failure.id) {
                        failure = Some(next);
                    }
                }
            }
        }
        failure.map_or(Ok(totals), Err)
    }

    /// Artificial pressure, Pa, and its work per reference volume, J/m³; zero in expansion. In a
    /// `sheet` under plane stress no pressure acts across, so it is the area that counts.
    fn viscous_pressure(&self, increment: &Increment, wave_speed: f64, sheet: bool) -> (f64, f64) {
        let Some(viscosity) = self.settings.viscosity else {
            return (0.0, 0.0);
        };
        let jacobian = increment.jacobian();
        let (mut before, mut now, mut thickness) = (increment.f_old.determinant(), jacobian, 1.0);
        if sheet {
            thickness = increment.f_new.m33;
            before /= increment.f_old.m33;
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
