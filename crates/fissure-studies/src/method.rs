//! How a problem is solved: spacing, solver, shape function and transfer, from the parameters of a study.

use std::thread::available_parallelism;

use fissure::prelude::*;
use rayon::ThreadPoolBuilder;

use fissure_study::{Parameter, Parameters, Permitted, StudyError};

/// The shape functions by name.
pub const SHAPES: &[&str] = &["linear", "gimp", "cpdi", "bspline2", "bspline3"];

/// The solvers by name; a study may permit fewer.
pub const SOLVERS: &[&str] = &["explicit", "quasi-static"];

/// The parameters that [`Method::of`] reads, for a study that runs these spacings by default and
/// permits these solvers, the first of them by default.
pub fn parameters(spacings: &[f64], solvers: &'static [&'static str]) -> Vec<Parameter> {
    let threads = available_parallelism().map_or(1, |n| n.get() as u64);
    vec![
        Parameter::number(
            "h",
            "grid spacing",
            "m",
            spacings.first().copied().unwrap_or(1.0),
            Permitted::above(0.0),
        )
        .sweep(spacings.iter().copied()),
        Parameter::choice("solver", "time integration", solvers[0], solvers),
        Parameter::choice("shape", "shape function", "linear", SHAPES),
        Parameter::choice(
            "transfer",
            "between particles and grid (explicit)",
            "flip",
            &["flip", "pic", "apic", "xpic", "fmpm"],
        ),
        Parameter::count(
            "order",
            "terms of xpic and fmpm",
            3,
            Permitted::counts(1..=20),
        ),
        Parameter::choice(
            "update",
            "when the stress is updated (explicit)",
            "musl",
            &["first", "last", "musl"],
        ),
        Parameter::number(
            "cfl",
            "step over the time a wave needs across a cell (explicit)",
            "1",
            0.4,
            Permitted::numbers(0.01..=1.0),
        ),
        Parameter::count(
            "steps",
            "load steps of the run (quasi-static)",
            1,
            Permitted::counts(1..=100_000),
        ),
        Parameter::number(
            "tolerance",
            "residual over the largest reaction in equilibrium (quasi-static)",
            "1",
            1e-8,
            Permitted::numbers(1e-12..=1e-2),
        ),
        Parameter::count(
            "threads",
            "worker threads",
            threads,
            Permitted::counts(1..=256),
        ),
    ]
}

/// How a problem is solved.
#[derive(Clone, Debug)]
pub struct Method {
    /// Grid spacing, m.
    pub spacing: f64,
    /// Name of the solver.
    pub solver: String,
    /// Name of the shape function.
    pub shape: String,
    /// Explicit settings, but for the band.
    pub explicit: ExplicitSettings,
    /// Load steps of a quasi-static run.
    pub steps: u64,
    /// Residual in equilibrium of a quasi-static run, over the largest reaction.
    pub tolerance: f64,
}

impl Method {
    /// Reads the parameters that [`parameters`] declares.
    ///
    /// # Errors
    /// A parameter that the study did not declare.
    pub fn of(case: &Parameters) -> Result<Self, StudyError> {
        let order = case.size("order")?;
        Ok(Self {
            spacing: case.number("h")?,
            solver: case.choice("solver")?.to_owned(),
            shape: case.choice("shape")?.to_owned(),
            explicit: ExplicitSettings {
                cfl: case.number("cfl")?,
                transfer: match case.choice("transfer")? {
                    "pic" => Transfer::Pic,
                    "apic" => Transfer::Apic,
                    "xpic" => Transfer::Xpic { order },
                    "fmpm" => Transfer::Fmpm { order },
                    _ => Transfer::Flip { pic: 0.0 },
                },
                stress_update: match case.choice("update")? {
                    "first" => StressUpdate::First,
                    "last" => StressUpdate::Last,
                    _ => StressUpdate::Musl,
                },
                ..ExplicitSettings::default()
            },
            steps: case.count("steps")?,
            tolerance: case.number("tolerance")?,
        })
    }

    /// Whether inertia counts.
    pub fn is_dynamic(&self) -> bool {
        self.solver != "quasi-static"
    }

    /// The solver on a grid, for a run that ends at `end`, s.
    ///
    /// # Errors
    /// A setting outside its range.
    pub fn build(
        &self,
        grid: Grid<2>,
        band: BandSource,
        end: f64,
    ) -> Result<Box<dyn Solver<2>>, StudyError> {
        let built = match self.shape.as_str() {
            "gimp" => self.build_on(grid, shape::Gimp, band, end),
            "cpdi" => self.build_on(grid, shape::Cpdi, band, end),
            "bspline2" => self.build_on(grid, shape::Bspline2, band, end),
            "bspline3" => self.build_on(grid, shape::Bspline3, band, end),
            _ => self.build_on(grid, shape::Linear, band, end),
        };
        built.map_err(StudyError::failed("setting up the solver"))
    }

    fn build_on<S: Shape<2>>(
        &self,
        grid: Grid<2>,
        shape: S,
        band: BandSource,
        end: f64,
    ) -> Result<Box<dyn Solver<2>>, SolveError> {
        if self.is_dynamic() {
            let settings = ExplicitSettings {
                band,
                ..self.explicit
            };
            return Ok(Box::new(Explicit::new(grid, shape, settings)?));
        }
        let settings = QuasiStaticSettings {
            step: end / self.steps as f64,
            tolerance: self.tolerance,
            band,
            ..QuasiStaticSettings::default()
        };
        Ok(Box::new(QuasiStatic::new(grid, shape, settings)?))
    }

    /// Width over which the first body of a scene smears a crack of this normal, m.
    pub fn band_width(
        &self,
        band: BandSource,
        grid: &Grid<2>,
        scene: &Scene<2>,
        normal: &Vector2<f64>,
    ) -> f64 {
        let body = &scene.bodies()[0];
        let band = match self.shape.as_str() {
            "gimp" => band.band(&shape::Gimp, grid, body),
            "cpdi" => band.band(&shape::Cpdi, grid, body),
            "bspline2" => band.band(&shape::Bspline2, grid, body),
            "bspline3" => band.band(&shape::Bspline3, grid, body),
            _ => band.band(&shape::Linear, grid, body),
        };
        band.width(&Vector3::new(normal.x, normal.y, 0.0))
    }
}

/// Runs `work` on as many threads as the case asks for.
///
/// # Errors
/// Those of `work`, and threads that do not start.
pub fn on_threads<T: Send>(
    case: &Parameters,
    work: impl FnOnce() -> Result<T, StudyError> + Send,
) -> Result<T, StudyError> {
    let pool = ThreadPoolBuilder::new()
        .num_threads(case.size("threads")?)
        .build()
        .map_err(StudyError::failed("starting the worker threads"))?;
    pool.install(work)
}
