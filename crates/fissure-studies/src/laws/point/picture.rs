//! Stress over strain of the component that is strained the most.

use std::path::Path;

use fissure::io::plot::{LinePlot, Style};
use fissure::materials::EventKind;

use super::components;
use fissure_laws::{Followed, Reached};
use fissure_study::StudyError;

/// Draws the picture, with the events as markers.
pub(super) fn draw(law: &str, followed: &Followed, path: &Path) -> Result<(), StudyError> {
    let chosen = widest(&followed.samples);
    let strain = |reached: &Reached| components(&reached.strain)[chosen].1;
    let stress = |reached: &Reached| components(&reached.turned_stress)[chosen].1;
    let start = std::iter::once(0.0);
    let strains: Vec<f64> = start
        .clone()
        .chain(followed.samples.iter().map(strain))
        .collect();
    let stresses: Vec<f64> = start.chain(followed.samples.iter().map(stress)).collect();
    let name = components(&followed.samples[0].strain)[chosen].0;
    let mut plot = LinePlot::new(&format!("One point: {law}"))
        .x_label(&format!("strain {name} [-]"))
        .y_label(&format!("stress {name} [Pa]"))
        .series(law, &strains, &stresses, Style::Line);
    for (kind, label) in [
        (EventKind::Initiation, "initiation"),
        (EventKind::Failure, "failure"),
        (EventKind::Contact, "contact"),
    ] {
        let events = followed.events.iter().filter(|event| event.kind == kind);
        let (xs, ys): (Vec<f64>, Vec<f64>) = events
            .map(|event| (strain(&event.reached), stress(&event.reached)))
            .unzip();
        if !xs.is_empty() {
            plot = plot.series(label, xs, ys, Style::Markers);
        }
    }
    plot.save(path)
        .map_err(StudyError::failed(format!("drawing {}", path.display())))
}

/// The component of the largest strain.
fn widest(samples: &[Reached]) -> usize {
    let mut largest = [0.0_f64; 6];
    for reached in samples {
        for (largest, (_, value)) in largest.iter_mut().zip(components(&reached.strain)) {
            *largest = largest.max(value.abs());
        }
    }
    let order = |a: &usize, b: &usize| largest[*a].total_cmp(&largest[*b]);
    (0..6).rev().max_by(order).unwrap_or(0)
}
