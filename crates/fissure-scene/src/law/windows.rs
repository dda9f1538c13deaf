//! A sweep over the windows of a body: gather, law, scatter, run by run.

use fissure_materials::{External, Material};
use fissure_particles::{MotionSlices, MotionSlicesMut};
use nalgebra::SVector;

use super::eights::{AskByEights, ByEights, Kinetic};
use super::{Constants, scale_of};
use crate::over_windows::Cut;
use crate::states::{Fresh, StateColumns};
use crate::sweep::{
    KernelFailure, Run, RunKernel, SweepCause, SweepFailure, SweepSettings, SweepTotals, Tangents,
    WindowKernel,
};

/// What a sweep over some windows came to: sums or a failure, and the first histories of particles.
pub(super) struct Swept<S> {
    pub totals: Result<SweepTotals, SweepFailure>,
    pub fresh: Fresh<S>,
}

impl<S> Swept<S> {
    pub(super) fn nothing() -> Self {
        Self {
            totals: Ok(SweepTotals::default()),
            fresh: Vec::new(),
        }
    }

    /// Of two sets of particles, the first of which come first.
    pub(super) fn join(mut self, mut other: Self) -> Self {
        self.fresh.append(&mut other.fresh);
        Self {
            totals: SweepFailure::first(self.totals, other.totals),
            fresh: self.fresh,
        }
    }
}

/// What all runs of a sweep share.
pub(super) struct Sweep<'a, M: Material, const D: usize> {
    pub law: &'a M,
    pub constants: Constants<'a>,
    pub kernel: &'a dyn RunKernel<D>,
    pub settings: &'a SweepSettings,
}

/// The columns of some consecutive runs, cut out of the body's.
pub(super) struct Part<'a, M: Material, const D: usize> {
    pub old: MotionSlices<'a, D>,
    pub new: MotionSlicesMut<'a, D>,
    pub states: StateColumns<'a, M>,
    pub tangents: Tangents<'a>,
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
    pub(super) fn window(&self, runs: &[Run], part: Part<'_, M, D>) -> Swept<M::State> {
        let mut swept = Swept::nothing();
        let mut rest = Some(part);
        let mut places = [SVector::zeros(); Run::MAX];
        let moved = self.kernel.on_window(runs[0].window, &mut |kernel| {
            for run in runs {
                let Some(part) = rest.take() else { continue };
                let (mut part, left) = part.cut(run.len());
                rest = Some(left);
                if self.settings.in_place {
                    // The positions of the step before are kept; the new ones follow from the velocities.
                    part.new.position = &mut places[..run.len()];
                }
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
        let mut failure: Option<SweepFailure> = None;
        let asked = kernel.sets_external();
        let mut eights = ByEights::default();
        // Artificial viscosity adds to the stress of each by itself.
        let alone = asked || self.settings.viscosity.is_some();
        if !alone && matches!(part.tangents, Tangents::None) {
            self.settings.simd.run(AskByEights {
                law: self.law,
                volume: &self.constants.volume[first..],
                scale: self.constants.scale.map(|scale| &scale[first..]),
                part,
                answers: &mut eights,
            });
        }
        let moving = self.settings.simd.run(Kinetic {
            mass: &self.constants.mass[first..first + part.old.len()],
            velocity: part.new.velocity,
        });
        let mut totals = moving.merge(eights.totals());
        if eights.all_answered(part.old.len()) {
            return Ok(totals);
        }
        for row in 0..part.old.len() {
            if eights.answered(row) {
                continue;
            }
            let index = first + row;
            let volume = self.constants.volume[index];
            let (mut external, mut band) = (External::default(), self.settings.band);
            if asked {
                external = kernel.external(run, row);
                band = kernel.band(&part.old.position[row]).unwrap_or(band);
            }
            external.scale = scale_of(self.constants.scale, index);
            match self.particle(row, index, external, band, part, fresh) {
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
}
