//! How hard the linear systems of implicit steps are: neighbours of unlike stiffness or density, near
//! incompressibility, long steps; and how iterations grow with the number of unknowns.
//!
//! A square of 1 m, its left half soft, its right half stiffer (and heavier) by a ratio, rests on a wall and a
//! floor and is drawn at the right, from rest, by a load that rises evenly over the run. Steps are so many times the time that the fastest wave needs
//! across a cell. Errors are those of the particles' displacements against a factorisation with a
//! hundredth of the tolerance.

use std::time::Instant;

use fissure::io::plot::{LinePlot, Style};
use fissure::prelude::*;

use fissure_study::{
    Field, Fields, Overrides, Parameter, Parameters, Permitted, Report as Rows, Row, Study,
    StudyError,
};

use crate::bar::drawing::save;
use crate::method::on_threads;

/// The study `stiff`.
pub struct Stiff;

const NAME: &str = "stiff";

/// Young's modulus, Pa, and density, kg/m³, of the soft half.
const YOUNG: f64 = 1e6;
const DENSITY: f64 = 1000.0;
/// How much more accurate the reference is.
const FINER: f64 = 100.0;
/// Refinements from which a growth is fitted.
const SIZES: usize = 3;

impl Study for Stiff {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "iterations, time and error of each linear solver and preconditioner of an implicit step: unlike neighbours, near incompressibility, long steps, many unknowns"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let ratio = || Permitted::numbers(1.0..=1e9);
        vec![
            Parameter::choice(
                "linear_solver",
                "factorisation, conjugate gradients, GMRES by the law's tangent, GMRES by differences",
                "direct",
                &["direct", "cg", "gmres", "gmres-differences"],
            ),
            Parameter::choice(
                "preconditioner",
                "of an iteration; incomplete multiplies by the assembled matrix",
                "none",
                &["none", "mass", "node-blocks", "incomplete"],
            ),
            Parameter::number(
                "ratio",
                "stiffness of the right half over the left",
                "1",
                1.0,
                ratio(),
            ),
            Parameter::number(
                "mass_ratio",
                "density of the right half over the left",
                "1",
                1.0,
                ratio(),
            ),
            Parameter::number(
                "poisson",
                "Poisson's ratio",
                "1",
                0.3,
                Permitted::between(-1.0, 0.5),
            ),
            Parameter::number(
                "dt_ratio",
                "step over the explicit limit",
                "1",
                100.0,
                ratio(),
            ),
            Parameter::number(
                "strain",
                "of the soft half under the load at rest, about",
                "1",
                1e-3,
                Permitted::numbers(1e-9..=1e-1),
            ),
            Parameter::count("cells", "along a side", 16, Permitted::counts(2..=1024)),
            Parameter::count("steps", "of the run", 3, Permitted::counts(1..=1000)),
            Parameter::number(
                "tolerance",
                "unbalanced forces over the largest force",
                "1",
                1e-6,
                Permitted::numbers(1e-12..=1e-2),
            ),
            Parameter::count(
                "restart",
                "directions that GMRES keeps",
                400,
                Permitted::counts(1..=10_000),
            ),
            Parameter::count(
                "products",
                "with the tangent, at most, in a Newton iteration",
                4000,
                Permitted::counts(1..=1_000_000),
            ),
            Parameter::count("threads", "worker threads", 1, Permitted::counts(1..=256)),
        ]
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let all: &[(&str, &str)] = &[
            ("direct", "none"),
            ("cg", "none"),
            ("cg", "mass"),
            ("cg", "node-blocks"),
            ("cg", "incomplete"),
            ("gmres", "none"),
            ("gmres", "mass"),
            ("gmres", "node-blocks"),
            ("gmres", "incomplete"),
            ("gmres-differences", "mass"),
        ];
        let few: &[(&str, &str)] = &[
            ("direct", "none"),
            ("cg", "incomplete"),
            ("gmres", "incomplete"),
        ];
        let base = |(linear, preconditioner): &(&str, &str)| {
            Overrides::new()
                .set("linear_solver", *linear)
                .set("preconditioner", *preconditioner)
        };
        let mut cases = Vec::new();
        for pair in if quick { few } else { all } {
            let base = base(pair);
            if quick {
                cases.push(base.set("cells", 8_u64).sweep("ratio", [1.0, 1e6]));
                continue;
            }
            cases.push(base.clone().sweep("ratio", [1.0, 1e2, 1e4, 1e6]));
            cases.push(base.clone().sweep("poisson", [0.49, 0.4999, 0.49999]));
            cases.push(base.clone().set("mass_ratio", 1e6));
            cases.push(base.sweep("dt_ratio", [1.0, 1e4]));
        }
        let growing: &[(&str, &str)] = match quick {
            true => &few[1..],
            false => &[
                ("direct", "none"),
                ("cg", "node-blocks"),
                ("cg", "incomplete"),
                ("gmres", "node-blocks"),
                ("gmres", "incomplete"),
            ],
        };
        let cells: &[u64] = if quick {
            &[8, 16, 32]
        } else {
            &[8, 16, 32, 64]
        };
        for pair in growing {
            let grown = base(pair).set("dt_ratio", 1e4).set("steps", 1_u64);
            cases.push(grown.sweep("cells", cells.iter().copied()));
        }
        cases
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        let mut growth: Vec<Growth> = Vec::new();
        for (number, case) in cases.iter().enumerate() {
            let (at, count) = (number + 1, cases.len());
            rows.progress(&format!("{at} of {count}: {}", case.label()));
            let run = on_threads(case, || solve(case, 1.0, linear(case)?))?;
            let finer = on_threads(case, || solve(case, FINER, LinearSolver::Direct))?;
            // At the least that round-off leaves.
            let reference = match finer.converged {
                true => finer,
                false => on_threads(case, || solve(case, 1.0, LinearSolver::Direct))?,
            };
            rows.row(run.row(case, &reference)?)?;
            Growth::note(&mut growth, case, &run)?;
        }
        let mut plot = LinePlot::new("Products with the tangent in a step")
            .x_label("unknowns")
            .y_label("products")
            .log_x()
            .log_y();
        let mut drawn = false;
        for growth in growth.iter().filter(|growth| growth.sizes() > SIZES - 1) {
            rows.row(growth.row()?)?;
            if growth.products[0] > 0.0 {
                drawn = true;
                plot = plot.series(
                    &growth.name,
                    growth.unknowns.clone(),
                    growth.products.clone(),
                    Style::LineAndMarkers,
                );
            }
        }
        match rows.out_dir() {
            Some(folder) if drawn => save(plot, &folder.join("growth.png")),
            _ => Ok(()),
        }
    }
}

fn linear(case: &Parameters) -> Result<LinearSolver, StudyError> {
    let preconditioner = match case.choice("preconditioner")? {
        "mass" => Preconditioning::Mass,
        "node-blocks" => Preconditioning::NodeBlocks,
        "incomplete" => Preconditioning::Incomplete,
        _ => Preconditioning::None,
    };
    let name = case.choice("linear_solver")?;
    let product = match (name, preconditioner) {
        ("gmres-differences", _) => Product::Differences,
        (_, Preconditioning::Incomplete) => Product::Assembled,
        _ => Product::Tangent,
    };
    Ok(match name {
        "direct" => LinearSolver::Direct,
        _ => LinearSolver::Iterative(Iterative {
            method: match name {
                "cg" => fissure::solvers::Method::ConjugateGradients,
                _ => fissure::solvers::Method::Gmres,
            },
            product,
            preconditioner,
            restart: case.size("restart")?,
            max_iterations: case.size("products")?,
        }),
    })
}

/// The square; the load rises evenly to its full size at `end`, s.
fn scene(
    case: &Parameters,
    end: impl Fn(&Scene<2>) -> f64,
) -> Result<Scene<2>, Box<dyn std::error::Error + Send + Sync>> {
    let h = 1.0 / case.count("cells")? as f64;
    let spacing = Spacing(0.5 * h);
    let law = |ratio: f64, mass_ratio: f64| -> Result<Isotropic, StudyError> {
        Ok(Isotropic {
            density: DENSITY * mass_ratio,
            young: YOUNG * ratio,
            poisson: case.number("poisson")?,
        })
    };
    let stiff = law(case.number("ratio")?, case.number("mass_ratio")?)?;
    let load = YOUNG * case.number("strain")?;
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene
        .fill(
            "soft",
            law(1.0, 1.0)?,
            &Block::new([0.0, 0.0], [0.5, 1.0]),
            &spacing,
        )?
        .fill(
            "stiff",
            stiff,
            &Block::new([0.5, 0.0], [1.0, 1.0]),
            &spacing,
        )?;
    let end = end(&scene);
    scene
        .rigid(
            "wall",
            &Block::new([-h, 0.0], [0.0, 1.0]),
            &spacing,
            Hold::Component(Vector2::x()),
            Constant(0.0),
        )?
        .rigid(
            "floor",
            &Block::new([0.0, -h], [1.0, 0.0]),
            &spacing,
            Hold::Component(Vector2::y()),
            Constant(0.0),
        )?
        .force(
            "load",
            "stiff",
            move |x| x.x > 1.0 - 0.5 * h,
            move |t| Vector2::new(load, 0.3 * load) * (t / end),
        )?;
    Ok(scene)
}

/// A finished run.
struct Solved {
    scene: Scene<2>,
    displacement: Vec<Vector2<f64>>,
    newton: usize,
    products: usize,
    converged: bool,
    reason: String,
    wall_s: f64,
}

fn solve(case: &Parameters, finer: f64, linear: LinearSolver) -> Result<Solved, StudyError> {
    let h = 1.0 / case.count("cells")? as f64;
    let (steps, dt_ratio) = (case.count("steps")?, case.number("dt_ratio")?);
    let step = |scene: &Scene<2>| {
        let speeds = scene.bodies().iter().map(Body::wave_speed);
        dt_ratio * h / speeds.fold(0.0, f64::max)
    };
    let mut scene = scene(case, |scene| steps as f64 * step(scene))
        .map_err(StudyError::failed("building the square"))?;
    let grid = Grid::over([-4.0 * h, -4.0 * h], [1.0 + 4.0 * h, 1.0 + 4.0 * h], h)
        .map_err(StudyError::failed("making the grid"))?;
    let settings = ImplicitSettings {
        step: step(&scene),
        linear,
        tolerance: case.number("tolerance")? / finer,
        max_cuts: 0,
        ..ImplicitSettings::default()
    };
    let mut solver = Implicit::new(grid, shape::Linear, settings)
        .map_err(StudyError::failed("setting up the solver"))?;
    let first = by_id(&scene);
    let (mut newton, mut products) = (0, 0);
    let mut reason = NewtonStop::Converged.text().to_owned();
    let mut converged = true;
    let start = Instant::now();
    for _ in 0..steps {
        let stepped = solver.step(&mut scene, f64::INFINITY);
        let statistics = solver.statistics();
        newton += statistics.residuals.len().saturating_sub(1);
        products += statistics.products.iter().sum::<usize>();
        if stepped.is_err() {
            converged = false;
            let stop = statistics.stop.map_or("", NewtonStop::text);
            reason = match statistics.linear_stop {
                Some(linear) => format!("{stop}; linear: {linear:?}"),
                None => stop.to_owned(),
            };
            break;
        }
    }
    let wall_s = start.elapsed().as_secs_f64();
    let last = by_id(&scene);
    let displacement = last.iter().zip(&first).map(|(x, first)| x - first);
    Ok(Solved {
        displacement: displacement.collect(),
        scene,
        newton,
        products,
        converged,
        reason,
        wall_s,
    })
}

/// Positions of the particles, m, in the order of the bodies and their ids.
fn by_id(scene: &Scene<2>) -> Vec<Vector2<f64>> {
    let mut positions = Vec::with_capacity(scene.particle_count());
    for body in scene.bodies() {
        let particles = body.particles();
        let mut rows: Vec<usize> = (0..particles.len()).collect();
        rows.sort_by_key(|&row| particles.id[row].0);
        positions.extend(rows.iter().map(|&row| particles.motion.position[row]));
    }
    positions
}

impl Solved {
    fn row(&self, case: &Parameters, reference: &Self) -> Result<Row, StudyError> {
        let (mut away, mut size) = (0.0, 0.0);
        for (u, exact) in self.displacement.iter().zip(&reference.displacement) {
            away += (u - exact).norm_squared();
            size += exact.norm_squared();
        }
        let error = match self.converged && reference.converged {
            true => (away / size).sqrt(),
            false => f64::NAN,
        };
        Ok(Row::other(NAME)
            .field("case", case.label_without(&OWN))
            .field("solver", "implicit")
            .field("linear_solver", case.choice("linear_solver")?)
            .field("preconditioner", case.choice("preconditioner")?)
            .field("ratio", case.number("ratio")?)
            .field("mass_ratio", case.number("mass_ratio")?)
            .field("poisson", case.number("poisson")?)
            .field("dt_ratio", case.number("dt_ratio")?)
            .field("unknowns", unknowns(case)?)
            .field("steps", self.scene.step())
            .field("newton", self.newton as u64)
            .field("iterations", self.products as u64)
            .field("converged", self.converged)
            .field("reason", self.reason.as_str())
            .field("wall_s", self.wall_s)
            .field("errors", Field::Group(Fields::new().with("l2", error)))
            .parameters(case))
    }
}

/// Parameters with columns of their own.
const OWN: [&str; 7] = [
    "linear_solver",
    "preconditioner",
    "ratio",
    "mass_ratio",
    "poisson",
    "dt_ratio",
    "threads",
];

/// Displacement components of the nodes that the square reaches, about.
fn unknowns(case: &Parameters) -> Result<u64, StudyError> {
    Ok(2 * (case.count("cells")? + 1).pow(2))
}

/// How products grow with the number of unknowns, all else the same.
struct Growth {
    name: String,
    /// What else the case is.
    label: String,
    unknowns: Vec<f64>,
    products: Vec<f64>,
}

impl Growth {
    fn note(all: &mut Vec<Self>, case: &Parameters, run: &Solved) -> Result<(), StudyError> {
        if !run.converged {
            return Ok(());
        }
        let label = case.label_without(&["cells"]);
        let place = match all.iter().position(|growth| growth.label == label) {
            Some(place) => place,
            None => {
                let (linear, by) = (
                    case.choice("linear_solver")?,
                    case.choice("preconditioner")?,
                );
                all.push(Self {
                    name: format!("{linear}, {by}"),
                    label,
                    unknowns: Vec::new(),
                    products: Vec::new(),
                });
                all.len() - 1
            }
        };
        all[place].unknowns.push(unknowns(case)? as f64);
        let per_step = run.products as f64 / run.scene.step() as f64;
        all[place].products.push(per_step);
        Ok(())
    }

    /// Sizes that differ.
    fn sizes(&self) -> usize {
        let mut sizes: Vec<u64> = self.unknowns.iter().map(|&n| n as u64).collect();
        sizes.sort_unstable();
        sizes.dedup();
        sizes.len()
    }

    fn row(&self) -> Result<Row, StudyError> {
        let exponent = match self.products[0] > 0.0 {
            true => {
                fit_slope(&self.unknowns, &self.products)
                    .map_err(StudyError::failed("fitting the growth"))?
                    .exponent
            }
            false => 0.0,
        };
        Ok(Row::other(NAME)
            .field("case", "growth")
            .field("scheme", self.name.as_str())
            .field("unknowns", Field::Numbers(self.unknowns.clone()))
            .field("iterations", Field::Numbers(self.products.clone()))
            .field("exponent", exponent))
    }
}
