//! Shape functions: how a particle is spread over the nodes.
//!
//! | shape | nodes per axis | gradient | band | remark |
//! |---|---|---|---|---|
//! | [`Linear`] | 2 | jumps at cell faces | exact for cracks | cheapest; noise when particles cross faces |
//! | [`Gimp`] | 3 | continuous | energy-fitting | box of fixed size |
//! | [`Cpdi`] | up to 4 | not the derivative of N | energy-fitting | the domain follows the deformation |
//! | [`Bspline2`] | 3 | continuous | energy-fitting | needs no domain |
//! | [`Bspline3`] | 4 | smooth | energy-fitting | needs no domain |
//! | [`Isoparametric`] | 2 | jumps at faces | exact for cracks in parallelograms | of a [`QuadMesh`](crate::QuadMesh), in the plane |
//!
//! All have ΣN = 1, ΣN x_i = x and Σ∇N ⊗ x_i = 1. None is modified at the grid's faces.

use std::sync::Arc;

use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};

use crate::simd::{EIGHT, Lanes};
use crate::{Grid, Patches, Stencil, Stencils, Window, tile_of};

mod bspline;
mod cpdi;
mod gimp;
mod isoparametric;
mod linear;

pub use bspline::{Bspline2, Bspline3};
pub use cpdi::{Corners, Cpdi};
pub use gimp::Gimp;
pub use isoparametric::Isoparametric;
pub use linear::Linear;

/// A shape function.
pub trait Shape<const D: usize>: Clone + Send + Sync + std::fmt::Debug + 'static {
    /// The weights of one particle.
    type Stencil: Stencil<D>;
    /// The weights of eight; [`OneByOne`](crate::OneByOne) serves any shape.
    type Stencils: Stencils<D>;
    /// Whether [`domain`](Self::domain) follows the deformation gradient.
    const DEFORMS: bool = false;
    /// Whether [`affine_inverse`](Self::affine_inverse) is there: kernels that are not needed are then not compiled.
    const MOMENTS: bool = false;

    /// Name used in output and input: "linear", "gimp", "cpdi", "bspline2", "bspline3", "isoparametric".
    fn name(&self) -> &'static str;

    /// The patches of the mesh whose nodes these functions are of; `None` for those of a grid's nodes.
    fn patches(&self) -> Option<&Arc<Patches<D>>> {
        None
    }

    /// Whether the functions can be used with this grid; those of a mesh with its own alone.
    fn goes_with(&self, _grid: &Grid<D>) -> bool {
        true
    }

    /// The tile of so many cells along each axis that a particle at `x` (m) is sorted by, or the number of its patch as
    /// the first coordinate. None if it is outside.
    #[inline]
    fn home(&self, grid: &Grid<D>, x: &SVector<f64, D>, cells: i32) -> Option<[i32; D]> {
        grid.cell(x).map(|cell| tile_of(cell, cells))
    }

    /// The domain (half-edge vectors as columns, m) the particle has now, from the one it was seeded with and the upper
    /// left D×D block of its deformation gradient. Kept as it was unless the shape deforms it, as CPDI does.
    #[inline(always)]
    fn domain(&self, initial: &SMatrix<f64, D, D>, _f: &SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
        *initial
    }

    /// Weights of a particle at `x` (m) with the half-edges `domain` (columns, m), in the window of its
    /// tile.
    ///
    /// None if the particle is outside the grid, if a node is outside the window, or if the shape cannot use the domain.
    /// A particle that left the tile is served as long as its nodes fit the window, so sorting may lag a step or two.
    /// Nodes may lie outside the grid's cells.
    fn stencil(
        &self,
        grid: &Grid<D>,
        window: &Window<D>,
        x: &SVector<f64, D>,
        domain: &SMatrix<f64, D, D>,
    ) -> Option<Self::Stencil>;

    /// Weights of eight particles of a window at `x` (m, for each axis those of the eight), with the domain of each place; as [`stencil`](Self::stencil). A shape whose
    /// domain is always the initial one may ask for that of place 0 alone.
    fn stencils<L: Lanes>(
        &self,
        lanes: L,
        grid: &Grid<D>,
        window: &Window<D>,
        x: &[[f64; EIGHT]; D],
        domain: impl Fn(usize) -> SMatrix<f64, D, D>,
    ) -> Self::Stencils;

    /// How far the nodes lie from the lower node of the particle's cell, along an axis: (nodes below it, nodes above it),
    /// so (0, 1) for linear functions.
    fn reach(&self) -> (i32, i32);

    /// Width over which a smeared crack dissipates its energy on a grid of cells `spacing` (m) wide.
    ///
    /// Exact for linear functions: the mean number of cells a crack crosses, `h (|n_x| + |n_y| + |n_z|)`. Wider functions
    /// have no exact one, since the points of a band do not soften at once; what is given makes the total energy
    /// dissipated by a bar with an aligned crack about right (h, h, 2h and 3h for uGIMP, CPDI, quadratic and cubic
    /// B-splines). For uGIMP that is measured with the crack at zero offset from the particles' symmetry plane; at offsets of
    /// h/8 and h/4 it dissipates 1.31 and 1.44 times as much. The onset of softening in the splines wants less, 1.5 h and
    /// 1.82 h.
    fn band(&self, spacing: f64) -> Band;

    /// Whether particles have bands of their own, [`band_at`](Self::band_at).
    fn band_varies(&self) -> bool {
        false
    }

    /// The band at a place (m), where it is not everywhere that of [`band`](Self::band); None outside.
    fn band_at(&self, _x: &SVector<f64, D>) -> Option<Band> {
        None
    }

    /// Inverse of APIC's moment `Σ N (x_i − x)(x_i − x)ᵀ`, 1/m², where it is a multiple of the identity that does not
    /// depend on the place (splines: 4/h², 3/h²). `None` elsewhere: the velocity gradient is then the affine part, which
    /// is the same thing for linear functions [Jiang et al. 2015].
    fn affine_inverse(&self, _spacing: f64) -> Option<f64> {
        None
    }
}
