//! How a problem is solved: spacing, solver, shape function and transfer, from the parameters of a study.

use std::thread::available_parallelism;

use fissure::prelude::*;
use rayon::ThreadPoolBuilder;

use fissure_study::{Parameter, ParameterError, Parameters, Permitted, StudyError};

/// The shape functions by name.
pub const SHAPES: &[&str] = &["linear", "gimp", "cpdi", "bspline2", "bspline3"];

/// The solvers by name; a study may permit fewer.
pub const SOLVERS: &[&str] = &["explicit", "quasi-static", "implicit"];

/// The parameters that [`Method::of`] reads, for a study that runs these spacings by default and
/// permits these solvers, the first of them by default; those of other solvers are left out.
pub fn parameters(spacings: &[f64], solvers: &'static [&'static str]) -> Vec<Parameter> {
    let threads = available_parallelism().map_or(1, |n| n.get() as u64);
    let mut parameters = vec![
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
    ];
    if solvers.contains(&"explicit") {
        parameters.extend(explicit());
    }
    if solvers.iter().any(|solver| *solver != "explicit") {
        parameters.extend(equilibrium());
    }
    if solvers.contains(&"implicit") {
        parameters.extend(implicit());
    }
    parameters.push(Parameter::count(
        "threads",
        "worker threads",
        threads,
        Permitted::counts(1..=256),
    ));
    parameters
}

fn explicit() -> [Parameter; 4] {
    [
        Parameter::choice(
            "transfer",
            "between particles and grid (explicit)",
            "flip",
            &["flip", "pic", "apic", "mls", "xpic", "fmpm"],
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
    ]
}

/// Of the solvers that balance forces at the end of a step.
fn equilibrium() -> [Parameter; 2] {
    [
        Parameter::count(
            "steps",
            "equal steps of the run (quasi-static, implicit)",
            1,
            Permitted::counts(1..=100_000),
        ),
        Parameter::number(
            "tolerance",
            "residual in equilibrium over the largest reaction (quasi-static) or force (implicit)",
            "1",
            1e-8,
            Permitted::numbers(1e-12..=1e-2),
        ),
    ]
}

/// How implicit runs go from accelerations to displacements.
fn implicit() -> [Parameter; 3] {
    [
        Parameter::choice(
            "integration",
            "scheme in time (implicit)",
            "generalized-alpha",
            &["generalized-alpha", "newmark", "theta"],
        ),
        Parameter::number(
            "spectral_radius",
            "share that generalised alpha leaves of an infinitely fast motion in a step",
            "1",
            0.8,
            Permitted::numbers(0.0..=1.0),
        ),
        Parameter::number(
            "weight",
            "of the forces at the end of a step in the theta scheme",
            "1",
            1.0,
            Permitted::numbers(0.0..=1.0),
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
    /// Steps of a quasi-static or implicit run.
    pub steps: u64,
    /// Residual in equilibrium of a quasi-static or implicit run, over the largest reaction or force.
    pub tolerance: f64,
    /// Scheme in time of an implicit run.
    pub integration: Integration,
}

impl Method {
    /// Reads the parameters that [`parameters`] declares.
    ///
    /// # Errors
    /// A parameter that the study did not declare.
    pub fn of(case: &Parameters) -> Result<Self, StudyError> {
        Ok(Self {
            spacing: case.number("h")?,
            solver: case.choice("solver")?.to_owned(),
            shape: case.choice("shape")?.to_owned(),
            explicit: explicit_settings(case)?,
            steps: declared(case, "steps", Parameters::count)?.unwrap_or(1),
            tolerance: declared(case, "tolerance", Parameters::number)?
                .unwrap_or(QuasiStaticSettings::default().tolerance),
            integration: integration(case)?,
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
        let step = end / self.steps as f64;
        let tolerance = self.tolerance;
        self.build_with(
            grid,
            match self.solver.as_str() {
                "quasi-static" => Chosen::QuasiStatic(QuasiStaticSettings {
                    step,
                    tolerance,
                    band,
                    ..QuasiStaticSettings::default()
                }),
                "implicit" => Chosen::Implicit(ImplicitSettings {
                    step,
                    tolerance,
                    band,
                    integration: self.integration,
                    ..ImplicitSettings::default()
                }),
                _ => Chosen::Explicit(ExplicitSettings {
                    band,
                    ..self.explicit
                }),
            },
        )
    }

    /// The solver with these settings on a grid, with the shape function of the method.
    ///
    /// # Errors
    /// A setting outside its range.
    pub fn build_with(
        &self,
        grid: Grid<2>,
        chosen: Chosen,
    ) -> Result<Box<dyn Solver<2>>, StudyError> {
        chosen.on(grid, &self.shape)
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

/// A parameter, if the study has it: it leaves out those of solvers that it does not permit.
fn declared<'a, T>(
    case: &'a Parameters,
    name: &str,
    read: impl Fn(&'a Parameters, &str) -> Result<T, ParameterError>,
) -> Result<Option<T>, StudyError> {
    Ok(match case.get(name) {
        Some(_) => Some(read(case, name)?),
        None => None,
    })
}

/// The explicit settings that the parameters say, the default ones of a study that has none.
///
/// # Errors
/// A parameter that the study did not declare.
pub fn explicit_settings(case: &Parameters) -> Result<ExplicitSettings, StudyError> {
    let default = ExplicitSettings::default();
    if case.get("transfer").is_none() {
        return Ok(default);
    }
    let cfl = declared(case, "cfl", Parameters::number)?.unwrap_or(default.cfl);
    let order = case.size("order")?;
    Ok(ExplicitSettings {
        cfl,
        transfer: match case.choice("transfer")? {
            "pic" => Transfer::Pic,
            "apic" => Transfer::Apic,
            "mls" => Transfer::Mls,
            "xpic" => Transfer::Xpic { order },
            "fmpm" => Transfer::Fmpm { order },
            _ => Transfer::Flip { pic: 0.0 },
        },
        stress_update: match case.choice("update")? {
            "first" => StressUpdate::First,
            "last" => StressUpdate::Last,
            _ => StressUpdate::Musl,
        },
        ..default
    })
}

fn integration(case: &Parameters) -> Result<Integration, StudyError> {
    Ok(match declared(case, "integration", Parameters::choice)? {
        Some("theta") => Integration::Theta {
            weight: case.number("weight")?,
        },
        Some("newmark") => Integration::Newmark {
            beta: 0.25,
            gamma: 0.5,
        },
        Some(_) => Integration::GeneralizedAlpha {
            spectral_radius: case.number("spectral_radius")?,
        },
        None => ImplicitSettings::default().integration,
    })
}

/// A solver and its settings.
#[derive(Clone, Copy, Debug)]
pub enum Chosen {
    /// Explicit steps.
    Explicit(ExplicitSettings),
    /// Equilibrium.
    QuasiStatic(QuasiStaticSettings),
    /// Implicit steps.
    Implicit(ImplicitSettings),
}

impl Chosen {
    /// The solver with these settings on a grid, with the shape function of this name in [`SHAPES`].
    ///
    /// # Errors
    /// A setting outside its range.
    pub fn on(self, grid: Grid<2>, name: &str) -> Result<Box<dyn Solver<2>>, StudyError> {
        let built = match name {
            "gimp" => self.build(grid, shape::Gimp),
            "cpdi" => self.build(grid, shape::Cpdi),
            "bspline2" => self.build(grid, shape::Bspline2),
            "bspline3" => self.build(grid, shape::Bspline3),
            _ => self.build(grid, shape::Linear),
        };
        built.map_err(StudyError::failed("setting up the solver"))
    }

    fn build<S: Shape<2>>(self, grid: Grid<2>, shape: S) -> Result<Box<dyn Solver<2>>, SolveError> {
        Ok(match self {
            Self::Explicit(settings) => Box::new(Explicit::new(grid, shape, settings)?),
            Self::QuasiStatic(settings) => Box::new(QuasiStatic::new(grid, shape, settings)?),
            Self::Implicit(settings) => Box::new(Implicit::new(grid, shape, settings)?),
        })
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
