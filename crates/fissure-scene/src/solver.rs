//! What moves a scene, what looks at it, and the loop that joins them.

use crate::error::{SolveError, WatchError};
use crate::{Report, Scene};

/// Moves a scene by one step.
pub trait Solver<const D: usize> {
    /// Moves the scene by one step of the solver's choosing, at most to `until`, s.
    ///
    /// # Errors
    /// A [`SolveError`]; the scene is then as it was before the step (its particles may have been
    /// sorted).
    fn step(&mut self, scene: &mut Scene<D>, until: f64) -> Result<Report<D>, SolveError>;

    /// What the solver carries from step to step beyond the scene, so that a restarted run gives
    /// the same bits.
    fn memory(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Takes back what [`memory`](Self::memory) gave.
    fn recall(&mut self, _memory: &[f64]) {}
}

/// Looks at a scene after each step.
pub trait Watch<const D: usize> {
    /// Called after each step.
    ///
    /// # Errors
    /// Stops the run.
    fn after(&mut self, scene: &Scene<D>, report: &Report<D>) -> Result<(), WatchError>;

    /// What [`run`] calls: [`after`](Self::after), for a watch that also needs the solver. A
    /// checkpoint does, for its [`memory`](Solver::memory).
    ///
    /// # Errors
    /// Stops the run.
    fn after_with_solver(
        &mut self,
        scene: &Scene<D>,
        report: &Report<D>,
        _solver: &dyn Solver<D>,
    ) -> Result<(), WatchError> {
        self.after(scene, report)
    }
}

/// When a run ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Until {
    /// At this time, s.
    Time(f64),
    /// After this many further steps.
    Steps(u64),
}

/// What a run did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunSummary {
    /// Steps done.
    pub steps: u64,
}

/// Steps a scene until a time or a number of steps; every watch is called after each step.
///
/// # Errors
/// The first step or watch that fails.
pub fn run<const D: usize>(
    scene: &mut Scene<D>,
    solver: &mut dyn Solver<D>,
    until: Until,
    watches: &mut [&mut dyn Watch<D>],
) -> Result<RunSummary, SolveError> {
    let start = scene.step();
    loop {
        let limit = match until {
            Until::Time(end) if scene.time() < end => end,
            Until::Steps(count) if scene.step() - start < count => f64::INFINITY,
            _ => {
                return Ok(RunSummary {
                    steps: scene.step() - start,
                });
            }
        };
        let report = solver.step(scene, limit)?;
        for watch in watches.iter_mut() {
            watch.after_with_solver(scene, &report, solver)?;
        }
    }
}
