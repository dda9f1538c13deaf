//! Cost of a crack's growth: a row per case.

use fissure::diagnostics::fracture::{
    Annulus, PlaneElastic, Rates, TipField, TipFrame, j_integral,
};
use fissure::prelude::*;
use fissure_study::{Measures, Parameters, Report as Rows, SimulationRow, StudyError};

use crate::nairn::drive::{drive, energies, row};
use crate::nairn::failed::Places;
use crate::nairn::many;
use crate::nairn::numerics::{Numerics, check_whole_cells};
use crate::nairn::plate::{BODY, Notch, Plate, THICKNESS};

pub(super) fn run(cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    for case in cases {
        check_whole_cells(case, &["width", "height"])?;
    }
    many::in_order(cases, rows, pull, |rows, _, (row, stopped)| {
        rows.row(row)?;
        stopped.map_or(Ok(()), |reason: String| {
            rows.note(&format!("the run above stopped early: {reason}"))?;
            Ok(())
        })
    })
}

fn pull(case: &Parameters) -> Result<(SimulationRow, Option<String>), StudyError> {
    let numerics = Numerics::of(case)?;
    let plate = Plate::new(case, Notch::Line)?;
    let (end, radius) = (case.number("end")?, case.number("radius")?);
    let mut scene = plate.damaged(case, false)?;
    let mut solver = numerics.solver(plate.grid(end)?)?;
    let places = scene
        .body(BODY)
        .map(Places::of)
        .ok_or_else(|| StudyError::failed("finding the plate")("no such body"))?;
    let (mut rates, mut release, mut onset, mut length) =
        (Rates::default(), f64::NAN, f64::NAN, 0.0);
    let far = plate.measured().1;
    let done = drive(&mut scene, solver.as_mut(), end, |scene, report| {
        let Some(body) = scene.body(BODY) else {
            return false;
        };
        // The means of ten steps.
        if onset.is_nan() && report.step % 10 == 0 && rates.look(scene, BODY).is_err() {
            return false;
        }
        let failed = places.failed(body);
        let ahead = failed.iter().filter(|x| plate.is_ahead(x)).map(|x| x.x);
        length = ahead.fold(f64::NAN, f64::max) - plate.crack;
        if onset.is_nan() && length > 0.0 {
            onset = report.time;
            release = far_release(scene, &plate, &rates, radius).unwrap_or(f64::NAN);
        }
        !(length > far - plate.crack)
    })?;
    let mut row = row("apparent-toughness", case, &scene, &done);
    row.threads = 1;
    let area = length * THICKNESS * plate.toughness;
    let spent = scene.energy().dissipated / area;
    let (share, rows) = failed_share(&scene, &places, &plate, length);
    let zone = plate.elastic.young * plate.toughness / plate.strength().powi(2);
    row.values = Measures::new()
        .with("h_over_zone", plate.spacing / zone)
        .with("onset_us", 1e6 * onset)
        .with("length_mm", 1e3 * length)
        .with("far_j_at_onset", release / plate.toughness)
        .with("spent", spent)
        .with("spent_by_failed", spent * share)
        .with("spent_by_wake", spent * (1.0 - share))
        .with("lost_by_transfer", scene.energy().transfer_loss / area)
        .with("failed_rows", rows);
    row.values = energies(row.values, &scene);
    Ok((row, done.stopped))
}

/// J around the notch's tip, J/m².
fn far_release(scene: &Scene<2>, plate: &Plate, rates: &Rates, radius: f64) -> Option<f64> {
    let elastic = PlaneElastic {
        young: plate.elastic.young,
        poisson: plate.elastic.poisson,
        plane_stress: false,
    };
    let tip = TipFrame::of(scene.cracks().first()?, End::Last);
    let field = TipField::of(scene, BODY, &tip.position, radius, &elastic, Some(rates)).ok()?;
    let annulus = Annulus {
        inner: 0.5 * radius,
        outer: radius,
    };
    j_integral(&field, &tip, &annulus).ok()
}

/// Share of the dissipation that particles took which have failed, and how many rows of them there are along the crack.
fn failed_share(scene: &Scene<2>, places: &Places<2>, plate: &Plate, length: f64) -> (f64, f64) {
    let Some(body) = scene.body(BODY) else {
        return (f64::NAN, f64::NAN);
    };
    let failed = body.value("failed").unwrap_or_default();
    let energy = body.value("opening_energy").unwrap_or_default();
    let (mut by_failed, mut all) = (0.0, 0.0);
    for ((failed, energy), volume) in failed.iter().zip(&energy).zip(&body.particles().volume) {
        all += volume * energy;
        if *failed > 0.5 {
            by_failed += volume * energy;
        }
    }
    let count = places
        .failed(body)
        .iter()
        .filter(|x| plate.is_ahead(x))
        .count();
    (
        by_failed / all,
        count as f64 / (length / (0.5 * plate.spacing)),
    )
}
