//! Pictures and files of the breaking bar, if they are asked for.

use std::path::{Path, PathBuf};

use fissure::io::plot::{LinePlot, Style};
use fissure::io::vtk::{Compression, ParticleSeries, Series};

use fissure_study::{Parameters, StudyError};

use crate::bar::drawing::{ROWS, draw_bar, sampled};
use crate::bar::{Bar, Exact, Finished, Thinned, run_length};
use crate::convergence::ErrorChart;
use crate::drawing::save;

/// Curves of one picture: more would not be told apart.
const CURVES: usize = 6;

/// Collects what the pictures show; does nothing without a folder.
pub(super) struct Pictures {
    folder: Option<PathBuf>,
    runs: Vec<Run>,
}

/// What is kept of a run.
struct Run {
    label: String,
    solver: String,
    shape: String,
    angle: f64,
    error: f64,
    wall_s: f64,
    exact: Exact,
    history: Thinned,
}

impl Pictures {
    pub(super) fn new(folder: Option<&Path>) -> Self {
        Self {
            folder: folder.map(Path::to_path_buf),
            runs: Vec::new(),
        }
    }

    /// Writes the files of one run and keeps its curves for the pictures of all.
    pub(super) fn add(
        &mut self,
        bar: &Bar,
        case: &Parameters,
        finished: &Finished,
        error: f64,
    ) -> Result<(), StudyError> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        let (solver, shape) = (case.choice("solver")?, case.choice("shape")?);
        let angle = case.number("angle")?;
        let name = run_name(bar, case)?;
        let history = finished.history.thinned(ROWS);
        history.write(&folder.join(format!("{name}.csv")))?;
        draw_bar(bar, &finished.scene, &folder.join(format!("{name}.png")))?;
        self.runs.push(Run {
            label: format!("{solver}, {shape}, h = 1/{:.0} m", 1.0 / bar.spacing),
            solver: solver.to_owned(),
            shape: shape.to_owned(),
            angle,
            error,
            wall_s: finished.wall_s,
            exact: bar.exact(),
            history,
        });
        Ok(())
    }

    /// Draws the pictures that compare the runs.
    pub(super) fn finish(&self) -> Result<(), StudyError> {
        let (Some(folder), Some(_)) = (&self.folder, self.runs.first()) else {
            return Ok(());
        };
        self.draw_loads(&folder.join("load.png"))?;
        self.draw_energies(&folder.join("energy.png"))?;
        self.draw_error_against_time(&folder.join("error-against-time.png"))
    }

    /// Load against elongation of the finest run of each solver, shape and angle.
    fn draw_loads(&self, path: &Path) -> Result<(), StudyError> {
        let exact = self.runs[0].exact;
        let mut plot = LinePlot::new("Load of the tensile bar")
            .x_label("elongation [m]")
            .y_label("load [N]");
        let chosen = self.finest();
        for run in chosen.iter().take(CURVES) {
            let label = match run.angle {
                0.0 => run.label.clone(),
                angle => format!("{}, {angle}°", run.label),
            };
            plot = plot.series(
                &label,
                &run.history.elongation,
                &run.history.load,
                Style::Line,
            );
        }
        let (x, y) = sampled(&exact, |exact, elongation| exact.load(elongation));
        save(plot.series("exact", &x, &y, Style::Dashed), path)
    }

    /// Work, stored and dissipated energy of the finest quasi-static (or first) run.
    fn draw_energies(&self, path: &Path) -> Result<(), StudyError> {
        let finest = self.finest();
        let chosen = finest.iter().find(|run| run.solver == "quasi-static");
        let Some(run) = chosen.or(finest.first()) else {
            return Ok(());
        };
        let history = &run.history;
        let mut plot = LinePlot::new(&format!("Energies: {}", run.label))
            .x_label("elongation [m]")
            .y_label("energy [J]");
        for (name, column) in [
            ("work of the load", &history.work),
            ("stored", &history.stored),
            ("dissipated", &history.dissipated),
        ] {
            plot = plot.series(name, &history.elongation, column, Style::Line);
        }
        let (x, y) = sampled(&run.exact, |exact, elongation| exact.work(elongation));
        plot = plot.series("exact work", &x, &y, Style::Dashed);
        let (x, y) = sampled(&run.exact, |exact, elongation| exact.stored(elongation));
        save(plot.series("exact stored", &x, &y, Style::Dotted), path)
    }

    /// Error of the load against wall time: one line per solver and shape.
    fn draw_error_against_time(&self, path: &Path) -> Result<(), StudyError> {
        let mut chart = ErrorChart::over_time("Error against run time", "load_l2");
        for run in &self.runs {
            let label = format!("{}, {}", run.solver, run.shape);
            chart.add(&label, run.wall_s, run.error);
        }
        chart.save(path)
    }

    /// The last, finest run of each solver, shape and angle; linear functions first.
    fn finest(&self) -> Vec<&Run> {
        let mut finest: Vec<&Run> = Vec::new();
        for run in &self.runs {
            let same = |other: &&mut &Run| {
                (&other.solver, &other.shape, other.angle) == (&run.solver, &run.shape, run.angle)
            };
            match finest.iter_mut().find(same) {
                Some(other) => *other = run,
                None => finest.push(run),
            }
        }
        finest
    }
}

/// Name of the files of a run.
fn run_name(bar: &Bar, case: &Parameters) -> Result<String, StudyError> {
    let mut name = format!(
        "{}-{}-{:.0}-per-m-{}-deg",
        case.choice("solver")?,
        case.choice("shape")?,
        1.0 / bar.spacing,
        case.number("angle")?,
    );
    for parameter in ["fill", "ends", "transfer"] {
        if case.varying().contains(&parameter) {
            name = format!("{name}-{}", case.choice(parameter)?);
        }
    }
    Ok(name)
}

/// ParaView frames of a run, if a folder is given: about twenty.
pub(super) fn frames(
    folder: Option<&Path>,
    bar: &Bar,
    case: &Parameters,
) -> Result<Option<ParticleSeries>, StudyError> {
    let Some(folder) = folder else {
        return Ok(None);
    };
    let name = run_name(bar, case)?;
    let series = Series::new(folder, &name, Compression::Lz4)
        .map_err(StudyError::failed("starting the ParaView series"))?;
    let frames = ParticleSeries::new(series).every_interval(run_length(bar, case)? / 20.0);
    Ok(Some(frames.velocity().stress().ids().values()))
}
