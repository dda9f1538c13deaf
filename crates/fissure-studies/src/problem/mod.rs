//! A problem with a known answer as a study: rows with errors, observed orders, pictures.

mod pictures;

use std::time::Instant;

use fissure::diagnostics::{EnergyBalance, state_hash};
use fissure::prelude::*;

use fissure_study::{
    Measures, Overrides, Parameter, Parameters, Report as Rows, Row, SimulationRow, Study,
    StudyError,
};

use crate::convergence::SeriesSet;
use crate::method::{Method, on_threads};

use self::pictures::Pictures;

/// A problem whose answer is known.
pub trait Problem: Sync {
    /// The name on the command line.
    fn name(&self) -> &'static str;

    /// What it shows, in one line.
    fn about(&self) -> &'static str;

    /// All parameters, those of [`method`](crate::method) among them.
    fn parameters(&self) -> Vec<Parameter>;

    /// The sets of values to run; `quick` asks for seconds.
    fn cases(&self, quick: bool) -> Vec<Overrides>;

    /// The error that the pictures show.
    fn leading_error(&self) -> &'static str;

    /// Parameters, beside the spacing, whose values a chart of errors does not tell apart. If there are any, its runs are
    /// marks without lines.
    fn alike(&self) -> &'static [&'static str] {
        &[]
    }

    /// Runs one case.
    ///
    /// # Errors
    /// Whatever keeps it from its end.
    fn simulate(&self, case: &Parameters, method: &Method) -> Result<Outcome, StudyError>;
}

/// What a run leaves.
pub struct Outcome {
    /// The scene at the end.
    pub scene: Scene<2>,
    /// Wall time of the steps, s.
    pub wall_s: f64,
    /// The errors.
    pub errors: Measures,
    /// Other results.
    pub values: Measures,
    /// What to colour the first body's particles by in a picture: label and values.
    pub field: Option<(&'static str, Vec<f64>)>,
    /// A history and its exact one, to draw.
    pub history: Option<History>,
}

/// Samples of a run over another number, and what they should be.
pub struct History {
    /// Of the axis along.
    pub x_label: &'static str,
    /// Of the axis up.
    pub y_label: &'static str,
    /// Place, found and exact.
    pub samples: Vec<[f64; 3]>,
}

impl Outcome {
    /// An outcome without results yet.
    pub fn of(scene: Scene<2>, wall_s: f64) -> Self {
        Self {
            scene,
            wall_s,
            errors: Measures::new(),
            values: Measures::new(),
            field: None,
            history: None,
        }
    }
}

/// Steps a scene to a time and says how long that took, s.
///
/// # Errors
/// The first step that fails.
pub fn run_to(
    scene: &mut Scene<2>,
    solver: &mut dyn Solver<2>,
    end: f64,
    case: &Parameters,
) -> Result<f64, StudyError> {
    let start = Instant::now();
    run(scene, solver, Until::Time(end), &mut [])
        .map_err(StudyError::failed(format!("running {}", case.label())))?;
    Ok(start.elapsed().as_secs_f64())
}

/// A study whose cases are runs that each give one row.
pub trait Runs: Study {
    /// Runs one case on the threads that it asks for.
    ///
    /// # Errors
    /// Whatever keeps it from its end.
    fn run_case(&self, case: &Parameters) -> Result<SimulationRow, StudyError>;
}

/// What sets a case apart, its name first where it has one, which it tells even if no other case is run.
fn label(case: &Parameters) -> String {
    let Ok(name) = case.choice("case") else {
        return case.label();
    };
    match case.label_without(&["case"]).as_str() {
        "default" => name.to_owned(),
        rest => format!("{name} {rest}"),
    }
}

/// The row of a run that did not reach its end because a step failed: a result, and no reason not
/// to go on with the others.
fn stopped(study: &str, case: &Parameters, error: StudyError) -> Result<Row, StudyError> {
    let reason = match &error {
        StudyError::Failed { source, .. } if source.is::<SolveError>() => source.to_string(),
        _ => return Err(error),
    };
    Ok(Row::other(study)
        .field("case", case.label())
        .field("stopped", reason)
        .parameters(case))
}

/// The study of a problem.
pub struct Verification<P>(pub P);

impl<P: Problem> Verification<P> {
    fn outcome(&self, case: &Parameters) -> Result<Outcome, StudyError> {
        let method = Method::of(case)?;
        on_threads(case, || self.0.simulate(case, &method))
    }

    fn row(&self, case: &Parameters, outcome: &Outcome) -> SimulationRow {
        let mut row = SimulationRow::new(self.0.name(), case);
        row.case = label(case);
        if row.solver != "explicit" {
            row.transfer.clear();
        }
        row.particles = outcome.scene.particle_count() as u64;
        row.steps = outcome.scene.step();
        row.wall_s = outcome.wall_s;
        row.errors = outcome.errors.clone();
        row.values = outcome.values.clone();
        let balance = EnergyBalance::of(outcome.scene.energy());
        row.values
            .insert("energy_imbalance", balance.energy_imbalance().abs());
        row.state_hash = state_hash(&outcome.scene);
        row
    }
}

impl<P: Problem> Runs for Verification<P> {
    fn run_case(&self, case: &Parameters) -> Result<SimulationRow, StudyError> {
        let outcome = self.outcome(case)?;
        Ok(self.row(case, &outcome))
    }
}

impl<P: Problem> Study for Verification<P> {
    fn name(&self) -> &'static str {
        self.0.name()
    }

    fn about(&self) -> &'static str {
        self.0.about()
    }

    fn parameters(&self) -> Vec<Parameter> {
        self.0.parameters()
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        self.0.cases(quick)
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        let mut series = SeriesSet::new(self.0.name());
        let mut pictures = Pictures::of(&self.0, rows.out_dir());
        for (number, case) in cases.iter().enumerate() {
            let (at, count) = (number + 1, cases.len());
            rows.progress(&format!("{at} of {count}: {}", case.label()));
            let outcome = match self.outcome(case) {
                Ok(outcome) => outcome,
                Err(error) => {
                    rows.row(stopped(self.0.name(), case, error)?)?;
                    continue;
                }
            };
            let row = self.row(case, &outcome);
            series.add(case, &row, &outcome.scene);
            pictures.add(case, &row, &outcome)?;
            rows.row(row)?;
        }
        for order in series.orders() {
            rows.row(order)?;
        }
        pictures.finish()
    }
}
