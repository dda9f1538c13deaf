//! Crack density against strain (fig. 8B) and the cracked coating (fig. 8A), if they are asked for.

use std::path::{Path, PathBuf};

use fissure::io::plot::{LinePlot, Style};
use fissure_study::{Parameters, StudyError};

use super::run::Finished;
use crate::convergence::ErrorChart;
use crate::drawing::save;
use crate::nairn::pictures::write_columns;

pub(super) struct Pictures {
    folder: Option<PathBuf>,
    reference: Vec<[f64; 2]>,
    /// Name of the transfer, and the runs with it.
    groups: Vec<(String, Vec<Vec<[f64; 2]>>)>,
    end: f64,
    times: ErrorChart,
}

impl Pictures {
    pub(super) fn new(folder: Option<&Path>, reference: &[[f64; 2]]) -> Self {
        Self {
            folder: folder.map(Path::to_path_buf),
            reference: reference.to_vec(),
            groups: Vec::new(),
            end: 0.0,
            times: ErrorChart::over_time(
                "Error of the count, over what is allowed, against run time",
                "largest difference of the count",
            )
            .scattered(),
        }
    }

    /// Writes what a run left and draws its specimen.
    pub(super) fn add(&mut self, case: &Parameters, finished: &Finished) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        self.end = self.end.max(case.number("strain")?);
        let transfer = case.choice("transfer")?;
        let mut label = match transfer {
            "xpic" | "fmpm" => format!("{transfer}-{}", case.count("order")?),
            _ => transfer.to_owned(),
        };
        for other in ["shape", "band", "stress"] {
            if case.varying().contains(&other) {
                label = format!("{label}-{}", case.choice(other)?);
            }
        }
        let name = format!("{label}-seed-{}", case.count("seed")?);
        let row = &finished.row;
        let error = row.errors.get("count").unwrap_or(f64::NAN);
        self.times.add(&label, row.wall_s, error);
        let (strain, count) = stairs(&finished.count.cracks, self.end);
        write_columns(
            &folder.join(format!("{name}.csv")),
            &[("strain", &strain), ("cracks", &count)],
        )?;
        let size = 0.5 * case.number("h")?;
        let first = !self.groups.iter().any(|(known, _)| *known == label);
        for (number, snapshot) in finished.snapshots.iter().enumerate().filter(|_| first) {
            let path = folder.join(format!("{name}-{}.png", number + 1));
            snapshot.draw("damage [1]", (0.0, 1.0), size, &path)?;
        }
        match self.groups.iter_mut().find(|(known, _)| *known == label) {
            Some((_, curves)) => curves.push(finished.count.cracks.clone()),
            None => self
                .groups
                .push((label, vec![finished.count.cracks.clone()])),
        }
        Ok(())
    }

    pub(super) fn finish(&self) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        let mut plot = LinePlot::new("Cracks of the coating")
            .x_label("nominal strain [1]")
            .y_label("cracks [1]");
        for (label, curves) in &self.groups {
            let slices: Vec<&[[f64; 2]]> = curves.iter().map(Vec::as_slice).collect();
            let (x, y) = stairs(&super::count::mean(&slices), self.end);
            let label = match curves.len() {
                1 => label.clone(),
                number => format!("{label}, mean of {number}"),
            };
            plot = plot.series(&label, x, y, Style::Line);
        }
        let (x, y) = stairs(&self.reference, self.end);
        let plot = plot.series("independent code, xpic-5", x, y, Style::Dashed);
        save(plot, &folder.join("cracks.png"))?;
        self.times.save(&folder.join("error-against-time.png"))
    }
}

/// The corners of a curve of steps up to `end`.
fn stairs(steps: &[[f64; 2]], end: f64) -> (Vec<f64>, Vec<f64>) {
    let (mut x, mut y) = (vec![0.0], vec![0.0]);
    for step in steps.iter().filter(|step| step[0] <= end) {
        x.extend([step[0], step[0]]);
        y.extend([y[y.len() - 1], step[1]]);
    }
    x.push(end);
    y.push(y[y.len() - 1]);
    (x, y)
}
