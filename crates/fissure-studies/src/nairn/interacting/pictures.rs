//! Where cracks ended (fig. 7).

use std::path::Path;

use fissure::io::plot::{LinePlot, Style};
use fissure::prelude::*;
use fissure_study::{Parameters, StudyError};

use crate::nairn::failed::Places;
use crate::nairn::pictures::save;

/// Lines and failed particles of a run, at rest.
pub(super) struct Paths {
    label: String,
    lines: Vec<Vec<Vector2<f64>>>,
    failed: Vec<Vector2<f64>>,
}

impl Paths {
    pub(super) fn of(
        case: &Parameters,
        scene: &Scene<2>,
        places: &Places<2>,
    ) -> Result<Self, StudyError> {
        let body = scene.bodies().first();
        Ok(Self {
            label: case.choice("mode")?.to_owned(),
            lines: scene
                .cracks()
                .iter()
                .map(|crack| crack.placed().to_vec())
                .collect(),
            failed: body.map_or_else(Vec::new, |body| places.failed(body)),
        })
    }

    /// All runs in one picture.
    pub(super) fn draw(runs: &[Self], folder: &Path) -> Result<(), StudyError> {
        let mut plot = LinePlot::new("Where two cracks went")
            .x_label("x [m]")
            .y_label("y [m]")
            .size(700, 900);
        for run in runs {
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
