//! Cost of a crack's growth: a row per case.

use fissure::diagnostics::fracture::{
    Annulus, PlaneElastic, Rates, TipField, TipFrame, j_integral,
};
use fissure::prelude::*;
use fissure_study::{Measures, Parameters, Report as Rows, SimulationRow, StudyError};

use super::cost::Costs;
use super::pictures::Pictures;
use crate::nairn::drive::{Drive, drive, energies, row};
use crate::nairn::failed::Places;
use crate::nairn::many;
use crate::nairn::numerics::{Numerics, check_whole_cells};
use crate::nairn::pictures::Snapshot;
use crate::nairn::plate::{BODY, Notch, Plate, THICKNESS};

/// Most steps of a quasi-static run.
const MOST_STEPS: u64 = 4000;
/// Steps of a quasi-static run in which the plate would come to the J that its toughness is, did nothing soften.
const RISE: f64 = 10.0;

pub(super) struct Finished {
    pub row: SimulationRow,
    /// Growth, m, and J far from the tip over the toughness, of a quasi-static run.
    pub resistance: Vec<[f64; 2]>,
    /// How far the ends have gone apart, m, and their load, N, after each step.
    pub load: Vec<[f64; 2]>,
    /// The damage at the end.
    pub damage: Snapshot,
    stopped: Option<String>,
}

/// What is seen of a run.
#[derive(Default)]
struct Seen {
    costs: Costs,
    /// s; how far the ends have then gone, m.
    onset: Option<(f64, f64)>,
    release: f64,
    resistance: Vec<[f64; 2]>,
    load: Vec<[f64; 2]>,
}

pub(super) fn run(cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    for case in cases {
        check_whole_cells(case, &["width", "height"])?;
    }
    let mut pictures = Pictures::new(rows.out_dir());
    many::in_order(cases, rows, pull, |rows, case, finished| {
        pictures.add(case, &finished)?;
        rows.row(finished.row)?;
        finished.stopped.map_or(Ok(()), |reason| {
            rows.note(&format!("the run above stopped early: {reason}"))?;
            Ok(())
        })
    })?;
    pictures.finish()
}

fn pull(case: &Parameters) -> Result<Finished, StudyError> {
    let numerics = Numerics::of(case)?;
    let plate = Plate::new(case, Notch::Line)?;
    let mut scene = plate.damaged(case, false)?;
    let places = scene
        .body(BODY)
        .map(Places::of)
        .ok_or_else(|| StudyError::failed("finding the plate")("no such body"))?;
    let still = case.choice("solver")? == "quasi-static";
    let (seen, done) = if still {
        follow(case, &numerics, &plate, &places, &mut scene)?
    } else {
        step(case, &numerics, &plate, &places, &mut scene)?
    };
    let mut row = row("apparent-toughness", case, &scene, &done);
    row.threads = 1;
    if still {
        row.solver = "quasi-static".to_owned();
        row.transfer.clear();
    }
    let rate = seen.costs.rate(&plate);
    let zone = plate.elastic.young * plate.toughness / plate.strength().powi(2);
    let (onset, way) = seen.onset.unwrap_or((f64::NAN, f64::NAN));
    row.values = Measures::new()
        .with("h_over_zone", plate.spacing / zone)
        .with("onset_us", if still { f64::NAN } else { 1e6 * onset })
        .with("onset_way_mm", 1e3 * way)
        .with("length_mm", 1e3 * seen.costs.growth())
        .with("far_j_at_onset", seen.release)
        .with("spent", rate.failed + rate.wake)
        .with("spent_by_failed", rate.failed)
        .with("spent_by_wake", rate.wake)
        .with("lost_by_transfer", rate.transfer)
        .with("failed_rows", rate.rows);
    if let Some(last) = seen.resistance.last() {
        row.values.insert("far_j_grown", last[1]);
    }
    row.values = energies(row.values, &scene);
    let title = format!("Damage at a growth of {:.1} mm", 1e3 * seen.costs.growth());
    Ok(Finished {
        row,
        resistance: seen.resistance,
        load: seen.load,
        damage: Snapshot::of(title, &scene, "normal_damage", None),
        stopped: done.stopped,
    })
}

/// In time, with inertia.
fn step(
    case: &Parameters,
    numerics: &Numerics,
    plate: &Plate,
    places: &Places<2>,
    scene: &mut Scene<2>,
) -> Result<(Seen, Drive), StudyError> {
    let (end, radius) = (case.number("end")?, case.number("radius")?);
    let far = case
        .number("growth")?
        .min(0.8 * (plate.width - plate.crack));
    let mut solver = numerics.solver(plate.grid(end)?)?;
    let (mut rates, mut seen) = (
        Rates::default(),
        Seen {
            release: f64::NAN,
            ..Seen::default()
        },
    );
    let done = drive(scene, solver.as_mut(), end, |scene, report| {
        seen.load.push(plate.load(scene));
        // The means of ten steps.
        let due = seen.onset.is_none() && report.step % 10 == 0;
        if due && rates.look(scene, BODY).is_err() {
            return false;
        }
        if seen.costs.look(scene, places, plate).is_some() && seen.onset.is_none() {
            seen.onset = Some((report.time, plate.speed() * report.time));
            seen.release = release(scene, plate, Some(&rates), radius);
        }
        !(seen.costs.growth() >= far)
    })?;
    Ok((seen, done))
}

/// In equilibrium: a step dissipates a share of what one particle takes.
fn follow(
    case: &Parameters,
    numerics: &Numerics,
    plate: &Plate,
    places: &Places<2>,
    scene: &mut Scene<2>,
) -> Result<(Seen, Drive), StudyError> {
    let radius = case.number("radius")?;
    // Its tip has to stay within the part of the domain that has no slope.
    let far = case.number("growth")?.min(0.45 * radius);
    let particle = 0.5 * plate.spacing * THICKNESS * plate.toughness;
    let settings = QuasiStaticSettings {
        step: plate.way_at_toughness() / (RISE * plate.speed()),
        control: LoadControl::Dissipation {
            energy: case.number("share")? * particle,
        },
        tolerance: 1e-6,
        ..QuasiStaticSettings::default()
    };
    let room = 20.0 * RISE * settings.step;
    let mut solver = numerics.equilibrium(plate.grid(room)?, settings)?;
    let mut seen = Seen {
        release: f64::NAN,
        ..Seen::default()
    };
    let done = drive(scene, solver.as_mut(), f64::INFINITY, |scene, report| {
        seen.load.push(plate.load(scene));
        if let Some(growth) = seen.costs.look(scene, places, plate) {
            let release = release(scene, plate, None, radius);
            // A leap may end beyond the part of the domain that has no slope, where J is no measure.
            if growth < 0.5 * radius {
                seen.resistance.push([growth, release]);
            }
            if seen.onset.is_none() {
                seen.onset = Some((report.time, plate.speed() * scene.load_time()));
                seen.release = release;
            }
        }
        report.step < MOST_STEPS && !(seen.costs.growth() >= far)
    })?;
    Ok((seen, done))
}

/// J around the notch's tip over the toughness; NaN where it cannot be measured.
fn release(scene: &Scene<2>, plate: &Plate, rates: Option<&Rates>, radius: f64) -> f64 {
    let elastic = PlaneElastic {
        young: plate.elastic.young,
        poisson: plate.elastic.poisson,
        plane_stress: false,
    };
    let annulus = Annulus {
        inner: 0.5 * radius,
        outer: radius,
    };
    let measure = || {
        let tip = TipFrame::of(scene.cracks().first()?, End::Last);
        let field = TipField::of(scene, BODY, &tip.position, radius, &elastic, rates).ok()?;
        j_integral(&field, &tip, &annulus).ok()
    };
    measure().map_or(f64::NAN, |j| j / plate.toughness)
}
