//! Scenes and solvers by dimension, so that one generic test runs in all of them.

use fissure::prelude::*;

use crate::case::{Case, ShapeKind, Space};

/// Builds what depends on the dimension; compiled here once for all test binaries.
pub trait Build<const D: usize> {
    /// An explicit solver for a shape by name.
    ///
    /// # Errors
    /// A setting outside its range.
    fn solver(
        shape: ShapeKind,
        grid: Grid<D>,
        settings: ExplicitSettings,
    ) -> Result<Box<dyn Solver<D>>, SolveError>;

    /// An empty scene; plane scenes are 1 m thick.
    fn scene(space: Space) -> Scene<D>;

    /// The solver of a row of the table.
    ///
    /// # Errors
    /// A setting outside its range.
    fn row(case: &Case, grid: Grid<D>, cfl: f64) -> Result<Box<dyn Solver<D>>, SolveError> {
        Self::solver(case.shape, grid, case.settings(cfl))
    }
}

/// The only implementor of [`Build`].
pub struct Table;

macro_rules! build {
    ($dimension:literal, $scene:expr) => {
        impl Build<$dimension> for Table {
            fn solver(
                kind: ShapeKind,
                grid: Grid<$dimension>,
                settings: ExplicitSettings,
            ) -> Result<Box<dyn Solver<$dimension>>, SolveError> {
                Ok(match kind {
                    ShapeKind::Linear => Box::new(Explicit::new(grid, shape::Linear, settings)?),
                    ShapeKind::Gimp => Box::new(Explicit::new(grid, shape::Gimp, settings)?),
                    ShapeKind::Cpdi => Box::new(Explicit::new(grid, shape::Cpdi, settings)?),
                    ShapeKind::Bspline2 => {
                        Box::new(Explicit::new(grid, shape::Bspline2, settings)?)
                    }
                    ShapeKind::Bspline3 => {
                        Box::new(Explicit::new(grid, shape::Bspline3, settings)?)
                    }
                })
            }

            fn scene(space: Space) -> Scene<$dimension> {
                $scene(space)
            }
        }
    };
}

build!(2, |space| match space {
    Space::Axisymmetric => Scene::axisymmetric(),
    _ => Scene::plane(Plane::Strain { thickness: 1.0 }),
});
build!(3, |_| Scene::solid());
