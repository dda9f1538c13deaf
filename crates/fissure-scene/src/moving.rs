//! A sweep over a body without its law.

use fissure_particles::{MotionSlices, MotionSlicesMut};

use crate::body::{Body, BodyFailure};
use crate::law::Constants;
use crate::over_windows::{Cut, over_windows};
use crate::sweep::{KernelFailure, Run, RunKernel, SweepCause, SweepFailure};

impl<const D: usize> Body<D> {
    /// [`sweep`](Self::sweep) without the law: the kernel gathers and scatters.
    ///
    /// # Errors
    /// The particle that the kernel could not move.
    pub fn move_runs(
        &mut self,
        runs: &[Run],
        kernel: &dyn RunKernel<D>,
    ) -> Result<(), BodyFailure<D>> {
        self.particles.make_trial();
        let particles = &mut self.particles;
        let moving = Moving {
            old: particles.motion.slices(),
            new: particles.trial.slices_mut(),
        };
        let constants = Constants {
            id: &particles.id,
            mass: &particles.mass,
            volume: &particles.volume,
            density: self.law.density(),
            scale: None,
        };
        let moved = moving.over(runs, &constants, kernel, true);
        moved.map_err(|KernelFailure { index }| BodyFailure {
            position: particles.motion.position[index],
            failure: SweepFailure {
                id: particles.id[index],
                index,
                cause: SweepCause::Kernel,
            },
        })
    }
}

/// The motion of some consecutive particles.
pub(crate) struct Moving<'a, const D: usize> {
    pub old: MotionSlices<'a, D>,
    pub new: MotionSlicesMut<'a, D>,
}

impl<const D: usize> Moving<'_, D> {
    /// Has the kernel gather for these runs of all particles, and scatter if it `scatters`.
    pub(crate) fn over(
        self,
        runs: &[Run],
        constants: &Constants<'_>,
        kernel: &dyn RunKernel<D>,
        scatters: bool,
    ) -> Result<(), KernelFailure> {
        let (Some(first), Some(last)) = (runs.first(), runs.last()) else {
            return Ok(());
        };
        let (part, _) = self.cut(last.end as usize);
        let (_, part) = part.cut(first.start as usize);
        let leaf = |runs: &[Run], part: Moving<'_, D>| {
            let mut rest = Some(part);
            kernel.on_window(runs[0].window, &mut |kernel| {
                for run in runs {
                    let Some(part) = rest.take() else { continue };
                    let (mut part, left) = part.cut(run.len());
                    rest = Some(left);
                    let given = constants.of(run);
                    let moved = kernel.gather(run, &given, &part.old, &mut part.new);
                    if let Err(failure) = moved {
                        let (old, new) = (&part.old, &mut part.new);
                        return Err(failure.lowest(kernel, run, constants, old, new));
                    }
                    if scatters {
                        kernel.scatter(run, &given, &part.old, &part.new.as_slices());
                    }
                }
                Ok(())
            })
        };
        over_windows(runs, part, &leaf, &Result::and).unwrap_or(Ok(()))
    }
}

impl<const D: usize> Cut for Moving<'_, D> {
    fn cut(self, row: usize) -> (Self, Self) {
        let (old_a, old_b) = self.old.split_at(row);
        let (new_a, new_b) = self.new.split_at(row);
        let a = Self {
            old: old_a,
            new: new_a,
        };
        let b = Self {
            old: old_b,
            new: new_b,
        };
        (a, b)
    }
}
