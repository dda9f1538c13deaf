//! What the last step took.

use fissure_scene::NewtonStop;

use crate::linear::Stop;

/// What the last attempt at a step took.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepStatistics {
    /// Relative residual before each Newton iteration, and after the last.
    pub residuals: Vec<f64>,
    /// Products with the tangent of each Newton iteration; none with a direct solver.
    pub products: Vec<usize>,
    /// Why the last linear iteration ended.
    pub linear_stop: Option<Stop>,
    /// Negative pivots of the last factorisation of the step; `None` where none has counted them.
    pub negative_pivots: Option<usize>,
    /// Why Newton's method ended.
    pub stop: Option<NewtonStop>,
    /// How often the step was cut.
    pub cuts: usize,
}
