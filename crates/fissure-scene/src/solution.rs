//! How the equations of an implicit or quasi-static step were solved.

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
    /// No load satisfies the equation that controls a followed path.
    Control,
}

impl NewtonStop {
    /// In a few words.
    pub fn text(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::Iterations => "iterations are spent",
            Self::LineSearch => "no share of the correction lowers the residual",
            Self::Linear => "linear system not solved",
            Self::Refused => "refused by a law or the grid",
            Self::NotFinite => "not finite",
            Self::Control => "no load satisfies the control",
        }
    }
}

/// What was held fixed in a quasi-static step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepControl {
    /// Loads and motions are those of the end of the step.
    Prescribed,
    /// The length of the displacement increment.
    ArcLength,
    /// The energy that the laws dissipate in the step.
    Dissipation,
}

/// How the equations of a step were solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Time for which the loads and motions of the scene were taken at the end of the step, s: the
    /// load factor. It is the scene's time unless a path is followed.
    pub load_time: f64,
    /// What the load time changed by in the step, s; negative where a path turns back.
    pub load_step: f64,
    /// What was held fixed.
    pub control: StepControl,
    /// Negative pivots of the last tangent that was factorised in the step, of its symmetric part if it is not symmetric: 0 on a
    /// branch that is stable under these conditions. `None` where none was factorised or only as `L U`.
    pub negative_pivots: Option<usize>,
    /// How often the step was cut before.
    pub cuts: usize,
    /// Why the iteration ended.
    pub stop: NewtonStop,
}
