//! The square in two halves: a run, and its row.

use std::time::Instant;

use fissure::prelude::*;

use fissure_study::{Field, Fields, Parameters, Row, StudyError};

use super::NAME;

/// Young's modulus, Pa, and density, kg/m³, of the soft half.
const YOUNG: f64 = 1e6;
const DENSITY: f64 = 1000.0;

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
pub(super) struct Solved {
    pub scene: Scene<2>,
    displacement: Vec<Vector2<f64>>,
    newton: usize,
    pub products: usize,
    pub converged: bool,
    reason: String,
    wall_s: f64,
}

pub(super) fn solve(
    case: &Parameters,
    finer: f64,
    linear: LinearSolver,
) -> Result<Solved, StudyError> {
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
    pub(super) fn row(&self, case: &Parameters, reference: &Self) -> Result<Row, StudyError> {
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
pub(super) fn unknowns(case: &Parameters) -> Result<u64, StudyError> {
    Ok(2 * (case.count("cells")? + 1).pow(2))
}
