//! The crack as a row of particles that fail.

use fissure_study::{Parameters, StudyError};

use super::growth::Growth;
use super::run::{Finished, Seen, row_of};
use crate::nairn::drive::drive;
use crate::nairn::failed::Places;
use crate::nairn::numerics::Numerics;
use crate::nairn::plate::{BODY, Notch, Plate};

pub(super) fn pull(case: &Parameters, drawing: bool) -> Result<Finished, StudyError> {
    let numerics = Numerics::of(case)?;
    let notch = match case.choice("notch")? {
        "severed" => Notch::Severed,
        "line" => Notch::Line,
        _ => Notch::Gap,
    };
    let plate = Plate::new(case, notch)?;
    let end = case.number("end")?;
    let mut scene = plate.damaged(case, false)?;
    let mut solver = numerics.solver(plate.grid(end)?)?;
    let places = scene
        .body(BODY)
        .map(Places::of)
        .ok_or_else(|| StudyError::failed("finding the plate")("no such body"))?;
    let (mut growth, mut seen) = (Growth::default(), Seen::default());
    let through = plate.width - 2.0 * plate.spacing;
    let done = drive(&mut scene, solver.as_mut(), end, |scene, report| {
        let Some(body) = scene.body(BODY) else {
            return false;
        };
        let failed = body.value("failed").unwrap_or_default();
        let pairs = body.particles().id.iter().zip(failed);
        let ahead = pairs
            .filter(|(_, failed)| *failed > 0.5)
            .filter_map(|(id, _)| places.at(*id))
            .filter(|x| plate.is_ahead(x))
            .map(|x| x[0]);
        let tip = ahead.fold(f64::NAN, f64::max);
        if tip.is_finite() {
            growth.push(report.time, tip);
        }
        if drawing {
            seen.look(&plate, scene);
        }
        !(tip > through)
    })?;
    let failed = scene.body(BODY).map_or(0, |body| {
        let failed = places.failed(body);
        failed.iter().filter(|x| plate.is_ahead(x)).count()
    });
    let mut row = row_of(case, &plate, &scene, &growth, &done)?;
    let length = growth.tip.last().copied().unwrap_or(plate.crack);
    let rows = failed as f64 / ((length - plate.crack) / (0.5 * plate.spacing));
    row.values.insert("failed_rows", rows);
    Ok(Finished {
        row,
        growth,
        seen,
        stopped: done.stopped,
    })
}
