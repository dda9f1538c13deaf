//! Bilinear functions of the elements of a mesh.

use std::sync::Arc;

use fissure_tensor::Band;
use nalgebra::{Matrix2, Vector2};

use crate::patches::Patches;
use crate::quads::QuadStencil;
use crate::simd::{EIGHT, Lanes};
use crate::{Grid, OneByOne, QuadMesh, Shape, Window};

/// The functions of a [`QuadMesh`]: of the corners of the element that a particle is in. Goes with
/// [`QuadMesh::grid`] as the grid of a solver; the domain of a particle is not used.
///
/// On a mesh of equal squares along the axes they are those of [`Linear`](super::Linear). Everywhere
/// `Σ N = 1`, `Σ N x_i = x` and `Σ ∇N ⊗ x_i = 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Isoparametric(pub QuadMesh);

impl Shape<2> for Isoparametric {
    type Stencil = QuadStencil;
    type Stencils = OneByOne<QuadStencil>;

    fn name(&self) -> &'static str {
        "isoparametric"
    }

    fn patches(&self) -> Option<&Arc<Patches<2>>> {
        Some(self.0.patches())
    }

    fn goes_with(&self, grid: &Grid<2>) -> bool {
        self.0.grid() == *grid
    }

    fn home(&self, _grid: &Grid<2>, x: &Vector2<f64>, _cells: i32) -> Option<[i32; 2]> {
        let patch = self.0.patches().home(self.0.element(x)? as u32);
        Some([patch as i32, 0])
    }

    #[inline]
    fn stencil(
        &self,
        _grid: &Grid<2>,
        window: &Window<2>,
        x: &Vector2<f64>,
        _domain: &Matrix2<f64>,
    ) -> Option<QuadStencil> {
        self.0
            .stencil(window.first[0] as u32, None, x)
            .map(|found| found.0)
    }

    #[inline]
    fn stencils<L: Lanes>(
        &self,
        _lanes: L,
        _grid: &Grid<2>,
        window: &Window<2>,
        x: &[[f64; EIGHT]; 2],
        _domain: impl Fn(usize) -> Matrix2<f64>,
    ) -> OneByOne<QuadStencil> {
        // Particles that follow one another are near one another, mostly in one element.
        let mut last = None;
        OneByOne(std::array::from_fn(|place| {
            let x = Vector2::new(x[0][place], x[1][place]);
            let (stencil, element) = self.0.stencil(window.first[0] as u32, last, &x)?;
            last = Some(element);
            Some(stencil)
        }))
    }

    fn reach(&self) -> (i32, i32) {
        (0, 1)
    }

    /// At least as wide as any element's; each particle's own is [`band_at`](Shape::band_at).
    fn band(&self, _spacing: f64) -> Band {
        self.0.widest_band()
    }

    fn band_varies(&self) -> bool {
        matches!(self.0.widest_band(), Band::Uniform(_))
    }

    fn band_at(&self, x: &Vector2<f64>) -> Option<Band> {
        Some(self.0.band(self.0.element(x)?))
    }
}
