//! Where the width of a crack comes from.

use fissure_grid::{Grid, Shape};
use fissure_scene::{Body, Scene, SolveError};
use fissure_tensor::Band;

/// Where the width of a crack comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BandSource {
    /// The discretisation: the cells a crack crosses. The input fracture energy is then physical.
    #[default]
    Discretisation,
    /// Volume over central section of the particle, to reproduce Nairn 2017; dissipates twice the
    /// input with two particles across a cell.
    Particle,
}

impl BandSource {
    /// Band of a body's cracks on a grid with a shape function.
    pub fn band<S: Shape<D>, const D: usize>(
        self,
        shape: &S,
        grid: &Grid<D>,
        body: &Body<D>,
    ) -> Band {
        match self {
            Self::Discretisation => shape.band(grid.spacing()),
            Self::Particle => {
                let mut edges = [0.0; 3];
                for (axis, edge) in edges.iter_mut().enumerate().take(D) {
                    *edge = 2.0 * body.half_edges().column(axis).norm();
                }
                Band::Section(edges)
            }
        }
    }

    /// Whether particles have bands of their own.
    pub(crate) fn varies<S: Shape<D>, const D: usize>(self, shape: &S) -> bool {
        self == Self::Discretisation && shape.band_varies()
    }

    /// Refuses a scene with a body whose law has no unique response on this band.
    pub(crate) fn check<S: Shape<D>, const D: usize>(
        self,
        shape: &S,
        grid: &Grid<D>,
        scene: &Scene<D>,
    ) -> Result<(), SolveError> {
        for body in scene.bodies() {
            let refused = |source| SolveError::Band {
                body: body.name().to_owned(),
                source,
            };
            body.check_band(&self.band(shape, grid, body))
                .map_err(refused)?;
        }
        Ok(())
    }
}
