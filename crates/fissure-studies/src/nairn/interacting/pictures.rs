//! Where cracks ended (fig. 7), and the plate around them.

use std::path::Path;

use fissure::io::plot::{LinePlot, Style};
use fissure::prelude::*;
use fissure_study::{Parameters, StudyError};

use crate::drawing::save;
use crate::nairn::failed::Places;
use crate::nairn::pictures::Snapshot;

/// Stress at the ends of the colours, Pa.
const STRESS: f64 = 30e6;

/// Lines and failed particles of a run, at rest.
pub(super) struct Paths {
    label: String,
    lines: Vec<Vec<Vector2<f64>>>,
    failed: Vec<Vector2<f64>>,
    /// Stress along the load of a plate of lines, damage of the other.
    plate: Snapshot,
    size: f64,
}

impl Paths {
    pub(super) fn of(
        case: &Parameters,
        scene: &Scene<2>,
        places: &Places<2>,
    ) -> Result<Self, StudyError> {
        let body = scene.bodies().first();
        let (mode, time) = (case.choice("mode")?, 1e6 * scene.time());
        let plate = if mode == "explicit" {
            Snapshot::of_stress(format!("Axial stress at {time:.0} µs"), scene, 1)
        } else {
            let title = format!("Damage in opening at {time:.0} µs");
            Snapshot::of(title, scene, "normal_damage", None)
        };
        Ok(Self {
            label: mode.to_owned(),
            plate,
            size: 0.5 * case.number("h")?,
            lines: scene
                .cracks()
                .iter()
                .map(|crack| crack.placed().to_vec())
                .collect(),
            failed: body.map_or_else(Vec::new, |body| places.failed(body)),
        })
    }

    fn draw_plate(&self, folder: &Path) -> Result<(), StudyError> {
        let (label, range) = match self.label.as_str() {
            "explicit" => ("σ_yy [Pa]", (-STRESS, STRESS)),
            _ => ("damage [1]", (0.0, 1.0)),
        };
        let path = folder.join(format!("{}-plate.png", self.label));
        self.plate.draw(label, range, self.size, &path)
    }

    /// All runs in one picture, and the plate of each.
    pub(super) fn draw(runs: &[Self], folder: &Path) -> Result<(), StudyError> {
        let mut plot = LinePlot::new("Where two cracks went")
            .x_label("x [m]")
            .y_label("y [m]")
            .size(700, 900);
        for run in runs {
            run.draw_plate(folder)?;
            let axis = |axis: usize, points: &[Vector2<f64>]| -> Vec<f64> {
                points.iter().map(|x| x[axis]).collect()
            };
            if !run.failed.is_empty() {
                let (x, y) = (axis(0, &run.failed), axis(1, &run.failed));
                plot = plot.series("failed particles", x, y, Style::Markers);
            }
            for (line, name) in run.lines.iter().zip(["first", "second"]) {
                let label = format!("{}: {name} crack", run.label);
                plot = plot.series(&label, axis(0, line), axis(1, line), Style::Line);
            }
        }
        save(plot, &folder.join("paths.png"))
    }
}
