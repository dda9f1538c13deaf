//! Checkpoints of a running scene.

use std::path::{Path, PathBuf};

use fissure_scene::{Report, Scene, Solver, Watch, WatchError};

use super::Checkpoint;

/// A watch that saves a [`Checkpoint`] after each step whose number is a multiple of a given one, always to the same file.
///
/// The file is replaced in one piece: whenever the run is killed, it holds the last checkpoint whole. List it after the
/// watches whose files it is to agree with.
///
/// [`run`](fissure_scene::run) hands the solver's memory over. A loop of one's own should call
/// [`after_with_solver`](Watch::after_with_solver); by [`after`](Watch::after) alone the checkpoint has no memory of the
/// solver, which then starts as a new one and may not give the same bits.
///
/// ```
/// use fissure_io::checkpoint::AutoCheckpoint;
///
/// let mut checkpoint = AutoCheckpoint::new("bar.checkpoint", 10_000);
/// // run(&mut scene, &mut solver, until, &mut [&mut checkpoint])?;
/// assert_eq!(checkpoint.last(), None);
/// ```
#[derive(Debug, Clone)]
pub struct AutoCheckpoint {
    path: PathBuf,
    steps: u64,
    last: Option<u64>,
}

impl AutoCheckpoint {
    /// Saves to `path` every so many steps; 0 is never. The folder must exist.
    pub fn new(path: impl AsRef<Path>, steps: u64) -> Self {
        Self {
            path: path.as_ref().to_owned(),
            steps,
            last: None,
        }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of the step after which it last saved.
    pub fn last(&self) -> Option<u64> {
        self.last
    }

    fn save<const D: usize>(
        &mut self,
        scene: &Scene<D>,
        memory: impl FnOnce() -> Vec<f64>,
    ) -> Result<(), WatchError> {
        if scene.step().is_multiple_of(self.steps) {
            Checkpoint::save(&self.path, scene, &memory())
                .map_err(|error| WatchError::Write(Box::new(error)))?;
            self.last = Some(scene.step());
        }
        Ok(())
    }
}

impl<const D: usize> Watch<D> for AutoCheckpoint {
    fn after(&mut self, scene: &Scene<D>, _report: &Report<D>) -> Result<(), WatchError> {
        self.save(scene, Vec::new)
    }

    fn after_with_solver(
        &mut self,
        scene: &Scene<D>,
        _report: &Report<D>,
        solver: &dyn Solver<D>,
    ) -> Result<(), WatchError> {
        self.save(scene, || solver.memory())
    }
}
