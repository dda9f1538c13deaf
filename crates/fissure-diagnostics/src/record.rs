//! Columns of numbers, a row per step.

use std::fmt;

use fissure_scene::{Every, Report, Scene, Watch, WatchError};

use crate::label::is_called;

type Measure<const D: usize> = Box<dyn Fn(&Scene<D>, &Report<D>) -> f64>;

/// A watch that keeps columns of numbers, one row per step or per interval.
///
/// A column has a label, by convention with its unit, and a closure that gives its number. What a
/// scene does not have is best recorded as NaN: `scene.reaction("right").map_or(f64::NAN, |r| r[0])`.
///
/// ```
/// use fissure_diagnostics::Record;
/// use fissure_scene::{Plane, Report, Scene, Watch};
///
/// let mut curve = Record::new()
///     .column("time [s]", |scene, _| scene.time())
///     .column("force [N]", |_, report| report.reactions.first().map_or(f64::NAN, |r| r[0]))
///     .every(2);
///
/// let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
/// for step in 1..=4 {
///     let report = Report { step, time: 1e-6 * step as f64, dt: 1e-6, ..Report::default() };
///     scene.record(&report); // what a solver does
///     curve.after(&scene, &report)?;
/// }
/// assert_eq!(curve.values("time"), Some(&[2e-6, 4e-6][..]));
/// assert!(curve.last("force").is_some_and(f64::is_nan));
/// # Ok::<(), fissure_scene::WatchError>(())
/// ```
#[derive(Default)]
pub struct Record<const D: usize> {
    columns: Vec<Column<D>>,
    every: Every,
}

struct Column<const D: usize> {
    label: String,
    measure: Measure<D>,
    values: Vec<f64>,
}

impl<const D: usize> Record<D> {
    /// A record without columns, with a row after each step.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a column: its label, with the unit in brackets, and its number after a step.
    #[must_use]
    pub fn column(
        mut self,
        label: &str,
        measure: impl Fn(&Scene<D>, &Report<D>) -> f64 + 'static,
    ) -> Self {
        self.columns.push(Column {
            label: label.to_owned(),
            measure: Box::new(measure),
            values: Vec::new(),
        });
        self
    }

    /// Makes a row only after steps whose number is a multiple of `steps`; 0 is never.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.every = Every::Steps(steps);
        self
    }

    /// Makes a row only after steps that reach or pass a multiple of `interval`, s.
    #[must_use]
    pub fn every_interval(mut self, interval: f64) -> Self {
        self.every = Every::Time(interval);
        self
    }

    /// Makes a row now, whether it is due or not: for the state a run starts or ends with.
    pub fn push_row(&mut self, scene: &Scene<D>, report: &Report<D>) {
        for column in &mut self.columns {
            column.values.push((column.measure)(scene, report));
        }
    }

    /// Labels and numbers of all columns, in the order they were added.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &[f64])> {
        let columns = self.columns.iter();
        columns.map(|column| (column.label.as_str(), column.values.as_slice()))
    }

    /// The numbers of a column, asked for by its label (`"time [s]"`) or by its name (`"time"`).
    pub fn values(&self, name: &str) -> Option<&[f64]> {
        let mut columns = self.columns();
        Some(columns.find(|(label, _)| is_called(label, name))?.1)
    }

    /// The last number of a column; `None` if there is no such column or no row.
    pub fn last(&self, name: &str) -> Option<f64> {
        self.values(name)?.last().copied()
    }

    /// The rows, each with a number per column.
    pub fn rows(&self) -> impl Iterator<Item = Vec<f64>> {
        let row = |i: usize| self.columns.iter().map(move |c| c.values[i]).collect();
        (0..self.len()).map(row)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl<const D: usize> Watch<D> for Record<D> {
    fn after(&mut self, scene: &Scene<D>, report: &Report<D>) -> Result<(), WatchError> {
        if self.every.is_due(report) {
            self.push_row(scene, report);
        }
        Ok(())
    }
}

impl<const D: usize> fmt::Debug for Record<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.columns()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fissure_scene::Plane;

    fn watch(mut record: Record<2>, steps: u64) -> Record<2> {
        let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
        for step in 1..=steps {
            let report = Report {
                step,
                time: 0.1 * step as f64,
                dt: 0.1,
                ..Report::default()
            };
            scene.record(&report);
            record.after(&scene, &report).unwrap();
        }
        record
    }

    #[test]
    fn rows_come_when_due_and_columns_stay_in_step() {
        let record = || {
            Record::new()
                .column("step", |scene, _| scene.step() as f64)
                .column("time [s]", |_, report| report.time)
        };
        let by_steps = watch(record().every(3), 7);
        assert_eq!(by_steps.values("step"), Some(&[3.0, 6.0][..]));
        assert_eq!(by_steps.rows().count(), 2);
        assert_eq!(by_steps.rows().last().unwrap(), [6.0, 0.1 * 6.0]);
        let by_time = watch(record().every_interval(0.25), 7);
        assert_eq!(by_time.values("step"), Some(&[3.0, 5.0][..]));
        let labels: Vec<&str> = by_time.columns().map(|(label, _)| label).collect();
        assert_eq!(labels, ["step", "time [s]"]);
        assert_eq!(by_time.values("tim"), None);
        assert!(watch(record().every(0), 7).is_empty());
    }

    #[test]
    fn a_record_without_columns_has_no_rows() {
        let record = watch(Record::new(), 3);
        assert!(record.is_empty() && record.rows().count() == 0 && record.last("x").is_none());
    }
}
