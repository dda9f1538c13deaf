//! Length and speed of a crack over time.

use fissure_scene::{Every, Report, Scene, Watch, WatchError};

use crate::CurveError;

/// A watch that keeps the length of a crack.
///
/// ```
/// # use fissure_diagnostics::fracture::CrackHistory;
/// # use fissure_scene::{CrackSettings, End, Plane, Report, Scene, Watch};
/// # let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
/// # scene.crack("notch", &[[0.0, 0.0], [0.01, 0.0]], CrackSettings::default())?;
/// let mut history = CrackHistory::of("notch").every_interval(1e-6);
/// // run(&mut scene, &mut solver, until, &mut [&mut history])?;
/// # for step in 1..=20 {
/// #     scene.grow_crack(0, End::Last, [0.01 + 5e-4 * step as f64, 0.0].into())?;
/// #     let report = Report { step, time: 1e-6 * step as f64, dt: 1e-6, ..Report::default() };
/// #     scene.record(&report);
/// #     history.after(&scene, &report)?;
/// # }
/// assert!((history.speed(5e-6, 10e-6)? - 500.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CrackHistory {
    crack: String,
    every: Every,
    time: Vec<f64>,
    length: Vec<f64>,
}

impl CrackHistory {
    /// The history of the crack of this name, a row after each step.
    pub fn of(crack: &str) -> Self {
        Self {
            crack: crack.to_owned(),
            every: Every::default(),
            time: Vec::new(),
            length: Vec::new(),
        }
    }

    /// Keeps a row only after steps whose number is a multiple of `steps`.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.every = Every::Steps(steps);
        self
    }

    /// Keeps a row only after steps that reach or pass a multiple of `interval`, s.
    #[must_use]
    pub fn every_interval(mut self, interval: f64) -> Self {
        self.every = Every::Time(interval);
        self
    }

    /// Times of the rows, s.
    pub fn times(&self) -> &[f64] {
        &self.time
    }

    /// Lengths of the crack, m.
    pub fn lengths(&self) -> &[f64] {
        &self.length
    }

    /// Time of the first row in which the crack is longer than in the first of all, s: the onset.
    pub fn onset(&self) -> Option<f64> {
        let first = *self.length.first()?;
        let row = self.length.iter().position(|length| *length > first)?;
        Some(self.time[row])
    }

    /// Mean speed between two times, m/s: the slope of the straight line fitted to the lengths of
    /// the rows between them by least squares, since a crack grows in jumps. Of both tips together if
    /// both grow.
    ///
    /// # Errors
    /// [`CurveError::Length`] for fewer than two rows between them, [`CurveError::OneAbscissa`].
    pub fn speed(&self, from: f64, to: f64) -> Result<f64, CurveError> {
        let rows = self.time.iter().zip(&self.length);
        let rows: Vec<_> = rows.filter(|(t, _)| **t >= from && **t <= to).collect();
        let count = rows.len() as f64;
        if rows.len() < 2 {
            let (x, y) = (rows.len(), rows.len());
            return Err(CurveError::Length { x, y });
        }
        let mean_time = rows.iter().map(|(t, _)| **t).sum::<f64>() / count;
        let mean_length = rows.iter().map(|(_, a)| **a).sum::<f64>() / count;
        let (mut top, mut bottom) = (0.0, 0.0);
        for (t, a) in rows {
            top += (t - mean_time) * (a - mean_length);
            bottom += (t - mean_time).powi(2);
        }
        if bottom > 0.0 {
            Ok(top / bottom)
        } else {
            Err(CurveError::OneAbscissa)
        }
    }

    /// Labels and numbers of the two columns, for a table.
    pub fn columns(&self) -> [(&'static str, &[f64]); 2] {
        [("time [s]", &self.time), ("crack length [m]", &self.length)]
    }
}

impl<const D: usize> Watch<D> for CrackHistory {
    fn after(&mut self, scene: &Scene<D>, report: &Report<D>) -> Result<(), WatchError> {
        if !self.every.is_due(report) {
            return Ok(());
        }
        let mut cracks = scene.cracks().iter();
        let crack = cracks.find(|crack| crack.name() == self.crack);
        let crack = crack.ok_or_else(|| WatchError::Unknown {
            kind: "crack",
            name: self.crack.clone(),
        })?;
        self.time.push(report.time);
        self.length.push(crack.line().length());
        Ok(())
    }
}
