//! A field and a failed block (fig. 9), mean and deviation against the grid (fig. 10), all curves on
//! the finest grid (fig. 11), and how the interval of the mean shrinks with the time that samples take.

use std::path::Path;

use fissure::io::plot::{LinePlot, Style};
use fissure_study::StudyError;

use super::run::Set;
use super::statistics::Moments;
use crate::convergence::ErrorChart;
use crate::drawing::save;

const FIELDS: [&str; 2] = ["uncorrelated", "correlated"];

pub(super) fn draw(folder: &Path, sets: &[Set]) -> Result<(), StudyError> {
    for set in sets {
        let name = format!("{}-h-{}-mm", set.field(), 1e3 * set.spacing());
        let snapshots = set.all().flat_map(|sample| &sample.snapshots);
        let kinds = [
            ("field", "factor [1]", (0.7, 1.3)),
            ("failed", "damage [1]", (0.0, 1.0)),
        ];
        for (snapshot, (kind, label, range)) in snapshots.zip(kinds) {
            let path = folder.join(format!("{name}-{kind}.png"));
            snapshot.draw(label, range, 0.5 * set.spacing(), &path)?;
        }
    }
    strengths(folder, sets)?;
    curves(folder, sets)?;
    intervals(folder, sets)
}

/// Half the 95 % interval of the mean over the mean, of ever more samples, against the time that they took.
fn intervals(folder: &Path, sets: &[Set]) -> Result<(), StudyError> {
    let mut chart = ErrorChart::over_time(
        "Interval of the mean strength against run time",
        "half the 95 % interval over the mean",
    );
    for set in sets {
        let label = format!("{}, h = {} mm", set.field(), 1e3 * set.spacing());
        let (mut strengths, mut spent) = (Vec::new(), 0.0);
        for sample in set.all() {
            strengths.push(sample.strength);
            spent += sample.wall_s;
            if strengths.len() > 1 {
                let moments = Moments::of(&strengths);
                chart.add(&label, spent, moments.mean_interval() / moments.mean);
            }
        }
    }
    chart.save(&folder.join("error-against-time.png"))
}

/// Mean and one standard deviation to either side.
fn strengths(folder: &Path, sets: &[Set]) -> Result<(), StudyError> {
    let mut plot =
        LinePlot::new("Strength of the block: mean, and one standard deviation about it")
            .x_label("grid spacing [m]")
            .y_label("strength [Pa]");
    for field in FIELDS {
        let mut own: Vec<&Set> = sets.iter().filter(|set| set.field() == field).collect();
        own.sort_by(|a, b| a.spacing().total_cmp(&b.spacing()));
        let h: Vec<f64> = own.iter().map(|set| set.spacing()).collect();
        let line = |offset: f64| -> Vec<f64> {
            let moments = own.iter().map(|set| set.moments());
            moments.map(|m| m.mean + offset * m.deviation).collect()
        };
        if h.is_empty() {
            continue;
        }
        plot = plot
            .series(field, h.clone(), line(0.0), Style::LineAndMarkers)
            .series(
                &format!("{field}, ± 1 s"),
                h.clone(),
                line(1.0),
                Style::Dashed,
            )
            .series("", h, line(-1.0), Style::Dashed);
    }
    save(plot, &folder.join("strength.png"))
}

fn curves(folder: &Path, sets: &[Set]) -> Result<(), StudyError> {
    let mut plot = LinePlot::new("Every block on the finest grid")
        .x_label("nominal compressive strain [1]")
        .y_label("mean compressive stress [Pa]");
    for field in FIELDS {
        let own = sets.iter().filter(|set| set.field() == field);
        let Some(finest) = own.min_by(|a, b| a.spacing().total_cmp(&b.spacing())) else {
            continue;
        };
        let (mut x, mut y) = (Vec::new(), Vec::new());
        for sample in finest.all() {
            x.extend(sample.curve.iter().map(|point| point[0]));
            y.extend(sample.curve.iter().map(|point| point[1]));
            // A gap between one block and the next.
            x.push(f64::NAN);
            y.push(f64::NAN);
        }
        plot = plot.series(field, x, y, Style::Line);
    }
    save(plot, &folder.join("curves.png"))
}
