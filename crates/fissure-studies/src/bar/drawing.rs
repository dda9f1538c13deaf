//! What the studies of the bar draw and write alike.

use std::path::Path;

use fissure::io::plot::ScatterPlot;
use fissure::io::table::{Cell, Table};
use fissure::prelude::*;

use fissure_study::StudyError;

use super::exact::Exact;
use super::history::Thinned;
use super::specimen::{BODY, Bar};

/// Rows of a curve in pictures and tables.
pub(crate) const ROWS: usize = 400;

impl Thinned {
    /// Writes the curves as a table.
    pub(crate) fn write(&self, path: &Path) -> Result<(), StudyError> {
        let failed = || StudyError::failed(format!("writing {}", path.display()));
        let columns = [
            "elongation [m]",
            "load [N]",
            "work [J]",
            "stored [J]",
            "dissipated [J]",
        ];
        let mut table = Table::new(&columns).map_err(failed())?;
        for i in 0..self.elongation.len() {
            let row = [
                self.elongation[i],
                self.load[i],
                self.work[i],
                self.stored[i],
                self.dissipated[i],
            ];
            table.row(row.map(Cell::Number)).map_err(failed())?;
        }
        table.write(path).map_err(failed())
    }
}

/// An exact curve up to 1.25 critical openings.
pub(crate) fn sampled(exact: &Exact, curve: fn(&Exact, f64) -> f64) -> (Vec<f64>, Vec<f64>) {
    let end = 1.25 * exact.critical_opening();
    let x: Vec<f64> = (0..=ROWS).map(|i| end * i as f64 / ROWS as f64).collect();
    let y = x.iter().map(|x| curve(exact, *x)).collect();
    (x, y)
}

/// The bar coloured by the opening of its crack.
pub(crate) fn draw_bar(bar: &Bar, scene: &Scene<2>, path: &Path) -> Result<(), StudyError> {
    let Some(body) = scene.body(BODY) else {
        return Ok(());
    };
    let points: Vec<[f64; 2]> = body.motion().position.iter().map(|x| [x.x, x.y]).collect();
    let critical = bar.exact().critical_opening();
    let openings = body.value("opening").unwrap_or_default();
    let openings: Vec<f64> = openings.iter().map(|opening| opening / critical).collect();
    ScatterPlot::new("Opening of the crack", &points)
        .colour("opening over critical opening [1]", openings)
        .range(0.0, 1.0)
        .particle_size(0.5 * bar.spacing)
        .labels("x [m]", "y [m]")
        .save(path)
        .map_err(StudyError::failed("drawing the bar"))
}
