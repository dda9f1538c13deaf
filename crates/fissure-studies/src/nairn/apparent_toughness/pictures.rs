//! J at onset against the resolution of the process zone and against the run time, loads, and the damage of each run.

use std::path::{Path, PathBuf};

use fissure::io::plot::{LinePlot, Style};
use fissure_study::{Parameters, StudyError};

use super::run::Finished;
use crate::convergence::ErrorChart;
use crate::drawing::save;
use crate::nairn::pictures::{Loads, write_columns};

/// Points of the pictures, by the numerics that they have in common; nothing without a folder.
#[derive(Default)]
pub(super) struct Pictures {
    folder: Option<PathBuf>,
    lines: Vec<(String, Vec<[f64; 3]>)>,
    resistances: Vec<(String, Vec<[f64; 2]>)>,
    loads: Loads,
}

impl Pictures {
    pub(super) fn new(folder: Option<&Path>) -> Self {
        Self {
            folder: folder.map(Path::to_path_buf),
            ..Self::default()
        }
    }

    pub(super) fn add(&mut self, case: &Parameters, finished: &Finished) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        let row = &finished.row;
        let value = |name| row.values.get(name).unwrap_or(f64::NAN);
        let (band, line, h) = (case.choice("band")?, case.choice("line")?, row.h);
        let on_nodes = if line == "nodes" { ", on nodes" } else { "" };
        let place = format!("{band} band{on_nodes}");
        let label = format!("{}, {place}", row.solver);
        let name = format!("{}-{band}-{line}-h-{}", row.solver, 1e3 * h);
        let picture = folder.join(format!("{name}-damage.png"));
        let damage = &finished.damage;
        damage.draw("damage [1]", (0.0, 1.0), 0.5 * h, &picture)?;
        let point = [value("h_over_zone"), value("far_j_at_onset"), row.wall_s];
        match self.lines.iter_mut().find(|(known, _)| *known == label) {
            Some((_, points)) => points.push(point),
            None => self.lines.push((label.clone(), vec![point])),
        }
        let label = format!("{label}, h/l = {:.2}", point[0]);
        let table = folder.join(format!("{name}-load.csv"));
        self.loads.add(&label, &finished.load, &table)?;
        if finished.resistance.len() > 1 {
            let label = format!("{place}, h/l = {:.2}", point[0]);
            self.resistances.push((label, finished.resistance.clone()));
        }
        Ok(())
    }

    pub(super) fn finish(&self) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        self.loads.save(&folder.join("load.png"))?;
        let mut plot = LinePlot::new("J far from the tip at the first failure")
            .x_label("spacing over the length of the process zone [1]")
            .y_label("J/G_c [1]");
        let mut chart = ErrorChart::over_time("Apparent toughness against run time", "J/G_c - 1");
        for (number, (label, points)) in self.lines.iter().enumerate() {
            let mut sorted = points.clone();
            sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let column = |i: usize| -> Vec<f64> { sorted.iter().map(|point| point[i]).collect() };
            write_columns(
                &folder.join(format!("onset-{number}.csv")),
                &[
                    ("h_over_zone", &column(0)),
                    ("far_j", &column(1)),
                    ("wall_s", &column(2)),
                ],
            )?;
            for point in &sorted {
                chart.add(label, point[2], (point[1] - 1.0).abs());
            }
            plot = plot.series(label, column(0), column(1), Style::LineAndMarkers);
        }
        save(plot, &folder.join("onset.png"))?;
        chart.save(&folder.join("error-against-time.png"))?;
        if self.resistances.is_empty() {
            return Ok(());
        }
        let mut plot = LinePlot::new("Resistance to growth in equilibrium")
            .x_label("growth of the crack [m]")
            .y_label("J/G_c [1]");
        for (label, points) in &self.resistances {
            let (x, y): (Vec<f64>, Vec<f64>) = points.iter().map(|p| (p[0], p[1])).unzip();
            plot = plot.series(label, x, y, Style::Line);
        }
        save(plot, &folder.join("resistance.png"))
    }
}
