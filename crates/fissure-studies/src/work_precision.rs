//! Error against run time: which scheme is worth its time on a smooth problem and on a breaking bar.

use std::path::Path;

use fissure_study::{
    Form, Overrides, Parameter, Parameters, Permitted, Report as Rows, Row, SimulationRow, Study,
    StudyError, Value, combinations,
};

use crate::convergence::ErrorChart;
use crate::method;
use crate::problem::{Runs, Verification};
use crate::tensile_bar::TensileBar;
use crate::verification::{AxisAlignedMms, VortexMms};

/// The study `work-precision`.
pub struct WorkPrecision;

const NAME: &str = "work-precision";

/// The problems by name, and the error that counts in each.
const PROBLEMS: &[(&str, &str)] = &[
    ("axis-aligned-mms", "place_l2"),
    ("vortex-mms", "place_l2"),
    ("tensile-bar", "load_l2"),
];

fn problem(name: &str) -> Box<dyn Runs> {
    match name {
        "vortex-mms" => Box::new(Verification(VortexMms)),
        "tensile-bar" => Box::new(TensileBar),
        _ => Box::new(Verification(AxisAlignedMms)),
    }
}

/// Parameters that are handed to the problem.
const HANDED: [&str; 9] = [
    "h",
    "solver",
    "shape",
    "transfer",
    "update",
    "cfl",
    "steps",
    "integration",
    "threads",
];

impl Study for WorkPrecision {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "error against run time over resolution, shape, transfer and time integration, with the efficient frontier"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = vec![
            Parameter::choice(
                "problem",
                "what is solved",
                "axis-aligned-mms",
                &["axis-aligned-mms", "vortex-mms", "tensile-bar"],
            ),
            Parameter::count(
                "repeats",
                "runs of each case, of which the fastest counts",
                1,
                Permitted::counts(1..=100),
            ),
        ];
        let methods = method::parameters(&[1.0 / 16.0], method::SOLVERS);
        let handed = |parameter: &Parameter| HANDED.contains(&parameter.name);
        parameters.extend(methods.into_iter().filter(handed));
        parameters
    }

    fn default_cases(&self, settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let asked = settings.get("problem");
        let wanted = |name: &str| asked.is_none_or(|asked| asked.contains(&Value::from(name)));
        let base = |problem: &str| {
            Overrides::new()
                .set("problem", problem)
                .set("threads", 1_u64)
        };
        let mut cases = Vec::new();
        if wanted("axis-aligned-mms") {
            cases.extend(smooth(base("axis-aligned-mms"), &[16.0, 32.0, 64.0], quick));
        }
        if wanted("vortex-mms") && !quick {
            cases.extend(smooth(base("vortex-mms"), &[8.0, 16.0, 24.0], quick));
        }
        if wanted("tensile-bar") {
            let spacings: &[f64] = if quick { &[0.02] } else { &[0.02, 0.01, 0.005] };
            let shapes: &[&str] = if quick {
                &["linear"]
            } else {
                &["linear", "gimp", "cpdi"]
            };
            let bar = base("tensile-bar")
                .set("steps", 150_u64)
                .sweep("h", spacings.iter().copied())
                .sweep("shape", shapes.iter().copied());
            cases.push(bar.clone().sweep("solver", ["quasi-static", "implicit"]));
            let transfers: &[&str] = if quick {
                &["flip"]
            } else {
                &["flip", "apic", "mls", "xpic", "fmpm"]
            };
            cases.push(
                bar.set("solver", "explicit")
                    .set("cfl", 0.8)
                    .sweep("transfer", transfers.iter().copied()),
            );
        }
        cases
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        let mut points: Vec<Point> = Vec::new();
        for (number, case) in cases.iter().enumerate() {
            let (at, count) = (number + 1, cases.len());
            rows.progress(&format!("{at} of {count}: {}", case.label()));
            match fastest(case) {
                Ok((row, error)) => {
                    points.push(Point::of(case, &row, error)?);
                    rows.row(row)?;
                }
                Err(StudyError::Failed { source, .. }) => rows.row(
                    Row::other(NAME)
                        .field("case", case.label())
                        .field("stopped", source.to_string())
                        .parameters(case),
                )?,
                Err(error) => return Err(error),
            }
        }
        for (name, measure) in PROBLEMS {
            let of_problem: Vec<&Point> = points.iter().filter(|p| p.problem == *name).collect();
            let frontier = frontier(&of_problem);
            for point in &frontier {
                rows.row(point.row(measure))?;
            }
            if let (Some(folder), false) = (rows.out_dir(), of_problem.is_empty()) {
                let path = folder.join(format!("{name}.png"));
                draw(name, measure, &of_problem, &frontier, &path)?;
            }
        }
        Ok(())
    }
}

/// Shapes with their transfers at three resolutions, and the step halved.
fn smooth(base: Overrides, cells: &[f64], quick: bool) -> Vec<Overrides> {
    let cells = if quick { &cells[..1] } else { cells };
    let base = base.sweep("h", cells.iter().map(|cells| 1.0 / cells));
    if quick {
        return vec![base.sweep("shape", ["gimp", "cpdi"])];
    }
    vec![
        base.clone()
            .sweep("shape", method::SHAPES.iter().copied())
            .sweep("transfer", ["flip", "apic", "fmpm"]),
        base.clone()
            .sweep("shape", ["cpdi", "bspline2"])
            .sweep("update", ["first", "last"]),
        base.clone()
            .sweep("shape", ["cpdi", "bspline2"])
            .set("cfl", 0.8),
        base.clone()
            .sweep("shape", ["bspline2", "bspline3"])
            .sweep("cfl", [0.4, 0.8])
            .set("transfer", "mls"),
        base.clone()
            .set("shape", "bspline2")
            .set("cfl", 0.8)
            .set("update", "last")
            .set("transfer", "mls"),
        base.set("solver", "implicit")
            .sweep("shape", ["gimp", "cpdi"])
            .sweep("steps", [8_u64, 16, 32]),
    ]
}

/// A run's place in the chart.
struct Point {
    problem: String,
    /// Solver and shape.
    group: String,
    scheme: String,
    h: f64,
    wall_s: f64,
    error: f64,
}

impl Point {
    fn of(case: &Parameters, row: &SimulationRow, error: f64) -> Result<Self, StudyError> {
        let group = format!("{}, {}", row.solver, row.shape);
        let mut scheme = group.clone();
        if row.solver == "explicit" {
            scheme = format!("{scheme}, {}", row.transfer);
            let (update, cfl) = (case.choice("update")?, case.number("cfl")?);
            scheme = format!("{scheme}, {update}, cfl {cfl}");
        }
        if row.solver == "implicit" {
            let (integration, steps) = (case.choice("integration")?, case.count("steps")?);
            scheme = format!("{scheme}, {integration}, {steps} steps");
        }
        Ok(Self {
            problem: case.choice("problem")?.to_owned(),
            group,
            scheme,
            h: row.h,
            wall_s: row.wall_s,
            error,
        })
    }

    fn row(&self, measure: &str) -> Row {
        Row::other(NAME)
            .field("case", "efficient")
            .field("problem", self.problem.as_str())
            .field("scheme", self.scheme.as_str())
            .field("h", self.h)
            .field("wall_s", self.wall_s)
            .field("measure", measure)
            .field("error", self.error)
    }
}

/// The points that no other beats in both time and error, by rising time.
fn frontier<'a>(points: &[&'a Point]) -> Vec<&'a Point> {
    let mut sorted: Vec<&Point> = points
        .iter()
        .copied()
        .filter(|point| point.error.is_finite())
        .collect();
    sorted.sort_by(|a, b| a.wall_s.total_cmp(&b.wall_s));
    let mut least = f64::INFINITY;
    sorted.retain(|point| {
        let better = point.error < least;
        least = least.min(point.error);
        better
    });
    sorted
}

/// Runs a case as often as it asks for; the row with the least time, and its error.
fn fastest(case: &Parameters) -> Result<(SimulationRow, f64), StudyError> {
    let name = case.choice("problem")?;
    let runs = problem(name);
    let inner = inner(case, runs.as_ref())?;
    let mut row = runs.run_case(&inner)?;
    for _ in 1..case.count("repeats")? {
        row.wall_s = row.wall_s.min(runs.run_case(&inner)?.wall_s);
    }
    let measure = PROBLEMS.iter().find(|(known, _)| *known == name);
    let error = measure.and_then(|(_, measure)| row.errors.get(measure));
    NAME.clone_into(&mut row.study);
    row.case = case.label_without(&["solver", "shape", "transfer", "h", "threads"]);
    row.parameters = case.clone();
    Ok((row, error.unwrap_or(f64::NAN)))
}

/// The case as the problem declares it.
fn inner(case: &Parameters, runs: &dyn Runs) -> Result<Parameters, StudyError> {
    let name = case.choice("problem")?;
    let mut overrides = Overrides::new();
    for parameter in runs.parameters() {
        overrides = match case.get(parameter.name) {
            Some(value) if HANDED.contains(&parameter.name) => {
                overrides.set(parameter.name, value.clone())
            }
            _ => overrides.sweep(parameter.name, parameter.default.iter().take(1).cloned()),
        };
    }
    // The same material beyond the square for all, so that times compare and no side is held.
    if name == "axis-aligned-mms" {
        overrides = overrides.set("margin", "0.5");
    }
    let refused = || {
        let reason = format!("{name} does not permit these values together");
        StudyError::combination(case, &["problem", "solver", "shape"], reason)
    };
    let parameters = runs.parameters();
    let permitted = parameters.iter().all(|parameter| {
        let values = overrides.get(parameter.name).unwrap_or(&[]);
        let check = |value: &Value| parameter.permitted.check(parameter.name, value).is_ok();
        values.iter().all(check)
    });
    if !permitted {
        return Err(refused());
    }
    let all = combinations(&Fixed(runs, overrides.clone()), &overrides, Form::Standard)?;
    all.into_iter().next().ok_or_else(refused)
}

/// A study with one case.
struct Fixed<'a>(&'a dyn Runs, Overrides);

impl Study for Fixed<'_> {
    fn name(&self) -> &'static str {
        self.0.name()
    }

    fn about(&self) -> &'static str {
        self.0.about()
    }

    fn parameters(&self) -> Vec<Parameter> {
        self.0.parameters()
    }

    fn default_cases(&self, _settings: &Overrides, _quick: bool) -> Vec<Overrides> {
        vec![self.1.clone()]
    }

    fn run(&self, cases: &[Parameters], report: &mut Rows<'_>) -> Result<(), StudyError> {
        self.0.run(cases, report)
    }
}

/// Every run as a mark of its solver and shape, and the frontier.
fn draw(
    name: &str,
    measure: &str,
    points: &[&Point],
    frontier: &[&Point],
    path: &Path,
) -> Result<(), StudyError> {
    let title = format!("Error against run time: {name}");
    let mut chart = ErrorChart::over_time(&title, measure).scattered();
    for point in points {
        chart.add(&point.group, point.wall_s, point.error);
    }
    let times: Vec<f64> = frontier.iter().map(|point| point.wall_s).collect();
    let errors: Vec<f64> = frontier.iter().map(|point| point.error).collect();
    chart.save_with(Some(("efficient", &times, &errors)), path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_nothing_beats_is_efficient() {
        let point = |wall_s, error| Point {
            problem: String::new(),
            group: String::new(),
            scheme: String::new(),
            h: 1.0,
            wall_s,
            error,
        };
        let points = [
            point(1.0, 0.1),
            point(2.0, 0.2),
            point(3.0, 0.01),
            point(0.5, f64::NAN),
        ];
        let all: Vec<&Point> = points.iter().collect();
        let times: Vec<f64> = frontier(&all).iter().map(|point| point.wall_s).collect();
        assert_eq!(times, [1.0, 3.0]);
    }
}
