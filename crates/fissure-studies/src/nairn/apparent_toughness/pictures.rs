//! J at onset against the resolution of the process zone and against the run time.

use std::path::Path;

use fissure::io::plot::{LinePlot, Style};
use fissure_study::{Parameters, SimulationRow, StudyError};

use crate::convergence::ErrorChart;
use crate::nairn::pictures::{save, write_columns};

/// Points of the pictures, by the numerics that they have in common.
#[derive(Default)]
pub(super) struct Pictures {
    lines: Vec<(String, Vec<[f64; 3]>)>,
    resistances: Vec<(String, Vec<[f64; 2]>)>,
}

impl Pictures {
    pub(super) fn add(
        &mut self,
        case: &Parameters,
        row: &SimulationRow,
        resistance: &[[f64; 2]],
    ) -> Result<(), StudyError> {
        let value = |name| row.values.get(name).unwrap_or(f64::NAN);
        let mut label = format!("{}, {} band", row.solver, case.choice("band")?);
        if case.choice("line")? == "nodes" {
            label = format!("{label}, on nodes");
        }
        let point = [value("h_over_zone"), value("far_j_at_onset"), row.wall_s];
        match self.lines.iter_mut().find(|(known, _)| *known == label) {
            Some((_, points)) => points.push(point),
            None => self.lines.push((label.clone(), vec![point])),
        }
        if resistance.len() > 1 {
            let label = format!("{label}, h/l = {:.2}", point[0]);
            self.resistances.push((label, resistance.to_vec()));
        }
        Ok(())
    }

    pub(super) fn finish(&self, folder: Option<&Path>) -> Result<(), StudyError> {
        let Some(folder) = folder else {
            return Ok(());
        };
        let mut plot = LinePlot::new("J far from the tip at the first failure")
            .x_label("spacing over the length of the process zone [1]")
            .y_label("J/G_c [1]");
        let mut chart = ErrorChart::new(
            "Apparent toughness against run time",
            "wall time [s]",
            "J/G_c - 1",
        );
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
