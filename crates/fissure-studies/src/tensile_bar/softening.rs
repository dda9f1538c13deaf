//! The bar breaking: one row per case.

use std::path::Path;
use std::time::Instant;

use fissure::diagnostics::{EnergyBalance, FailedZone, state_hash};
use fissure::io::progress::Progress;
use fissure::prelude::*;
use rayon::ThreadPoolBuilder;

use super::bar::{BODY, Bar};
use super::exact::Exact;
use super::history::History;
use super::pictures::{Pictures, frames};
use fissure_study::{Measures, Parameters, Report as Rows, SimulationRow, StudyError};

/// Where a run ends, over the critical opening.
const END: f64 = 1.25;
/// Up to where the load is compared, over the critical opening.
const COMPARED: f64 = 1.2;

/// Steps between updates of the progress bar.
const PROGRESS: u64 = 50;

/// A finished run.
pub(super) struct Finished {
    pub row: SimulationRow,
    pub history: History,
    pub scene: Scene<2>,
    /// Why the run ended before its time.
    pub stopped: Option<String>,
}

pub(super) fn run(cases: &[&Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
    let mut pictures = Pictures::new(rows.out_dir());
    for (number, case) in cases.iter().enumerate() {
        rows.progress(&format!(
            "{} of {}: {}",
            number + 1,
            cases.len(),
            case.label()
        ));
        let bar = Bar::new(case)?;
        let pool = ThreadPoolBuilder::new()
            .num_threads(case.size("threads")?)
            .build()
            .map_err(StudyError::failed("starting the worker threads"))?;
        let folder = rows.out_dir().map(Path::to_path_buf);
        let finished = pool.install(|| break_bar(&bar, case, folder.as_deref()))?;
        rows.row(finished.row.clone())?;
        if let Some(reason) = &finished.stopped {
            rows.note(&format!("the run above stopped early: {reason}"))?;
        }
        pictures.add(&bar, case, &finished)?;
    }
    pictures.finish()
}

/// Runs one case with the shape that it names.
fn break_bar(bar: &Bar, case: &Parameters, folder: Option<&Path>) -> Result<Finished, StudyError> {
    match case.choice("shape")? {
        "gimp" => break_on(bar, case, shape::Gimp, folder),
        "cpdi" => break_on(bar, case, shape::Cpdi, folder),
        "bspline2" => break_on(bar, case, shape::Bspline2, folder),
        "bspline3" => break_on(bar, case, shape::Bspline3, folder),
        _ => break_on(bar, case, shape::Linear, folder),
    }
}

/// How the right grip moves: to full speed over a ramp, then on to the end of the run.
#[derive(Clone, Copy)]
struct Loading {
    speed: f64,
    ramp: f64,
    end: f64,
}

impl Loading {
    fn new(bar: &Bar, case: &Parameters) -> Result<Self, StudyError> {
        let speed = case.number("speed")?;
        let transit = bar.length / bar.law.elastic.p_wave_speed();
        let ramp = match case.choice("solver")? {
            "explicit" => case.number("ramp")? * transit,
            _ => 0.0,
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

fn break_on<S: Shape<2>>(
    bar: &Bar,
    case: &Parameters,
    shape: S,
    folder: Option<&Path>,
) -> Result<Finished, StudyError> {
    let loading = Loading::new(bar, case)?;
    let grid = bar.grid()?;
    let mut scene = bar.scene(&grid, move |t| loading.at(t))?;
    let band_source = match case.choice("band")? {
        "particle" => BandSource::Particle,
        _ => BandSource::Discretisation,
    };
    let band = band_source.band(&shape, &grid, &scene.bodies()[0]);
    let axis = bar.axis();
    let width = band.width(&Vector3::new(axis.x, axis.y, 0.0));
    let mut solver = solver(case, grid, shape, band_source, loading.end)?;
    let mut frames = frames(folder, bar, case, loading.end)?;
    let mut progress = Progress::new(loading.end, &case.label()).every(PROGRESS);
    let start = Instant::now();
    let mut history = History::at_rest();
    let mut elongation = 0.0;
    let mut stopped = None;
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
        elongation += loading.at(report.time) * report.dt;
        let (energy, load) = (scene.energy(), load(&scene, &axis));
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
    Ok(Finished {
        row: row(bar, case, &scene, &history, wall_s, width)?,
        history,
        scene,
        stopped,
    })
}

fn solver<S: Shape<2>>(
    case: &Parameters,
    grid: Grid<2>,
    shape: S,
    band: BandSource,
    end: f64,
) -> Result<Box<dyn Solver<2>>, StudyError> {
    let refused = |error: SolveError| StudyError::failed("setting up the solver")(error);
    if case.choice("solver")? == "quasi-static" {
        let settings = QuasiStaticSettings {
            step: end / case.count("steps")? as f64,
            band,
            ..QuasiStaticSettings::default()
        };
        let solver = QuasiStatic::new(grid, shape, settings).map_err(refused)?;
        return Ok(Box::new(solver));
    }
    let order = case.size("order")?;
    let settings = ExplicitSettings {
        cfl: case.number("cfl")?,
        transfer: match case.choice("transfer")? {
            "pic" => Transfer::Pic,
            "apic" => Transfer::Apic,
            "xpic" => Transfer::Xpic { order },
            "fmpm" => Transfer::Fmpm { order },
            _ => Transfer::Flip { pic: 0.0 },
        },
        band,
        ..ExplicitSettings::default()
    };
    let solver = Explicit::new(grid, shape, settings).map_err(refused)?;
    Ok(Box::new(solver))
}

/// Mean of what both grips pull with, N: a wave that is on its way from one to the other drops out.
pub(super) fn load(scene: &Scene<2>, axis: &Vector2<f64>) -> f64 {
    let pull = |grip| {
        scene
            .reaction(grip)
            .map_or(f64::NAN, |force| force.dot(axis))
    };
    0.5 * (pull("right") - pull("left"))
}

fn row(
    bar: &Bar,
    case: &Parameters,
    scene: &Scene<2>,
    history: &History,
    wall_s: f64,
    band: f64,
) -> Result<SimulationRow, StudyError> {
    let (exact, nominal) = (bar.exact(), bar.nominal());
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
    let failed = FailedZone::of(scene, BODY, "opening", 0.5 * exact.critical_opening())
        .map_err(StudyError::failed("measuring the failed zone"))?;
    let relative = |value: f64, reference: f64| (value / reference - 1.0).abs();
    let balance = EnergyBalance::of(scene.energy());
    let mut row = SimulationRow::new("tensile-bar", case);
    row.particles = scene.particle_count() as u64;
    row.steps = scene.step();
    row.wall_s = wall_s;
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
        .with(
            "failed_zone_cells",
            failed.volume / (exact.area * bar.spacing),
        )
        .with("peak_load", history.curve.peak())
        .with("work", history.curve.work())
        .with("reached", reached)
        .with("band", band)
        .with("load_l2_nominal", load_error(&nominal));
    row.state_hash = state_hash(scene);
    Ok(row)
}
