//! What the last step took.

use crate::linear::Stop;

/// Why Newton's method ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NewtonStop {
    /// The residual is within the tolerance.
    Converged,
    /// The iterations are spent.
    Iterations,
    /// No share of the correction lowers the residual.
    LineSearch,
    /// The linear system was not solved.
    Linear,
    /// A law or the grid refused the displacement that Newton's method began with.
    Refused,
    /// A number is not finite.
    NotFinite,
}

/// What the last attempt at a step took.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepStatistics {
    /// Relative residual before each Newton iteration, and after the last.
    pub residuals: Vec<f64>,
    /// Products with the tangent of each Newton iteration; none with a direct solver.
    pub products: Vec<usize>,
    /// Why the last linear iteration ended.
    pub linear_stop: Option<Stop>,
    /// Negative pivots of the last factorisation, 0 without one.
    pub negative_pivots: usize,
    /// Why Newton's method ended.
    pub stop: Option<NewtonStop>,
    /// How often the step was cut.
    pub cuts: usize,
}
