//! An attempt at a step that found no balance.

use fissure_scene::{NewtonStop, Scene, SolveError};

/// Why there is none.
pub(crate) struct Failure {
    pub stop: NewtonStop,
    /// Last relative residual.
    pub residual: f64,
    /// What a law or the grid said.
    pub refused: Option<SolveError>,
}

impl Failure {
    /// At this relative residual.
    pub(crate) fn at(stop: NewtonStop, residual: f64) -> Self {
        Self {
            stop,
            residual,
            refused: None,
        }
    }

    /// The error of a step that was cut so often.
    pub(crate) fn into_error<const D: usize>(
        self,
        scene: &Scene<D>,
        cuts: usize,
        tolerance: f64,
    ) -> SolveError {
        let (step, time) = (scene.step() + 1, scene.time());
        match (self.refused, self.stop) {
            (Some(error), _) => error,
            (None, NewtonStop::Linear) => SolveError::Singular { step, time },
            (None, stop) => SolveError::NoConvergence {
                step,
                time,
                cuts,
                residual: self.residual,
                tolerance,
                stop,
            },
        }
    }
}

impl From<SolveError> for Failure {
    fn from(error: SolveError) -> Self {
        Self {
            stop: NewtonStop::Refused,
            residual: f64::NAN,
            refused: Some(error),
        }
    }
}
