//! Two cracks in a plate: a row per case.

use fissure::prelude::*;
use fissure_study::{Measures, Parameters, Report as Rows, SimulationRow, StudyError};

use super::pictures::Paths;
use crate::nairn::drive::{drive_growing, energies, row};
use crate::nairn::failed::Places;
use crate::nairn::many;
use crate::nairn::numerics::{Numerics, check_whole_cells};
use crate::nairn::plate::{BODY, Notch, Plate};
use crate::nairn::tips::Tips;

/// How far from where a crack was a failed particle counts as its growth, in cells.
const NEAR: f64 = 4.0;

/// What was seen of the cracks' growth.
#[derive(Default)]
struct Seen {
    onset: f64,
    arrest: f64,
    restart: f64,
}

struct Finished {
    row: SimulationRow,
    paths: Paths,
    stopped: Option<String>,
}

pub(super) fn run(cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    for case in cases {
        check_whole_cells(case, &["width", "height", "crack"])?;
    }
    let folder = rows.out_dir().map(std::path::Path::to_path_buf);
    let mut drawn = Vec::new();
    many::in_order(cases, rows, pull, |rows, _, finished| {
        rows.row(finished.row)?;
        if let Some(reason) = &finished.stopped {
            rows.note(&format!("the run above stopped early: {reason}"))?;
        }
        drawn.push(finished.paths);
        Ok(())
    })?;
    folder.map_or(Ok(()), |folder| Paths::draw(&drawn, &folder))
}

fn pull(case: &Parameters) -> Result<Finished, StudyError> {
    let explicit = case.choice("mode")? == "explicit";
    let numerics = Numerics::of(case)?;
    let plate = Plate::new(case, Notch::Line)?;
    let end = case.number("end")?;
    let mut scene = if explicit {
        plate.elastic()?
    } else {
        plate.damaged(case, true)?
    };
    let second = second(case, &plate)?;
    let across = second.map(|x| [x.x, x.y]);
    scene
        .crack("second", &across, CrackSettings::default())
        .map_err(StudyError::failed("putting the second crack"))?;
    let mut solver = numerics.solver(plate.grid(end)?)?;
    let mut tips = Tips::of(case, &plate)?;
    let places = scene
        .body(BODY)
        .map(Places::of)
        .ok_or_else(|| StudyError::failed("finding the plate")("no such body"))?;
    let nothing = f64::NAN;
    let mut seen = Seen {
        onset: nothing,
        arrest: nothing,
        restart: nothing,
    };
    let first_of = |known: &mut f64, time: f64| {
        if known.is_nan() {
            *known = time;
        }
    };
    let cell = plate.spacing;
    let done = drive_growing(&mut scene, solver.as_mut(), end, |scene, report| {
        let time = report.time;
        if explicit {
            for grown in tips.ask(scene)? {
                match grown.crack {
                    0 => first_of(&mut seen.onset, time),
                    _ => first_of(&mut seen.restart, time),
                }
                if grown.arrested_by.is_some() {
                    first_of(&mut seen.arrest, time);
                }
            }
            return Ok(true);
        }
        let failed = scene.body(BODY).map(|body| places.failed(body));
        for x in failed.unwrap_or_default() {
            if second.iter().any(|tip| (x - tip).norm() < NEAR * cell) {
                first_of(&mut seen.restart, time);
            } else if plate.is_ahead(&x) {
                first_of(&mut seen.onset, time);
                if x.x > second[0].x - 1.5 * cell {
                    first_of(&mut seen.arrest, time);
                }
            }
        }
        Ok(true)
    })?;
    let mut row = row("interacting-cracks", case, &scene, &done);
    row.threads = 1;
    row.values = Measures::new()
        .with("onset_us", 1e6 * seen.onset)
        .with("arrest_us", 1e6 * seen.arrest)
        .with("restart_us", 1e6 * seen.restart);
    let paths = Paths::of(case, &scene, &places)?;
    if explicit {
        for (end, name) in [(End::First, "lower"), (End::Last, "upper")] {
            // Where the tip was when it was put there: the plate has moved since.
            let placed = scene.cracks()[1].placed();
            let tip = match end {
                End::First => placed[0],
                End::Last => placed[placed.len() - 1],
            };
            let start = second[usize::from(end == End::Last)];
            row.values
                .insert(format!("{name}_growth_mm"), 1e3 * (tip - start).norm());
            let way = tip - start;
            let angle = way.y.abs().atan2(way.x).to_degrees();
            row.values.insert(format!("{name}_angle_deg"), angle);
            let release = tips.release(&scene, 1, end);
            row.values.insert(format!("{name}_j"), release);
        }
    }
    row.values = energies(row.values, &scene);
    Ok(Finished {
        row,
        paths,
        stopped: done.stopped,
    })
}

/// Lower and upper tip of the second crack, m.
fn second(case: &Parameters, plate: &Plate) -> Result<[Vector2<f64>; 2], StudyError> {
    let (half, x) = (0.5 * case.number("second")?, case.number("place")?);
    let inside = x > plate.crack && x < plate.width && half < 0.4 * plate.height;
    if !inside {
        return Err(StudyError::combination(
            case,
            &["second", "place", "crack", "width", "height"],
            "the second crack must be inside the plate, ahead of the first",
        ));
    }
    let y = plate.line();
    Ok([Vector2::new(x, y - half), Vector2::new(x, y + half)])
}
