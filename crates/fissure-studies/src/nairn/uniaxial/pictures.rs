//! Pictures of the bars, if they are asked for: stress-strain curves (fig. 3) and necks (fig. 4).

use std::path::{Path, PathBuf};

use fissure::io::plot::{LinePlot, Style};
use fissure_study::{Parameters, StudyError};

use super::bar::Bar;
use super::run::{Finished, reference};
use crate::convergence::ErrorChart;
use crate::drawing::save;
use crate::nairn::numerics::Numerics;
use crate::nairn::pictures::{ROWS, thinned, varied, write_columns};
use crate::nairn::reference::Curve;

pub(super) struct Pictures {
    folder: Option<PathBuf>,
    curves: Vec<(String, String, Vec<f64>, Vec<f64>)>,
    references: Vec<(String, Vec<f64>, Vec<f64>)>,
    /// Of each kind of bar: they are worth a picture each.
    times: [(&'static str, ErrorChart); KINDS.len()],
}

/// Kinds of bars that are compared among themselves.
const KINDS: [&str; 4] = ["tension", "necking", "compression", "space"];

/// The kind of a case.
fn kind_of(case: &str) -> &str {
    match case {
        "rectangle" | "square" | "circle" => "space",
        other => other,
    }
}

fn chart(kind: &str) -> ErrorChart {
    let title = format!("Error of the peak load against run time: {kind}");
    ErrorChart::over_time(&title, "error of the peak").scattered()
}

impl Pictures {
    pub(super) fn new(folder: Option<&Path>) -> Self {
        Self {
            folder: folder.map(Path::to_path_buf),
            curves: Vec::new(),
            references: Vec::new(),
            times: KINDS.map(|kind| (kind, chart(kind))),
        }
    }

    /// Writes the curve of a run and draws the bar at some strains.
    pub(super) fn add(
        &mut self,
        bar: &Bar,
        numerics: &Numerics,
        case: &Parameters,
        finished: &Finished,
    ) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        let kind = case.choice("case")?;
        let choices = ["plane", "band", "measure", "planes", "cracks"];
        let usual = ["strain", "particle", "conjugate", "any", "one"];
        let varied = varied(case, &choices, &usual)?;
        let scheme = [case.choice("shape")?, case.choice("transfer")?];
        let name = [&[kind], &scheme[..], &varied.file].concat().join("-");
        let row = &finished.row;
        let error = row.errors.get("peak").unwrap_or(f64::NAN);
        let own = kind_of(kind);
        let mut label = [&scheme[..], &varied.label].concat();
        if own != kind {
            label.insert(0, kind);
        }
        for (_, chart) in self.times.iter_mut().filter(|(known, _)| *known == own) {
            chart.add(&label.join("-"), row.wall_s, error);
        }
        let history = &finished.history;
        let thin = |column: &[f64]| thinned(column, ROWS);
        let (strain, stress) = (thin(&history.strain), thin(&history.stress));
        write_columns(
            &folder.join(format!("{name}.csv")),
            &[
                ("time [s]", &thin(&history.time)),
                ("strain", &strain),
                ("mean_stress [Pa]", &stress),
                ("dissipated [J]", &thin(&history.dissipated)),
                ("imbalance [J]", &thin(&history.imbalance)),
                ("transfer_loss [J]", &thin(&history.transfer_loss)),
            ],
        )?;
        let label = match kind {
            "tension" | "necking" | "compression" => "damage [1]",
            _ => "damage [1], a slice",
        };
        for (ending, snapshot) in &history.snapshots {
            let path = folder.join(format!("{name}-{ending}.png"));
            snapshot.draw(label, (0.0, 1.0), 0.5 * numerics.spacing, &path)?;
        }
        if let Some((text, _)) = reference(bar, case) {
            let curve = Curve::read(text, kind, "time", "mean_stress")?;
            let strain = curve.x.iter().map(|t| t * bar.speed / bar.length).collect();
            let label = format!("{kind}, independent code");
            if case.choice("plane")? == "strain" && !self.references.iter().any(|r| r.0 == label) {
                self.references.push((label, strain, curve.y));
            }
        }
        let magnitude = |column: &[f64]| column.iter().map(|v| v * bar.speed.signum()).collect();
        self.curves.push((
            kind.to_owned(),
            name,
            magnitude(&strain),
            magnitude(&stress),
        ));
        Ok(())
    }

    /// Draws the curves of all runs: of the plane and in space, and of each kind.
    pub(super) fn finish(&self) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        for kind in ["tension", "necking"] {
            let chosen = |k: &str| k == kind;
            self.draw(&format!("stress-{kind}.png"), folder, &chosen, false)?;
        }
        let plane = |k: &str| matches!(k, "tension" | "necking" | "compression");
        self.draw("stress-plane.png", folder, &plane, true)?;
        let solid = |k: &str| kind_of(k) == "space";
        self.draw("stress-space.png", folder, &solid, true)?;
        for (kind, chart) in &self.times {
            chart.save(&folder.join(format!("error-against-time-{kind}.png")))?;
        }
        Ok(())
    }

    fn draw(
        &self,
        file: &str,
        folder: &Path,
        chosen: &dyn Fn(&str) -> bool,
        first_of_kind: bool,
    ) -> Result<(), StudyError> {
        let mut plot = LinePlot::new("Mean stress of the bar against nominal strain")
            .x_label("nominal strain [1]")
            .y_label("mean Kirchhoff stress, positive along the load [Pa]");
        let mut drawn: Vec<&str> = Vec::new();
        for (kind, name, strain, stress) in &self.curves {
            if !chosen(kind) || (first_of_kind && drawn.contains(&kind.as_str())) {
                continue;
            }
            drawn.push(kind);
            plot = plot.series(name, strain, stress, Style::Line);
        }
        if drawn.is_empty() {
            return Ok(());
        }
        for (label, strain, stress) in &self.references {
            if label
                .split(',')
                .next()
                .is_some_and(|kind| drawn.contains(&kind))
            {
                plot = plot.series(label, strain, stress, Style::Dashed);
            }
        }
        save(plot, &folder.join(file))
    }
}
