//! A bar longer than its limit [Sanchez 2010, eq. 5.2.15] snaps back: past the peak its elongation falls with
//! the load, which no controlled elongation can follow. The exact curve is three straight lines.

use std::time::Instant;

use fissure::diagnostics::{EnergyBalance, state_hash};
use fissure::io::plot::{LinePlot, Style};
use fissure::prelude::*;

use fissure_study::{
    Measures, Overrides, Parameter, Parameters, Permitted, Report as Rows, SimulationRow, Study,
    StudyError,
};

use crate::bar::{self, Bar, Exact, History, load};
use crate::drawing::save;
use crate::method::{Chosen, Method, on_threads};

/// The study `bar-snapback`.
pub struct BarSnapback;

const NAME: &str = "bar-snapback";

/// The bar counts as broken when no more than this share of its energy is left.
const BROKEN: f64 = 1e-3;
/// Where a run ends, over the critical opening.
const END: f64 = 1.1;
/// Most steps of a run.
const MOST_STEPS: u64 = 5000;
/// Points per segment of a curve where its distance is measured.
const POINTS: usize = 8;

impl Study for BarSnapback {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "a bar so long that it snaps back, followed past its peak by arc length and by dissipated energy, against the exact curve"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = bar::parameters_of(&[0.01], &["quasi-static"]);
        for parameter in &mut parameters {
            match parameter.name {
                // The weak section has the strength of the document, the rest a greater one.
                "strength" => parameter.default = vec![3e6.into()],
                "length" => parameter.default = [0.44, 0.6, 1.0].map(Into::into).to_vec(),
                "steps" => {
                    parameter.meaning = "steps that lead up to the peak";
                    parameter.default = vec![40_u64.into()];
                }
                _ => {}
            }
        }
        parameters.push(
            Parameter::choice(
                "control",
                "what a step holds fixed",
                "arc-length",
                &["arc-length", "dissipation"],
            )
            .sweep(["arc-length", "dissipation"]),
        );
        parameters.push(Parameter::count(
            "shares",
            "into which the energy of the bar is divided (dissipation)",
            50,
            Permitted::counts(2..=100_000),
        ));
        parameters
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        vec![match quick {
            true => Overrides::new().set("h", 0.02).sweep("length", [0.44, 1.0]),
            false => Overrides::new(),
        }]
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        let mut curves: Vec<Curve> = Vec::new();
        for case in cases {
            rows.progress(&case.label());
            let bar = Bar::of_any_length(case)?;
            let followed = on_threads(case, || follow(&bar, case))?;
            rows.row(row(&bar, case, &followed))?;
            if let Some(reason) = &followed.stopped {
                rows.note(&format!("the run above stopped early: {reason}"))?;
            }
            curves.push(Curve {
                exact: bar.exact(),
                control: case.choice("control")?.to_owned(),
                history: followed.history,
            });
        }
        match rows.out_dir() {
            Some(folder) => draw(&curves, folder),
            None => Ok(()),
        }
    }
}

/// A finished run.
struct Followed {
    history: History,
    scene: Scene<2>,
    wall_s: f64,
    branches: [Branch; 3],
    iterations: usize,
    cuts: usize,
    stopped: Option<String>,
}

/// What is noted of the rising branch, the falling one and the broken bar.
#[derive(Clone, Copy, Default)]
struct Branch {
    steps: u64,
    /// Steps in which the elongation falls.
    back: u64,
    /// Least and most negative pivots.
    pivots: Option<(usize, usize)>,
}

impl Branch {
    fn note(&mut self, solution: &Solution) {
        self.steps += 1;
        self.back += u64::from(solution.load_step < 0.0);
        if let Some(pivots) = solution.negative_pivots {
            let (least, most) = self.pivots.unwrap_or((pivots, pivots));
            self.pivots = Some((least.min(pivots), most.max(pivots)));
        }
    }
}

fn follow(bar: &Bar, case: &Parameters) -> Result<Followed, StudyError> {
    let method = Method::of(case)?;
    let (exact, speed) = (bar.exact(), case.number("speed")?);
    let grid = bar.grid()?;
    let mut scene = bar.scene(&grid, move |_| speed)?;
    let control = match case.choice("control")? {
        "dissipation" => LoadControl::Dissipation {
            energy: exact.energy() / case.count("shares")? as f64,
        },
        _ => LoadControl::ArcLength,
    };
    let settings = QuasiStaticSettings {
        step: exact.peak_elongation() / speed / method.steps as f64,
        tolerance: method.tolerance,
        control,
        ..QuasiStaticSettings::default()
    };
    let mut solver = method.build_with(grid, Chosen::QuasiStatic(settings))?;
    let start = Instant::now();
    let mut followed = Followed {
        history: History::at_rest(),
        scene: Scene::plane(Plane::Strain { thickness: 1.0 }),
        wall_s: 0.0,
        branches: [Branch::default(); 3],
        iterations: 0,
        cuts: 0,
        stopped: None,
    };
    while scene.load_time() * speed < END * exact.critical_opening() || !broken(&scene, &exact) {
        if scene.step() == MOST_STEPS {
            followed.stopped = Some(format!("{MOST_STEPS} steps"));
            break;
        }
        let spent = scene.energy().dissipated;
        let report = match solver.step(&mut scene, f64::INFINITY) {
            Ok(report) => report,
            Err(stop @ (SolveError::NoConvergence { .. } | SolveError::Singular { .. })) => {
                followed.stopped = Some(stop.to_string());
                break;
            }
            Err(error) => {
                return Err(StudyError::failed(format!("running {}", case.label()))(
                    error,
                ));
            }
        };
        let energy = scene.energy();
        let pull = load(&scene, &bar.axis());
        let elongation = scene.load_time() * speed;
        followed
            .history
            .push(elongation, pull, energy.stored, energy.dissipated);
        followed.iterations += report.iterations;
        let Some(solution) = report.solution else {
            continue;
        };
        followed.cuts += solution.cuts;
        let branch = if broken(&scene, &exact) {
            2
        } else if energy.dissipated > spent {
            1
        } else {
            0
        };
        followed.branches[branch].note(&solution);
    }
    followed.wall_s = start.elapsed().as_secs_f64();
    followed.scene = scene;
    Ok(followed)
}

fn broken(scene: &Scene<2>, exact: &Exact) -> bool {
    scene.energy().dissipated >= (1.0 - BROKEN) * exact.energy()
}

/// Corners of the exact curve, over peak elongation and load; after the last the load stays zero.
fn corners(exact: &Exact) -> [[f64; 2]; 4] {
    let critical = exact.critical_opening() / exact.peak_elongation();
    let end = END * critical;
    [[0.0, 0.0], [1.0, 1.0], [critical, 0.0], [end, 0.0]]
}

/// Mean square and greatest distance of the points of one line from another, both as lists of corners.
fn distance(from: &[[f64; 2]], to: &[[f64; 2]]) -> (f64, f64) {
    let vector = |[x, y]: [f64; 2]| Vector2::new(x, y);
    let away = |x: Vector2<f64>| {
        let segments = to.windows(2).map(|ends| {
            let (a, b) = (vector(ends[0]), vector(ends[1]));
            let along = b - a;
            let share = (x - a).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
            (x - a - along * share.clamp(0.0, 1.0)).norm()
        });
        segments.fold(f64::INFINITY, f64::min)
    };
    let (mut square, mut length, mut most) = (0.0, 0.0, 0.0_f64);
    for ends in from.windows(2) {
        let (a, b) = (vector(ends[0]), vector(ends[1]));
        let part = (b - a).norm() / POINTS as f64;
        for point in 0..POINTS {
            let x = a + (b - a) * ((point as f64 + 0.5) / POINTS as f64);
            let away = away(x);
            square += away * away * part;
            length += part;
            most = most.max(away);
        }
    }
    ((square / length).sqrt(), most)
}

fn row(bar: &Bar, case: &Parameters, followed: &Followed) -> SimulationRow {
    let (exact, scene, history) = (bar.exact(), &followed.scene, &followed.history);
    let curve = &history.curve;
    let scaled: Vec<[f64; 2]> = curve
        .displacement()
        .iter()
        .zip(curve.load())
        .map(|(x, y)| [x / exact.peak_elongation(), y / exact.peak_load()])
        // The end of the exact curve is where the run ends, up to a step.
        .collect();
    let mut corners = corners(&exact);
    if let Some([x, _]) = scaled.last() {
        corners[3][0] = corners[3][0].max(*x);
    }
    let (there, most_there) = distance(&scaled, &corners);
    let (back, most_back) = distance(&corners, &scaled);
    let relative = |value: f64, reference: f64| (value / reference - 1.0).abs();
    let balance = EnergyBalance::of(scene.energy());
    let whole = |error: f64| match followed.stopped {
        None => error,
        Some(_) => f64::NAN,
    };
    let mut row = SimulationRow::new(NAME, case);
    row.transfer.clear();
    row.particles = scene.particle_count() as u64;
    row.steps = scene.step();
    row.wall_s = followed.wall_s;
    row.errors = Measures::new()
        .with("path_l2", whole(there.max(back)))
        .with("path_max", whole(most_there.max(most_back)))
        .with("peak", relative(curve.peak(), exact.peak_load()))
        .with("work", whole(relative(curve.work(), exact.energy())))
        .with(
            "dissipated",
            whole(relative(balance.dissipated, exact.energy())),
        );
    row.values = Measures::new()
        .with("dissipated_ratio", balance.dissipated / exact.energy())
        .with("energy_imbalance", balance.energy_imbalance().abs())
        .with("iterations", followed.iterations as f64)
        .with("cuts", followed.cuts as f64);
    for (name, branch) in ["rising", "falling", "broken"]
        .iter()
        .zip(&followed.branches)
    {
        let (least, most) = branch.pivots.map_or((f64::NAN, f64::NAN), |(least, most)| {
            (least as f64, most as f64)
        });
        row.values
            .insert(format!("steps_{name}"), branch.steps as f64);
        row.values
            .insert(format!("turned_back_{name}"), branch.back as f64);
        row.values.insert(format!("least_pivots_{name}"), least);
        row.values.insert(format!("most_pivots_{name}"), most);
    }
    row.state_hash = state_hash(scene);
    row
}

/// What is drawn of a run.
struct Curve {
    exact: Exact,
    control: String,
    history: History,
}

fn draw(curves: &[Curve], folder: &std::path::Path) -> Result<(), StudyError> {
    let mut plot = LinePlot::new("Load of a bar that snaps back")
        .x_label("elongation [um]")
        .y_label("load [kN]");
    let mut drawn: Vec<f64> = Vec::new();
    for curve in curves {
        let exact = &curve.exact;
        let scale = [exact.peak_elongation() * 1e6, exact.peak_load() * 1e-3];
        if !drawn.contains(&exact.length) {
            drawn.push(exact.length);
            let [x, y] = [0, 1].map(|axis| corners(exact).map(|corner| corner[axis] * scale[axis]));
            let name = format!("exact, L = {} m", exact.length);
            plot = plot.series(&name, x.to_vec(), y.to_vec(), Style::Dashed);
        }
        let history = &curve.history.curve;
        let micro = history.displacement().iter().map(|x| x * 1e6);
        let kilo = history.load().iter().map(|y| y * 1e-3);
        let style = match curve.control.as_str() {
            "dissipation" => Style::Markers,
            _ => Style::Line,
        };
        let name = format!("{}, L = {} m", curve.control, exact.length);
        plot = plot.series(
            &name,
            micro.collect::<Vec<_>>(),
            kilo.collect::<Vec<_>>(),
            style,
        );
    }
    save(plot, &folder.join("load.png"))
}

#[cfg(test)]
mod tests {
    use super::distance;

    #[test]
    fn distances_of_lines() {
        let (line, beside) = ([[0.0, 0.0], [1.0, 0.0]], [[0.0, 0.1], [1.0, 0.1]]);
        let (mean, most) = distance(&line, &beside);
        assert!((mean - 0.1).abs() < 1e-15 && (most - 0.1).abs() < 1e-15);
        // A corner that is cut is seen from the side of the corner only.
        let (corner, cut) = (
            [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]],
            [[0.0, 0.0], [2.0, 0.0]],
        );
        assert!(distance(&corner, &cut).1 > 0.9 && distance(&cut, &corner).1 < 0.71);
        assert_eq!(distance(&line, &line), (0.0, 0.0));
    }
}
