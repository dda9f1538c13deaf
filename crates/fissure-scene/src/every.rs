//! How often a watch looks.

use crate::Report;

/// After which steps something is due: what a watch counts by.
///
/// The answer depends on the step alone and not on what was asked before, so a run restarted from
/// a checkpoint is watched at the same steps as one that was never interrupted.
///
/// ```
/// use fissure_scene::{Every, Report};
///
/// let mut report = Report::<2> { step: 30, time: 3e-5, dt: 1e-6, ..Default::default() };
/// assert!(Every::Steps(10).is_due(&report) && Every::Time(1e-5).is_due(&report));
/// (report.step, report.time) = (31, 3.1e-5);
/// assert!(!Every::Steps(10).is_due(&report) && !Every::Time(1e-5).is_due(&report));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Every {
    /// After each step whose number is a multiple of this; 0 is never.
    Steps(u64),
    /// After each step that reaches or passes a multiple of this time, s; a step that passes
    /// several counts once. What is not greater than zero is never.
    Time(f64),
}

impl Every {
    /// Whether it is due after this step.
    pub fn is_due<const D: usize>(&self, report: &Report<D>) -> bool {
        match *self {
            Self::Steps(count) => report.step.is_multiple_of(count),
            Self::Time(interval) => {
                // The slack takes a time that was to be a multiple and is one bit short.
                let passed = |time: f64| (time / interval + 1e-9).floor();
                interval > 0.0 && passed(report.time) > passed(report.time - report.dt)
            }
        }
    }
}

impl Default for Every {
    /// After each step.
    fn default() -> Self {
        Self::Steps(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn due(every: Every, dt: f64, steps: u64) -> Vec<u64> {
        let mut report = Report::<2> {
            dt,
            ..Report::default()
        };
        let mut due = Vec::new();
        for step in 1..=steps {
            (report.step, report.time) = (step, report.time + dt);
            if every.is_due(&report) {
                due.push(step);
            }
        }
        due
    }

    #[test]
    fn multiples_are_met_once_each_despite_rounding() {
        // 0.1 summed ten times is one bit short of 1.
        assert_eq!(due(Every::Time(0.3), 0.1, 12), [3, 6, 9, 12]);
        assert_eq!(due(Every::Time(1.0), 0.1, 30), [10, 20, 30]);
        assert_eq!(due(Every::Time(0.25), 0.1, 10), [3, 5, 8, 10]);
        assert_eq!(due(Every::Time(0.01), 0.1, 3), [1, 2, 3]);
        assert_eq!(due(Every::Steps(4), 0.1, 9), [4, 8]);
        assert_eq!(due(Every::default(), 0.1, 2), [1, 2]);
    }

    #[test]
    fn no_interval_is_never() {
        for interval in [0.0, -0.1, f64::NAN] {
            assert_eq!(due(Every::Time(interval), 0.1, 9), []);
        }
        assert_eq!(due(Every::Steps(0), 0.1, 9), []);
    }
}
