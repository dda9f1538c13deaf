//! Errors over spacing and step: observed orders, and charts of error against something.

use std::path::Path;

use fissure::diagnostics::fit_slope;
use fissure::io::plot::{LinePlot, Style};
use fissure::prelude::*;

use crate::drawing::save;
use fissure_study::{Field, Parameters, Row, SimulationRow, StudyError, Value};

/// Runs that differ in the spacing alone or in the step alone, and what their errors do.
pub struct SeriesSet {
    study: &'static str,
    runs: Vec<Finished>,
}

struct Finished {
    case: Parameters,
    row: SimulationRow,
    /// Positions by particle, body after body, m.
    positions: Vec<Vector2<f64>>,
}

impl SeriesSet {
    /// No runs yet.
    pub fn new(study: &'static str) -> Self {
        let runs = Vec::new();
        Self { study, runs }
    }

    /// Adds a run.
    pub fn add(&mut self, case: &Parameters, row: &SimulationRow, scene: &Scene<2>) {
        self.runs.push(Finished {
            case: case.clone(),
            row: row.clone(),
            positions: positions(scene),
        });
    }

    /// One row for every error of every series of runs that differ in `h`, in `cfl` or in `steps` alone: the order by least
    /// squares over all of them and between the two finest. One more for every series in the step, by the distance
    /// between the final positions of neighbouring runs: free of the error in space.
    pub fn orders(&self) -> Vec<Row> {
        let mut rows = Vec::new();
        for series in self.series("h") {
            let spacings: Vec<f64> = series.iter().map(|run| run.row.h).collect();
            rows.extend(self.error_orders(&series, "h", &spacings));
        }
        for (name, step) in [
            ("cfl", (|cfl| cfl) as fn(f64) -> f64),
            ("steps", |steps| 1.0 / steps),
        ] {
            for mut series in self.series(name) {
                let step = |run: &Finished| step(value_of(run, name));
                series.sort_by(|a, b| step(b).total_cmp(&step(a)));
                let all: Vec<f64> = series.iter().map(|run| step(run)).collect();
                rows.extend(self.error_orders(&series, name, &all));
                let pairs = || series.windows(2);
                let steps: Vec<f64> = pairs().map(|pair| step(pair[0])).collect();
                let distances: Vec<f64> = pairs()
                    .map(|pair| distance(&pair[0].positions, &pair[1].positions))
                    .collect();
                rows.extend(self.row(&series, name, "change_of_positions", &steps, &distances));
            }
        }
        rows
    }

    /// A row for every error of a series.
    fn error_orders<'a>(
        &'a self,
        series: &'a [&Finished],
        over: &'a str,
        x: &'a [f64],
    ) -> impl Iterator<Item = Row> + 'a {
        let errors = series[0].row.errors.iter();
        errors.filter_map(move |(name, _)| {
            let of = |run: &&Finished| run.row.errors.get(name).unwrap_or(f64::NAN);
            let errors: Vec<f64> = series.iter().map(of).collect();
            self.row(series, over, name, x, &errors)
        })
    }

    /// Series of runs that differ in `name` alone, each by falling value.
    fn series(&self, name: &str) -> Vec<Vec<&Finished>> {
        let mut series: Vec<Vec<&Finished>> = Vec::new();
        for run in &self.runs {
            let same = |first: &Finished| rest(&first.case, name).eq(rest(&run.case, name));
            match series.iter_mut().find(|series| same(series[0])) {
                Some(series) => series.push(run),
                None => series.push(vec![run]),
            }
        }
        for series in &mut series {
            series.sort_by(|a, b| value_of(b, name).total_cmp(&value_of(a, name)));
        }
        series.retain(|series| series.len() > 1);
        series
    }

    /// A row, if there are two errors that a logarithm can be taken of.
    fn row(
        &self,
        series: &[&Finished],
        over: &str,
        measure: &str,
        x: &[f64],
        errors: &[f64],
    ) -> Option<Row> {
        let fitted = fit_slope(x, errors).ok()?;
        let last = x.len() - 2;
        let finest = fit_slope(&x[last..], &errors[last..]).ok()?;
        let own = series[0].case.label_without(&[over]);
        Some(
            Row::other(self.study)
                .field("case", "observed order")
                .field("of", own)
                .field("over", over)
                .field("measure", measure)
                .field("order", fitted.exponent)
                .field("order_finest", finest.exponent)
                .field("finest_error", errors[last + 1])
                .field("runs", Field::from(series.len())),
        )
    }
}

/// The value of a number or count by which runs differ.
fn value_of(run: &Finished, name: &str) -> f64 {
    let count = |_| run.case.count(name).map(|count| count as f64);
    run.case.number(name).or_else(count).unwrap_or(f64::NAN)
}

/// Every parameter but one.
fn rest<'a>(case: &'a Parameters, but: &'a str) -> impl Iterator<Item = (&'static str, &'a Value)> {
    case.iter().filter(move |(name, _)| *name != but)
}

/// Positions of all particles by id, body after body.
pub fn positions(scene: &Scene<2>) -> Vec<Vector2<f64>> {
    let mut all = Vec::new();
    for body in scene.bodies() {
        let first = all.len();
        all.resize(first + body.particles().len(), Vector2::zeros());
        for (id, x) in body.particles().id.iter().zip(body.motion().position) {
            all[first + id.0 as usize] = *x;
        }
    }
    all
}

/// Root mean square distance of two lists of points, m; NaN if they are of different particles.
fn distance(a: &[Vector2<f64>], b: &[Vector2<f64>]) -> f64 {
    if a.len() != b.len() {
        return f64::NAN;
    }
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b).norm_squared()).sum();
    (squares / a.len() as f64).sqrt()
}

/// Errors of many runs against one quantity, a line per label, both axes logarithmic.
pub struct ErrorChart {
    title: String,
    x_label: &'static str,
    y_label: String,
    lines: Vec<(String, Vec<f64>, Vec<f64>)>,
    style: Style,
}

/// Lines of one chart: more would not be told apart.
const MOST_LINES: usize = 12;

impl ErrorChart {
    /// An empty chart.
    pub fn new(title: &str, x_label: &'static str, y_label: &str) -> Self {
        Self {
            title: title.to_owned(),
            x_label,
            y_label: format!("{y_label} [1]"),
            lines: Vec::new(),
            style: Style::LineAndMarkers,
        }
    }

    /// An empty chart of errors against the wall time of the runs.
    pub fn over_time(title: &str, y_label: &str) -> Self {
        Self::new(title, "wall time [s]", y_label)
    }

    /// The same with markers alone.
    #[must_use]
    pub fn scattered(mut self) -> Self {
        self.style = Style::Markers;
        self
    }

    /// Adds a point; one that a logarithmic axis does not hold is left out.
    pub fn add(&mut self, label: &str, x: f64, error: f64) {
        if !(x > 0.0 && error > 0.0 && error.is_finite()) {
            return;
        }
        match self.lines.iter_mut().find(|(known, ..)| known == label) {
            Some((_, xs, errors)) => {
                xs.push(x);
                errors.push(error);
            }
            None => self.lines.push((label.to_owned(), vec![x], vec![error])),
        }
    }

    /// Draws it with a further line on top, unless it is empty.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save_with(
        &self,
        line: Option<(&str, &[f64], &[f64])>,
        path: &Path,
    ) -> Result<(), StudyError> {
        if self.lines.is_empty() {
            return Ok(());
        }
        let mut plot = LinePlot::new(&self.title)
            .x_label(self.x_label)
            .y_label(&self.y_label)
            .log_x()
            .log_y();
        for (label, x, errors) in self.lines.iter().take(MOST_LINES) {
            plot = plot.series(label, x.as_slice(), errors.as_slice(), self.style);
        }
        if let Some((label, x, errors)) = line {
            plot = plot.series(label, x, errors, Style::Dashed);
        }
        save(plot, path)
    }

    /// Draws it, unless it is empty.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), StudyError> {
        self.save_with(None, path)
    }
}
