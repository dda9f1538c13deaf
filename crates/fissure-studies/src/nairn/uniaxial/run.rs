//! Pulling the bars: one row per case.

use fissure::prelude::*;
use fissure_study::{Measures, Parameters, Report as Rows, SimulationRow, StudyError};

use super::bar::{BODY, Bar, Flat, Section};
use super::neck::{Neck, Slices};
use super::pictures::Pictures;
use crate::nairn::drive::{Drive, drive, energies, row};
use crate::nairn::failed::Places;
use crate::nairn::numerics::Numerics;
use crate::nairn::pictures::{Slice, Snapshot};
use crate::nairn::reference::Curve;

/// Samples of a run.
const SAMPLES: f64 = 1000.0;
/// Shares of the run at which the bar is drawn.
const DRAWN: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// What a run leaves.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    pub time: Vec<f64>,
    /// Elongation over length.
    pub strain: Vec<f64>,
    /// Mean axial Kirchhoff stress of the bar, Pa: load times present length over volume at rest.
    pub stress: Vec<f64>,
    pub dissipated: Vec<f64>,
    /// Errors of the ledger, J: of the laws' integration and of the transfer.
    pub imbalance: Vec<f64>,
    pub transfer_loss: Vec<f64>,
    /// With what their file is called after the number.
    pub snapshots: Vec<(String, Snapshot)>,
    /// Nominal strain at which the first particle failed.
    first_failed: Option<f64>,
    /// Imbalance of the ledger over its largest term, until then.
    imbalance_softening: f64,
    /// Until the first particle failed.
    neck: Option<Neck>,
    /// Per particle and sample: dissipated over toughness, opening, axial stress.
    points: Vec<PointHistory>,
}

#[derive(Clone, Debug, Default)]
struct PointHistory {
    spent: Vec<f64>,
    stress: Vec<f64>,
    opening: Vec<f64>,
    failed: Option<usize>,
}

pub(super) struct Finished {
    pub row: SimulationRow,
    pub history: History,
    pub stopped: Option<String>,
}

pub(super) fn run(cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    let mut pictures = Pictures::new(rows.out_dir());
    for (number, case) in cases.iter().enumerate() {
        rows.progress(&format!(
            "{} of {}: {}",
            number + 1,
            cases.len(),
            case.label()
        ));
        let (bar, numerics) = (Bar::new(case)?, Numerics::of(case)?);
        let finished = numerics.on_threads(|| match bar.section {
            Section::Plane(flat) => plane(&bar, flat, &numerics, case),
            _ => {
                let (scene, solver) = bar.in_space(&numerics, case)?;
                pull(&bar, &numerics, scene, solver, case)
            }
        })?;
        rows.row(finished.row.clone())?;
        if let Some(reason) = &finished.stopped {
            rows.note(&format!("the run above stopped early: {reason}"))?;
        }
        pictures.add(&bar, &numerics, case, &finished)?;
    }
    pictures.finish()
}

fn plane(
    bar: &Bar,
    flat: Flat,
    numerics: &Numerics,
    case: &Parameters,
) -> Result<Finished, StudyError> {
    let (scene, solver) = bar.in_plane(flat, numerics)?;
    pull(bar, numerics, scene, solver, case)
}

fn pull<const D: usize>(
    bar: &Bar,
    numerics: &Numerics,
    mut scene: Scene<D>,
    mut solver: Box<dyn Solver<D>>,
    case: &Parameters,
) -> Result<Finished, StudyError> {
    let mut history = History::default();
    let places = scene.body(BODY).map(Places::of);
    let slices = scene
        .body(BODY)
        .map(|body| Slices::of(body, bar.length, numerics.spacing));
    history.points = vec![PointHistory::default(); scene.particle_count()];
    let end = bar.end;
    let (mut next, mut drawn) = (0.0, 0);
    let done = drive(&mut scene, solver.as_mut(), end, |scene, report| {
        if report.time >= next || report.time >= end {
            next += end / SAMPLES;
            history.sample(bar, scene, slices.as_ref());
        }
        if DRAWN
            .get(drawn)
            .is_some_and(|share| report.time >= share * end)
        {
            drawn += 1;
            let neck = history.neck;
            let snapshots = snapshots(bar, scene, numerics.spacing, drawn, neck);
            history.snapshots.extend(snapshots);
        }
        true
    })?;
    let row = finished_row(bar, case, &scene, &history, &done, places.as_ref());
    Ok(Finished {
        row,
        history,
        stopped: done.stopped,
    })
}

/// The bar coloured by its damage, with the ends of their files' names; of a bar in space the middle planes and the
/// neck's section.
fn snapshots<const D: usize>(
    bar: &Bar,
    scene: &Scene<D>,
    spacing: f64,
    number: usize,
    neck: Option<Neck>,
) -> Vec<(String, Snapshot)> {
    let percent = 100.0 * bar.elongation(scene.time()) / bar.length;
    let value = if bar.strength() < bar.law.opening.strength || bar.speed < 0.0 {
        "shear_damage"
    } else {
        "normal_damage"
    };
    let draw = |name: &str, slice: Option<Slice>| {
        let title = format!("{value} at a nominal strain of {percent:.1} %");
        let snapshot = Snapshot::of(title, scene, value, slice);
        (format!("{number}{name}"), snapshot)
    };
    if D == 2 {
        return vec![draw("", None)];
    }
    let depth = match bar.section {
        Section::Circle => bar.width,
        _ => bar.depth,
    };
    let plane = |axis: usize, width: f64| Slice {
        axis,
        middle: 0.5 * width,
        half: 0.5 * spacing,
    };
    let mut all = vec![
        draw("", Some(plane(2, depth))),
        draw("-side", Some(plane(1, bar.width))),
    ];
    if let Some(neck) = neck {
        let slice = Slice {
            axis: 0,
            middle: neck.x,
            half: spacing,
        };
        // Of a bar that has broken there may be nothing left there.
        let section = draw("-section", Some(slice));
        all.extend((!section.1.points.is_empty()).then_some(section));
    }
    all
}

impl History {
    fn sample<const D: usize>(&mut self, bar: &Bar, scene: &Scene<D>, slices: Option<&Slices>) {
        let Some(body) = scene.body(BODY) else {
            return;
        };
        let strain = bar.elongation(scene.time()) / bar.length;
        let (volume, motion) = (&body.particles().volume, body.motion());
        // ∫σ_xx dV over the volume at rest: the mean of Kirchhoff's stress, as the reference has it.
        let force: f64 = (0..volume.len())
            .map(|i| {
                let jacobian = motion.deformation_gradient[i].determinant();
                volume[i] * jacobian * motion.stress[i].mandel[0]
            })
            .sum();
        self.time.push(scene.time());
        self.strain.push(strain);
        self.stress.push(force / volume.iter().sum::<f64>());
        self.dissipated.push(scene.energy().dissipated);
        self.imbalance.push(scene.energy().imbalance());
        if self.first_failed.is_none() {
            self.imbalance_softening = EnergyBalance::of(scene.energy()).energy_imbalance();
        }
        self.transfer_loss.push(scene.energy().transfer_loss);
        let column = |name| body.value(name).unwrap_or_default();
        let (energy, failed, opening) = (
            column("opening_energy"),
            column("failed"),
            column("opening"),
        );
        let sample = self.time.len() - 1;
        for (i, id) in body.particles().id.iter().enumerate() {
            let Some(point) = self.points.get_mut(id.0 as usize) else {
                continue;
            };
            point.spent.push(energy[i] / bar.law.opening.toughness);
            point.stress.push(motion.stress[i].mandel[0]);
            point.opening.push(opening[i]);
            if failed[i] > 0.5 && point.failed.is_none() {
                point.failed = Some(sample);
                self.first_failed.get_or_insert(strain);
            }
        }
        if self.first_failed.is_none() {
            self.neck = slices.and_then(|slices| slices.neck(body));
        }
    }

    /// How far the traction of the particle that failed first was from its law while it softened,
    /// over the strength; and its opening at failure, m.
    ///
    /// With linear softening `σ = σ_n (1 − G_I/𝒢_I)`.
    fn law(&self, bar: &Bar) -> Option<(f64, f64)> {
        let failed = self.points.iter().filter(|point| point.failed.is_some());
        let point = failed.min_by_key(|point| point.failed)?;
        let strength = bar.law.opening.strength;
        let end = point.failed?;
        let mut worst = 0.0_f64;
        for sample in 1..end {
            if point.spent[sample] > point.spent[sample - 1] {
                let expected = strength * (1.0 - point.spent[sample]);
                worst = worst.max((point.stress[sample] - expected).abs() / strength);
            }
        }
        Some((worst, point.opening[end.saturating_sub(1)]))
    }
}

fn finished_row<const D: usize>(
    bar: &Bar,
    case: &Parameters,
    scene: &Scene<D>,
    history: &History,
    done: &Drive,
    places: Option<&Places<D>>,
) -> SimulationRow {
    let mut row = row("uniaxial", case, scene, done);
    let sign = bar.speed.signum();
    // Load over the section at rest; in compression, where that one grows, times the shortening.
    let pairs = history.stress.iter().zip(&history.strain);
    let nominal = pairs.map(|(stress, strain)| sign * stress / (1.0 + strain.max(0.0)));
    let (at, peak) = nominal.enumerate().fold(
        (0, 0.0),
        |best, next| if next.1 > best.1 { next } else { best },
    );
    let failed = match (scene.body(BODY), places) {
        (Some(body), Some(places)) => places.failed(body).len(),
        _ => 0,
    };
    let reached = scene.time() / bar.end;
    row.errors = Measures::new().with("peak", (peak / bar.strength() - 1.0).abs());
    let brittle = case.choice("case").is_ok_and(|case| case == "tension");
    let (law, opening) = history
        .law(bar)
        .filter(|_| brittle)
        .unwrap_or((f64::NAN, f64::NAN));
    if brittle {
        row.errors.insert("law", law);
    }
    if let Some((peak, stress)) = against_reference(bar, case, history) {
        row.errors.insert("reference_peak", peak);
        row.errors.insert("reference_stress", stress);
    }
    let ideal = bar.area() * bar.law.opening.toughness;
    let values = Measures::new()
        .with("peak_stress", peak)
        .with(
            "peak_strain",
            history.strain.get(at).map_or(0.0, |s| s.abs()),
        )
        .with(
            "first_failed_strain",
            history.first_failed.map_or(f64::NAN, f64::abs),
        )
        .with("failed_particles", failed as f64)
        .with("opening_at_failure", opening)
        .with("reached", reached)
        .with("imbalance_softening", history.imbalance_softening);
    row.values = energies(with_neck::<D>(values, history.neck), scene);
    row.values
        .insert("dissipated_ratio", scene.energy().dissipated / ideal);
    row
}

/// What is known of the neck: its section over the first one, its widths alike, where it is in the bar at rest, and how
/// it leans.
fn with_neck<const D: usize>(mut values: Measures, neck: Option<Neck>) -> Measures {
    let Some(neck) = neck else {
        return values;
    };
    values.insert("neck", neck.section);
    values.insert("neck_place", neck.place);
    for (axis, name) in ["y", "z"].into_iter().take(D - 1).enumerate() {
        let (width, angle) = (neck.widths[axis], neck.angles[axis].to_degrees());
        values.insert(format!("neck_width_{name}"), width);
        values.insert(format!("neck_angle_{name}_deg"), angle);
    }
    values
}

/// Differences from the independent code over its peak: of the peak, and the mean one of the stress
/// until columns fail one before the other.
fn against_reference(bar: &Bar, case: &Parameters, history: &History) -> Option<(f64, f64)> {
    let (text, until) = reference(bar, case)?;
    let curve = Curve::read(text, "uniaxial", "time", "mean_stress").ok()?;
    let peak = curve.y.iter().copied().fold(0.0, f64::max);
    let end = (until * bar.length / bar.speed).min(*curve.x.last()?);
    if !(*history.time.last()? >= end) {
        return Some((f64::NAN, f64::NAN));
    }
    let pairs = history.time.iter().zip(&history.stress);
    let inside = pairs.filter(|(t, _)| **t >= curve.x[0] && **t <= end);
    let (mut sum, mut count) = (0.0, 0.0);
    for (time, stress) in inside {
        sum += (stress - curve.at(*time)).abs();
        count += 1.0;
    }
    let own = history.stress.iter().copied().fold(0.0, f64::max);
    Some(((own / peak - 1.0).abs(), sum / count / peak))
}

/// The curve of the independent code for this case, with the nominal strain up to which runs are
/// compared: where they are not yet told apart by which column fails first.
pub(super) fn reference(bar: &Bar, case: &Parameters) -> Option<(&'static str, f64)> {
    let known = case.number("young").ok()? == 1e9
        && case.number("poisson").ok()? == 0.33
        && case.number("length").ok()? == 0.04
        && case.number("width").ok()? == 6e-3
        && case.number("speed").ok()? == 1.0
        && case.number("rise").ok()? == 0.0
        && bar.law.opening.strength == 30e6
        && bar.law.opening.toughness == 10e3;
    if !known || bar.speed < 0.0 {
        return None;
    }
    let stress = matches!(bar.section, Section::Plane(Flat::Stress));
    match (bar.law.shear.strength == 20e6, stress) {
        (true, false) => Some((include_str!("../../../tests/data/nairn/tension.csv"), 0.028)),
        (false, false) => Some((include_str!("../../../tests/data/nairn/necking.csv"), 0.05)),
        (false, true) => Some((
            include_str!("../../../tests/data/nairn/necking_plane_stress.csv"),
            0.05,
        )),
        (true, true) => None,
    }
}
