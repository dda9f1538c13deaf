//! Crack length and speed against time (figs 5B, 6C), stress about the tip (fig. 6B), if asked for.

use std::path::{Path, PathBuf};

use fissure::io::plot::{LinePlot, Style};
use fissure_study::{Parameters, StudyError};

use super::growth::Growth;
use super::run::Finished;
use crate::convergence::ErrorChart;
use crate::nairn::pictures::{save, write_columns};
use crate::nairn::reference::Curve;

pub(super) struct Pictures {
    folder: Option<PathBuf>,
    runs: Vec<(String, Growth)>,
    times: ErrorChart,
}

impl Pictures {
    pub(super) fn new(folder: Option<&Path>) -> Self {
        Self {
            folder: folder.map(Path::to_path_buf),
            runs: Vec::new(),
            times: ErrorChart::new(
                "Error of the onset (54 µs) against run time",
                "wall time [s]",
                "error of the onset",
            )
            .scattered(),
        }
    }

    pub(super) fn add(&mut self, case: &Parameters, finished: &Finished) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        let (strength, toughness) = (case.number("strength")?, case.number("toughness")?);
        let explicit = case.choice("mode")? == "explicit";
        let (mut label, mut name) = if explicit {
            let label = format!("line, {toughness:.0} J/m²");
            (label, format!("line-{toughness:.0}"))
        } else {
            let strength = 1e-6 * strength;
            let label = format!("{strength:.0} MPa, {toughness:.0} J/m²");
            (label, format!("{strength:.0}-MPa-{toughness:.0}"))
        };
        if case.varying().contains(&"h") {
            let h = 1e3 * case.number("h")?;
            label = format!("{label}, h = {h} mm");
            name = format!("{name}-h-{h}");
        }
        for other in ["band", "notch", "line", "transfer", "shape"] {
            if case.varying().contains(&other) {
                let value = case.choice(other)?;
                let usual = matches!(value, "particle" | "gap" | "cells" | "xpic" | "gimp");
                if !usual {
                    label = format!("{label}, {value}");
                }
                name = format!("{name}-{value}");
            }
        }
        let growth = &finished.growth;
        write_columns(
            &folder.join(format!("{name}.csv")),
            &[("time [s]", &growth.time), ("tip [m]", &growth.tip)],
        )?;
        if let Some(snapshot) = &finished.snapshot {
            let path = folder.join(format!("{name}-stress.png"));
            let size = 0.5 * case.number("h")?;
            snapshot.draw("σ_yy [Pa]", (0.0, strength), size, &path)?;
        }
        let row = &finished.row;
        let error = row.errors.get("onset").unwrap_or(f64::NAN);
        self.times.add(&label, row.wall_s, error);
        self.runs.push((label, growth.clone()));
        Ok(())
    }

    pub(super) fn finish(&self) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        if self.runs.is_empty() {
            return Ok(());
        }
        let damage = Curve::read(
            include_str!("../../../tests/data/nairn/notch_damage.csv"),
            "edge-notch",
            "time",
            "tip",
        )?;
        let explicit = Curve::read(
            include_str!("../../../tests/data/nairn/notch_explicit.csv"),
            "edge-notch",
            "time",
            "tip",
        )?;
        let mut length = LinePlot::new("Length of the crack")
            .x_label("time [s]")
            .y_label("tip [m]");
        let mut speed = LinePlot::new("Speed of the crack, within 2 mm of its tip")
            .x_label("time [s]")
            .y_label("speed [m/s]");
        for (label, growth) in &self.runs {
            if growth.time.is_empty() {
                continue;
            }
            length = length.series(label, &growth.time, &growth.tip, Style::Line);
            speed = speed.series(label, &growth.time, growth.speeds(2e-3), Style::Line);
        }
        length = length
            .series(
                "independent code, damage, 30 MPa, 600 J/m²",
                damage.x,
                damage.y,
                Style::Dashed,
            )
            .series(
                "independent code, explicit crack",
                explicit.x,
                explicit.y,
                Style::Dotted,
            );
        save(length, &folder.join("length.png"))?;
        save(speed, &folder.join("speed.png"))?;
        self.times.save(&folder.join("error-against-time.png"))
    }
}
