//! Pulling the bar apart.

use std::time::Instant;

use fissure::diagnostics::{EnergyBalance, FailedZone, state_hash};
use fissure::io::progress::Progress;
use fissure::prelude::*;

use fissure_study::{Measures, Parameters, SimulationRow, StudyError};

use super::exact::Exact;
use super::history::History;
use super::specimen::{BODY, Bar};
use crate::method::{Chosen, Method};

/// Where a run ends, over the critical opening.
const END: f64 = 1.25;
/// Up to where the load is compared, over the critical opening.
const COMPARED: f64 = 1.2;

/// Opening of particles that count as opened, over the critical one.
const OPENED: f64 = 0.01;

/// Steps between updates of the progress bar.
const PROGRESS: u64 = 50;

/// A finished run.
pub(crate) struct Finished {
    pub history: History,
    pub scene: Scene<2>,
    /// Wall time of the steps, s.
    pub wall_s: f64,
    /// Width over which a crack across the bar was smeared, m.
    pub band_width: f64,
    /// Why the run ended before its time.
    pub stopped: Option<String>,
}

/// How the right grip moves: to full speed over a ramp, then on to the end of the run.
#[derive(Clone, Copy)]
struct Loading {
    speed: f64,
    ramp: f64,
    end: f64,
}

impl Loading {
    fn new(bar: &Bar, case: &Parameters, method: &Method) -> Result<Self, StudyError> {
        let speed = case.number("speed")?;
        let transit = bar.length / bar.elastic.p_wave_speed();
        let ramp = match method.is_dynamic() {
            true => case.number("ramp")? * transit,
            false => 0.0,
        };
        // With the particle's size as band both columns of the weak cell open, one after the other.
        let cracks = match case.choice("band")? {
            "particle" => 2.0,
            _ => 1.0,
        };
        let way = cracks * END * bar.exact().critical_opening();
        Ok(Self {
            speed,
            ramp,
            end: 0.5 * ramp + way / speed,
        })
    }

    fn at(&self, time: f64) -> f64 {
        if time < self.ramp {
            self.speed * time / self.ramp
        } else {
            self.speed
        }
    }
}

/// How long a run takes in the time of the scene, s.
pub(crate) fn run_length(bar: &Bar, case: &Parameters) -> Result<f64, StudyError> {
    Ok(Loading::new(bar, case, &Method::of(case)?)?.end)
}

/// Runs one case; `frames`, if given, looks at the scene after every step.
pub(crate) fn break_bar(
    bar: &Bar,
    case: &Parameters,
    frames: Option<&mut dyn Watch<2>>,
) -> Result<Finished, StudyError> {
    let method = Method::of(case)?;
    let pull = Pull::new(bar, case, &method)?;
    let band = match case.choice("band")? {
        "particle" => BandSource::Particle,
        _ => BandSource::Discretisation,
    };
    let band_width = method.band_width(band, &pull.grid, &pull.scene, &bar.axis());
    let grid = pull.grid.clone();
    let mut solver = match case.choice("strain")? {
        "cell" => one_strain(&method, grid, case, band, pull.end())?,
        _ => method.build(grid, band, pull.end())?,
    };
    let mut finished = pull.break_with(&mut *solver, case, &bar.axis(), frames)?;
    finished.band_width = band_width;
    Ok(finished)
}

/// The quasi-static solver with one strain per cell.
fn one_strain(
    method: &Method,
    grid: Grid<2>,
    case: &Parameters,
    band: BandSource,
    end: f64,
) -> Result<Box<dyn Solver<2>>, StudyError> {
    if method.is_dynamic() {
        let reason = "cells have one strain in quasi-static runs only";
        return Err(StudyError::combination(case, &["solver", "strain"], reason));
    }
    let hourglass = case.number("hourglass")?;
    let settings = QuasiStaticSettings {
        step: end / method.steps as f64,
        tolerance: method.tolerance,
        band,
        averaging: Averaging::Strain { hourglass },
        ..QuasiStaticSettings::default()
    };
    method.build_with(grid, Chosen::QuasiStatic(settings))
}

/// A bar between its grips, and how they move.
pub(crate) struct Pull {
    pub grid: Grid<2>,
    pub scene: Scene<2>,
    loading: Loading,
}

impl Pull {
    pub(crate) fn new(bar: &Bar, case: &Parameters, method: &Method) -> Result<Self, StudyError> {
        let loading = Loading::new(bar, case, method)?;
        let grid = bar.grid()?;
        let scene = bar.scene(&grid, move |t| loading.at(t))?;
        Ok(Self {
            grid,
            scene,
            loading,
        })
    }

    /// When the run ends, s.
    pub(crate) fn end(&self) -> f64 {
        self.loading.end
    }

    /// Pulls to the end, or to where the solver finds no equilibrium.
    pub(crate) fn break_with(
        self,
        solver: &mut dyn Solver<2>,
        case: &Parameters,
        axis: &Vector2<f64>,
        mut frames: Option<&mut dyn Watch<2>>,
    ) -> Result<Finished, StudyError> {
        let Self {
            mut scene, loading, ..
        } = self;
        let mut progress = Progress::new(loading.end, &case.label()).every(PROGRESS);
        let start = Instant::now();
        let mut history = History::at_rest();
        let mut elongation = 0.0;
        let mut stopped = None;
        let mut idle = vec!["left", "right"];
        while scene.time() < loading.end {
            let report = match solver.step(&mut scene, loading.end) {
                Ok(report) => report,
                // A snap that controlled elongation cannot follow: a result, not the study's failure.
                Err(stop @ (SolveError::NoConvergence { .. } | SolveError::Singular { .. })) => {
                    stopped = Some(stop.to_string());
                    break;
                }
                Err(error) => {
                    let doing = format!("running {}", case.label());
                    return Err(StudyError::failed(doing)(error));
                }
            };
            idle.retain(|grip| scene.reaction(grip).is_none_or(|force| force.amax() == 0.0));
            elongation += loading.at(report.time) * report.dt;
            let (energy, load) = (scene.energy(), load(&scene, axis));
            history.push(elongation, load, energy.stored, energy.dissipated);
            let watched = match &mut frames {
                Some(frames) => frames.after(&scene, &report),
                None => Ok(()),
            };
            watched
                .and_then(|()| progress.after(&scene, &report))
                .map_err(StudyError::failed("watching the run"))?;
        }
        let wall_s = start.elapsed().as_secs_f64();
        if let (Some(grip), None) = (idle.first(), &stopped) {
            // Where a particle lies on a node to the last bit. One of an ensemble must not end the others.
            stopped = Some(format!(
                "the {grip} grip reaches no node of the bar: choose another gap"
            ));
        }
        Ok(Finished {
            history,
            scene,
            wall_s,
            band_width: f64::NAN,
            stopped,
        })
    }
}

/// Mean of what both grips pull with, N: a wave that is on its way from one to the other drops out.
pub(crate) fn load(scene: &Scene<2>, axis: &Vector2<f64>) -> f64 {
    let pull = |grip| {
        scene
            .reaction(grip)
            .map_or(f64::NAN, |force| force.dot(axis))
    };
    0.5 * (pull("right") - pull("left"))
}

/// The row of a run for a study.
pub(crate) fn row(
    study: &str,
    bar: &Bar,
    case: &Parameters,
    finished: &Finished,
) -> Result<SimulationRow, StudyError> {
    let mut row = measured(study, bar, case, finished);
    // What is open halfway and more, and what has opened at all.
    for (name, share) in [("failed_zone_cells", 0.5), ("opened_zone_cells", OPENED)] {
        let opening = share * bar.exact().critical_opening();
        let zone = FailedZone::of(&finished.scene, BODY, "opening", opening)
            .map_err(StudyError::failed("measuring the failed zone"))?;
        let cells = zone.volume / (bar.exact().area * bar.spacing);
        row.values.insert(name, cells);
    }
    row.values.insert("band", finished.band_width);
    Ok(row)
}

/// The same without what only a law that cracks can tell.
pub(crate) fn measured(
    study: &str,
    bar: &Bar,
    case: &Parameters,
    finished: &Finished,
) -> SimulationRow {
    let (exact, nominal) = (bar.exact(), bar.nominal());
    let (scene, history) = (&finished.scene, &finished.history);
    // A run that stopped early has no error of the whole curve: NaN, and no bound holds for it.
    let reached = history.curve.now().0 / exact.critical_opening();
    let whole = |error: f64| if reached >= COMPARED { error } else { f64::NAN };
    let load_error = |exact: &Exact| {
        let kinks = [exact.peak_elongation(), exact.critical_opening()];
        let end = COMPARED * bar.exact().critical_opening();
        let load = |elongation| exact.load(elongation);
        let error = history.curve.error(load, (0.0, end), &kinks);
        error.unwrap_or(f64::NAN)
    };
    let relative = |value: f64, reference: f64| (value / reference - 1.0).abs();
    let balance = EnergyBalance::of(scene.energy());
    // Halfway down, and where the load has gone in the exact solution.
    let at = |elongation| history.load_at(elongation);
    let middle = 0.5 * (exact.peak_elongation() + exact.critical_opening());
    let mut row = SimulationRow::new(study, case);
    row.particles = scene.particle_count() as u64;
    row.steps = scene.step();
    row.wall_s = finished.wall_s;
    row.errors = Measures::new()
        .with("load_l2", load_error(&exact))
        .with("peak", relative(history.curve.peak(), exact.peak_load()))
        .with(
            "work",
            whole(relative(history.curve.work(), exact.energy())),
        )
        .with(
            "dissipated",
            whole(relative(balance.dissipated, exact.energy())),
        );
    row.values = Measures::new()
        .with("dissipated_ratio", balance.dissipated / exact.energy())
        .with("energy_imbalance", balance.energy_imbalance().abs())
        .with("worst_balance", balance.worst_balance)
        .with("transfer_loss", balance.transfer_loss / exact.energy())
        .with("middle_load", at(middle) / exact.load(middle))
        .with(
            "late_load",
            at(1.2 * exact.critical_opening()) / exact.peak_load(),
        )
        .with("peak_load", history.curve.peak())
        .with("work", history.curve.work())
        .with("reached", reached)
        .with("load_l2_nominal", load_error(&nominal));
    row.state_hash = state_hash(scene);
    row
}
