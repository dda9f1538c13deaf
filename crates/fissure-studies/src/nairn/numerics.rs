//! What the studies may choose of the discretisation, and the solver that it makes.

use std::thread::available_parallelism;

use fissure::prelude::*;
use fissure_study::{Parameter, Parameters, Permitted, StudyError};

use crate::method::{Chosen, SHAPES};

/// Shape functions, transfer, band and step of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numerics {
    shape: &'static str,
    pub settings: ExplicitSettings,
    pub spacing: f64,
    threads: usize,
}

impl Numerics {
    /// The parameters that [`of`](Self::of) reads: those of the document, and the grid spacing `h`.
    pub(super) fn parameters(h: f64) -> Vec<Parameter> {
        let threads = available_parallelism().map_or(1, |n| n.get() as u64);
        vec![
            Parameter::number("h", "grid spacing", "m", h, Permitted::above(0.0)),
            Parameter::choice("shape", "shape function", "gimp", SHAPES),
            Parameter::choice(
                "transfer",
                "between particles and grid",
                "xpic",
                &["flip", "pic", "apic", "mls", "xpic", "fmpm"],
            ),
            Parameter::count(
                "order",
                "terms of xpic and fmpm",
                5,
                Permitted::counts(1..=20),
            ),
            Parameter::choice(
                "band",
                "width that smears the crack: V_p/A_c as in the document, or the discretisation's",
                "particle",
                &["particle", "discretisation"],
            ),
            Parameter::choice(
                "stress",
                "when it is updated in a step",
                "first",
                &["first", "last", "musl"],
            ),
            Parameter::number(
                "cfl",
                "step over the time a wave needs across a cell",
                "1",
                0.5,
                Permitted::numbers(0.01..=1.0),
            ),
            Parameter::count(
                "threads",
                "worker threads",
                threads,
                Permitted::counts(1..=256),
            ),
        ]
    }

    pub(super) fn of(case: &Parameters) -> Result<Self, StudyError> {
        let order = case.size("order")?;
        let settings = ExplicitSettings {
            cfl: case.number("cfl")?,
            transfer: match case.choice("transfer")? {
                "flip" => Transfer::Flip { pic: 0.0 },
                "pic" => Transfer::Pic,
                "apic" => Transfer::Apic,
                "mls" => Transfer::Mls,
                "fmpm" => Transfer::Fmpm { order },
                _ => Transfer::Xpic { order },
            },
            stress_update: match case.choice("stress")? {
                "first" => StressUpdate::First,
                "last" => StressUpdate::Last,
                _ => StressUpdate::Musl,
            },
            band: match case.choice("band")? {
                "discretisation" => BandSource::Discretisation,
                _ => BandSource::Particle,
            },
            ..ExplicitSettings::default()
        };
        Ok(Self {
            shape: shape_named(case.choice("shape")?),
            settings,
            spacing: case.number("h")?,
            threads: case.size("threads")?,
        })
    }

    /// An explicit solver on this grid, in the plane.
    pub(super) fn solver(&self, grid: Grid<2>) -> Result<Box<dyn Solver<2>>, StudyError> {
        Chosen::Explicit(self.settings).on(grid, self.shape)
    }

    /// A quasi-static solver on this grid, in the plane, with the band of these numerics.
    pub(super) fn equilibrium(
        &self,
        grid: Grid<2>,
        settings: QuasiStaticSettings,
    ) -> Result<Box<dyn Solver<2>>, StudyError> {
        let band = self.settings.band;
        Chosen::QuasiStatic(QuasiStaticSettings { band, ..settings }).on(grid, self.shape)
    }

    /// The same in space, for the shapes that the studies use there: each is code of its own to
    /// compile.
    pub(super) fn solver_in_space(
        &self,
        case: &Parameters,
        grid: Grid<3>,
    ) -> Result<Box<dyn Solver<3>>, StudyError> {
        let settings = self.settings;
        let made: Result<Box<dyn Solver<3>>, _> = match self.shape {
            "gimp" => boxed(Explicit::new(grid, shape::Gimp, settings)),
            "bspline2" => boxed(Explicit::new(grid, shape::Bspline2, settings)),
            _ => {
                return Err(StudyError::combination(
                    case,
                    &["shape"],
                    "in space the shapes are gimp and bspline2",
                ));
            }
        };
        made.map_err(StudyError::failed("setting up the solver"))
    }

    /// Runs `work` on the threads that were asked for.
    pub(super) fn on_threads<T: Send>(
        &self,
        work: impl FnOnce() -> Result<T, StudyError> + Send,
    ) -> Result<T, StudyError> {
        rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads)
            .build()
            .map_err(StudyError::failed("starting the worker threads"))?
            .install(work)
    }
}

/// The name among [`SHAPES`].
fn shape_named(name: &str) -> &'static str {
    SHAPES
        .iter()
        .find(|shape| **shape == name)
        .unwrap_or(&SHAPES[0])
}

fn boxed<const D: usize, S: Solver<D> + 'static>(
    made: Result<S, SolveError>,
) -> Result<Box<dyn Solver<D>>, SolveError> {
    made.map(|solver| Box::new(solver) as Box<dyn Solver<D>>)
}

/// Two particles per cell and axis.
pub(super) fn seeding(spacing: f64) -> Spacing {
    Spacing(0.5 * spacing)
}

/// Refuses lengths that are not whole numbers of cells, with the names of their parameters.
pub(super) fn check_whole_cells(case: &Parameters, lengths: &[&str]) -> Result<(), StudyError> {
    let spacing = case.number("h")?;
    for name in lengths {
        let cells = case.number(name)? / spacing;
        if !((cells - cells.round()).abs() <= 1e-6 && cells.round() >= 1.0) {
            return Err(StudyError::combination(
                case,
                &["h", name],
                format!("{name} must be a whole number of cells"),
            ));
        }
    }
    Ok(())
}
