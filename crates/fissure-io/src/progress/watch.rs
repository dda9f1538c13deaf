//! The bar of a running scene.

use fissure_scene::{Every, Report, Scene, Watch, WatchError};

use super::ProgressBar;

/// A watch that shows how far a run to a given time is: a bar with the time that is left, the step and its length.
///
/// It writes nothing where stderr is no terminal. Redrawing is limited by the clock, so there is no need to show only
/// every n-th step but for steps of microseconds.
///
/// ```
/// use fissure_io::progress::Progress;
///
/// let end = 4e-3; // s
/// let progress = Progress::new(end, "bar").every(100);
/// // run(&mut scene, &mut solver, Until::Time(end), &mut [&mut progress])?;
/// ```
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    end: f64,
    every: Every,
    started: bool,
}

impl Progress {
    /// A bar towards the time `end`, s, behind a label.
    pub fn new(end: f64, label: &str) -> Self {
        Self::with_bar(ProgressBar::new(end, label), end)
    }

    /// Shows only steps whose number is a multiple of `steps`, and the last one.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.every = Every::Steps(steps);
        self
    }

    fn with_bar(bar: ProgressBar, end: f64) -> Self {
        Self {
            bar,
            end,
            every: Every::default(),
            started: false,
        }
    }
}

impl<const D: usize> Watch<D> for Progress {
    fn after(&mut self, _scene: &Scene<D>, report: &Report<D>) -> Result<(), WatchError> {
        if !self.started {
            // A restarted run must not take what was done before for speed.
            self.bar.start_at(report.time - report.dt);
            self.started = true;
        }
        let ended = report.time >= self.end * (1.0 - 1e-12);
        if ended || self.every.is_due(report) {
            let message = format_args!("step {}, dt {:.2e} s", report.step, report.dt);
            self.bar.update(report.time, message);
        }
        if ended {
            self.bar.finish();
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::tests::Terminal;
    use fissure_scene::Plane;
    use indicatif::ProgressDrawTarget;

    fn watch(progress: &mut Progress, steps: std::ops::RangeInclusive<u64>) {
        let scene = Scene::plane(Plane::Strain { thickness: 1.0 });
        for step in steps {
            let report = Report {
                step,
                time: 1e-3 * step as f64,
                dt: 1e-3,
                ..Report::default()
            };
            progress.after(&scene, &report).unwrap();
        }
    }

    #[test]
    fn it_ends_with_the_run_and_names_the_last_step() {
        let terminal = Terminal::default();
        let target = ProgressDrawTarget::term_like(Box::new(terminal.clone()));
        let bar = ProgressBar::with_target(7e-3, "bar", target);
        let mut progress = Progress::with_bar(bar, 7e-3).every(100);
        watch(&mut progress, 4..=6);
        assert!(!progress.bar.bar.is_finished());
        assert!(!terminal.drawn().contains("step"), "{}", terminal.drawn());
        watch(&mut progress, 7..=7);
        assert!(progress.bar.bar.is_finished());
        let drawn = terminal.drawn();
        assert!(drawn.contains("100 %"), "{drawn}");
        assert!(drawn.contains("step 7, dt 1.00e-3 s"), "{drawn}");
    }
}
