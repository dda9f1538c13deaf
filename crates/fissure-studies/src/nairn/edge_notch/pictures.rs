//! Crack length and speed against time (figs 5B, 6C), stress about the tip (fig. 6B), load over the distance of the ends,
//! if asked for.

use std::path::{Path, PathBuf};

use fissure::io::plot::{LinePlot, Style};
use fissure_study::{Parameters, StudyError};

use super::growth::Growth;
use super::run::Finished;
use crate::convergence::ErrorChart;
use crate::drawing::save;
use crate::nairn::pictures::{Loads, varied, write_columns};
use crate::nairn::reference::Curve;

pub(super) struct Pictures {
    folder: Option<PathBuf>,
    runs: Vec<(String, Growth)>,
    loads: Loads,
    times: ErrorChart,
}

/// What a run is called: without its spacing, with it, and in its files.
struct Names {
    scheme: String,
    label: String,
    file: String,
}

impl Names {
    fn of(case: &Parameters) -> Result<Self, StudyError> {
        let toughness = case.number("toughness")?;
        let (mut scheme, mut file) = if case.choice("mode")? == "explicit" {
            let scheme = format!("line, {toughness:.0} J/m²");
            (scheme, format!("line-{toughness:.0}"))
        } else {
            let strength = 1e-6 * case.number("strength")?;
            let scheme = format!("{strength:.0} MPa, {toughness:.0} J/m²");
            (scheme, format!("{strength:.0}-MPa-{toughness:.0}"))
        };
        let choices = ["band", "notch", "line", "transfer", "shape"];
        let usual = ["particle", "gap", "cells", "xpic", "gimp"];
        let varied = varied(case, &choices, &usual)?;
        for value in varied.label {
            scheme = format!("{scheme}, {value}");
        }
        for value in varied.file {
            file = format!("{file}-{value}");
        }
        let mut label = scheme.clone();
        if case.varying().contains(&"h") {
            let h = 1e3 * case.number("h")?;
            label = format!("{scheme}, h = {h} mm");
            file = format!("{file}-h-{h}");
        }
        Ok(Self {
            scheme,
            label,
            file,
        })
    }
}

impl Pictures {
    pub(super) fn new(folder: Option<&Path>) -> Self {
        Self {
            folder: folder.map(Path::to_path_buf),
            runs: Vec::new(),
            loads: Loads::default(),
            times: ErrorChart::over_time(
                "Error of the onset (54 µs) against run time",
                "error of the onset",
            ),
        }
    }

    pub(super) fn add(&mut self, case: &Parameters, finished: &Finished) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        let names = Names::of(case)?;
        let file = |ending: &str| folder.join(format!("{}{ending}", names.file));
        let growth = &finished.growth;
        write_columns(
            &file(".csv"),
            &[("time [s]", &growth.time), ("tip [m]", &growth.tip)],
        )?;
        let loads = &finished.seen.load;
        self.loads.add(&names.label, loads, &file("-load.csv"))?;
        if let Some(snapshot) = &finished.seen.snapshot {
            let size = 0.5 * case.number("h")?;
            let range = (0.0, case.number("strength")?);
            snapshot.draw("σ_yy [Pa]", range, size, &file("-stress.png"))?;
        }
        let row = &finished.row;
        let error = row.errors.get("onset").unwrap_or(f64::NAN);
        self.times.add(&names.scheme, row.wall_s, error);
        self.runs.push((names.label, growth.clone()));
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
        self.loads.save(&folder.join("load.png"))?;
        self.times.save(&folder.join("error-against-time.png"))
    }
}
