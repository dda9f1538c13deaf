//! Pulling the notched plate: a row per case.

use fissure::prelude::*;
use fissure_study::{Measures, Parameters, Report as Rows, SimulationRow, StudyError};

use super::growth::Growth;
use super::pictures::Pictures;
use super::{damage, line};
use crate::nairn::drive::{Drive, energies, row};
use crate::nairn::many;
use crate::nairn::numerics::check_whole_cells;
use crate::nairn::pictures::Snapshot;
use crate::nairn::plate::{Plate, THICKNESS};

/// When the stress is drawn, s (fig. 6).
const DRAWN: f64 = 77e-6;
/// Onset of the document's explicit crack, s.
const DOCUMENT: f64 = 54e-6;
/// Onset (s) and speed (m/s) of the independent code on 1 mm cells: damage with 30 MPa and 600 J/m², and a line that
/// grows at 2000 J/m².
const REFERENCE: [(f64, f64); 2] = [(54.5566e-6, 571.0), (55.1e-6, 480.0)];

pub(super) struct Finished {
    pub row: SimulationRow,
    pub growth: Growth,
    pub seen: Seen,
    pub stopped: Option<String>,
}

/// What pictures show of a run beside the growth.
#[derive(Default)]
pub(super) struct Seen {
    /// The stress at the time of the document's figure.
    pub snapshot: Option<Snapshot>,
    /// How far the ends have gone apart, m, and their load, N, after each step.
    pub load: Vec<[f64; 2]>,
}

impl Seen {
    /// Looks at a scene after a step.
    pub(super) fn look(&mut self, plate: &Plate, scene: &Scene<2>) {
        self.load.push(plate.load(scene));
        let time = scene.time();
        if self.snapshot.is_none() && time >= DRAWN {
            let title = format!("Axial stress at {:.0} µs", 1e6 * time);
            self.snapshot = Some(Snapshot::of_stress(title, scene, 1));
        }
    }
}

pub(super) fn run(cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    let mut pictures = Pictures::new(rows.out_dir());
    for case in cases {
        check_whole_cells(case, &["width", "height", "crack"])?;
    }
    let drawing = rows.out_dir().is_some();
    many::in_order(
        cases,
        rows,
        |case| match case.choice("mode")? {
            "explicit" => line::pull(case, drawing),
            _ => damage::pull(case, drawing),
        },
        |rows, case, finished| {
            rows.row(finished.row.clone())?;
            if let Some(reason) = &finished.stopped {
                rows.note(&format!("the run above stopped early: {reason}"))?;
            }
            pictures.add(case, &finished)
        },
    )?;
    pictures.finish()
}

/// A row with onset, speed, length and energies.
pub(super) fn row_of(
    case: &Parameters,
    plate: &Plate,
    scene: &Scene<2>,
    growth: &Growth,
    done: &Drive,
) -> Result<SimulationRow, StudyError> {
    let explicit = case.choice("mode")? == "explicit";
    let mut row = row("edge-notch", case, scene, done);
    row.threads = 1;
    let length = growth.tip.last().copied().unwrap_or(plate.crack);
    let (from, to) = plate.measured();
    let (onset, speed) = (growth.onset(), growth.speed(from, to));
    row.errors = Measures::new();
    if plate.is_documents() {
        row.errors.insert("onset", (onset / DOCUMENT - 1.0).abs());
        let compared = if explicit {
            plate.toughness == 2000.0
        } else {
            plate.has_documents_damage()
        };
        if compared {
            let (its_onset, its_speed) = REFERENCE[usize::from(explicit)];
            row.errors
                .insert("onset_reference", (onset / its_onset - 1.0).abs());
            row.errors
                .insert("speed_reference", (speed / its_speed - 1.0).abs());
        }
    }
    row.values = Measures::new()
        .with("onset_us", 1e6 * onset)
        .with("speed_m_s", speed)
        .with("length_mm", 1e3 * length);
    // A line dissipates nothing in the body: what its tip released went into waves.
    if !explicit {
        let area = (length - plate.crack) * THICKNESS;
        let spent = scene.energy().dissipated / area;
        row.values.insert("dissipated_per_area", spent);
    }
    row.values = energies(row.values, scene);
    Ok(row)
}
