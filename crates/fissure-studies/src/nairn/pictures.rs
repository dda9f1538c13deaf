//! Writing curves, and drawing bodies coloured by a value of their law.

use std::path::Path;

use fissure::io::plot::{LinePlot, ScatterPlot, Style};
use fissure::io::table::{Cell, Table};
use fissure::prelude::*;
use fissure_study::{Parameters, StudyError};

use crate::drawing::save;

/// Rows of a curve in files and pictures.
pub(super) const ROWS: usize = 400;

/// About `count` entries of a column, the first and the last among them.
pub(super) fn thinned(column: &[f64], count: usize) -> Vec<f64> {
    let stride = column.len().div_ceil(count).max(1);
    let whole = column.len().saturating_sub(1).is_multiple_of(stride);
    let thin = column.iter().step_by(stride);
    thin.chain(column.last().filter(|_| !whole))
        .copied()
        .collect()
}

/// Writes columns of one length as a table.
pub(super) fn write_columns(path: &Path, columns: &[(&str, &[f64])]) -> Result<(), StudyError> {
    let failed = || StudyError::failed(format!("writing {}", path.display()));
    let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let mut table = Table::new(&names).map_err(failed())?;
    let rows = columns.iter().map(|(_, c)| c.len()).min().unwrap_or(0);
    for i in 0..rows {
        let cells = columns.iter().map(|(_, column)| Cell::Number(column[i]));
        table.row(cells).map_err(failed())?;
    }
    table.write(path).map_err(failed())
}

/// The values of those of these choices in which the runs of a study differ, in files; labels leave out the `usual` ones.
pub(super) fn varied<'c>(
    case: &'c Parameters,
    choices: &[&str],
    usual: &[&str],
) -> Result<Varied<'c>, StudyError> {
    let mut varied = Varied::default();
    for choice in choices {
        if case.varying().contains(choice) {
            let value = case.choice(choice)?;
            varied.file.push(value);
            if !usual.contains(&value) {
                varied.label.push(value);
            }
        }
    }
    Ok(varied)
}

/// What tells a run from the others of its study.
#[derive(Default)]
pub(super) struct Varied<'c> {
    /// In the name of a file.
    pub file: Vec<&'c str>,
    /// In the label of a curve.
    pub label: Vec<&'c str>,
}

/// Load over displacement of several runs in one picture.
#[derive(Default)]
pub(super) struct Loads(Vec<(String, Vec<f64>, Vec<f64>)>);

impl Loads {
    /// Adds a curve of displacement, m, and load, N, and writes it as a table.
    pub(super) fn add(
        &mut self,
        label: &str,
        curve: &[[f64; 2]],
        path: &Path,
    ) -> Result<(), StudyError> {
        let column = |axis: usize| {
            let whole: Vec<f64> = curve.iter().map(|point| point[axis]).collect();
            thinned(&whole, ROWS)
        };
        let (way, load) = (column(0), column(1));
        write_columns(path, &[("displacement [m]", &way), ("load [N]", &load)])?;
        self.0.push((label.to_owned(), way, load));
        Ok(())
    }

    /// Draws them, unless there are none.
    pub(super) fn save(&self, path: &Path) -> Result<(), StudyError> {
        if self.0.iter().all(|(_, way, _)| way.is_empty()) {
            return Ok(());
        }
        let mut plot = LinePlot::new("Load over displacement")
            .x_label("displacement of the ends [m]")
            .y_label("load [N]");
        for (label, way, load) in &self.0 {
            plot = plot.series(label, way.as_slice(), load.as_slice(), Style::Line);
        }
        save(plot, path)
    }
}

/// What is drawn of particles: position in the plane of the picture and a value.
#[derive(Clone, Debug, Default)]
pub(super) struct Snapshot {
    pub title: String,
    pub points: Vec<[f64; 2]>,
    pub values: Vec<f64>,
    /// Axes of the plane of the picture, if not x and y.
    pub axes: Option<[&'static str; 2]>,
}

/// What of a body in space is drawn: its particles on an axis between two places, seen along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slice {
    pub axis: usize,
    pub middle: f64,
    pub half: f64,
}

impl Snapshot {
    /// The bodies where they are now, coloured by a value of their laws; 0 where a law has none.
    pub(super) fn of<const D: usize>(
        title: impl Into<String>,
        scene: &Scene<D>,
        value: &str,
        slice: Option<Slice>,
    ) -> Self {
        const NAMES: [&str; 3] = ["x [m]", "y [m]", "z [m]"];
        let [one, other] = match slice.map(|slice| slice.axis) {
            Some(0) => [1, 2],
            Some(1) => [0, 2],
            _ => [0, 1],
        };
        let mut snapshot = Self {
            title: title.into(),
            axes: Some([NAMES[one], NAMES[other]]),
            ..Self::default()
        };
        for body in scene.bodies() {
            let values = body.value(value);
            for (i, x) in body.motion().position.iter().enumerate() {
                let inside = |slice: Slice| (x[slice.axis] - slice.middle).abs() < slice.half;
                if !slice.is_none_or(inside) {
                    continue;
                }
                snapshot.points.push([x[one], x[other]]);
                snapshot.values.push(values.as_ref().map_or(0.0, |v| v[i]));
            }
        }
        snapshot
    }

    /// The bodies where they are now, coloured by a normal stress, Pa.
    pub(super) fn of_stress(title: impl Into<String>, scene: &Scene<2>, axis: usize) -> Self {
        let mut snapshot = Self {
            title: title.into(),
            ..Self::default()
        };
        for body in scene.bodies() {
            let motion = body.motion();
            for (x, stress) in motion.position.iter().zip(motion.stress) {
                snapshot.points.push([x[0], x[1]]);
                snapshot.values.push(stress.mandel[axis]);
            }
        }
        snapshot
    }

    /// Draws it with colours from `low` to `high`.
    pub(super) fn draw(
        &self,
        label: &str,
        (low, high): (f64, f64),
        size: f64,
        path: &Path,
    ) -> Result<(), StudyError> {
        let mut plot = ScatterPlot::new(&self.title, &self.points)
            .colour(label, &self.values)
            .range(low, high)
            .particle_size(size);
        if let Some([x, y]) = self.axes {
            plot = plot.labels(x, y);
        }
        plot.save(path)
            .map_err(StudyError::failed(format!("drawing {}", path.display())))
    }
}
