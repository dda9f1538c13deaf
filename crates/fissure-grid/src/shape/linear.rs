//! Linear functions: the corners of the particle's cell.

use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};

use crate::axes::Numbers;
use crate::separable::{Line, Profile};
use crate::simd::{EIGHT, Lanes};
use crate::{Grid, Separable, SeparableStencils, Shape, Window};

/// Multilinear functions of the particle's position (Sulsky, Chen & Schreyer 1994). The domain is not used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Linear;

impl<const D: usize> Shape<D> for Linear {
    type Stencil = Separable<D, 2>;
    type Stencils = SeparableStencils<D, 2>;

    fn name(&self) -> &'static str {
        "linear"
    }

    #[inline(always)]
    fn stencil(
        &self,
        grid: &Grid<D>,
        window: &Window<D>,
        x: &SVector<f64, D>,
        _domain: &SMatrix<f64, D, D>,
    ) -> Option<Self::Stencil> {
        Separable::new(grid, window, x, self)
    }

    #[inline(always)]
    fn stencils<L: Lanes>(
        &self,
        lanes: L,
        grid: &Grid<D>,
        window: &Window<D>,
        x: &[[f64; EIGHT]; D],
        _domain: impl Fn(usize) -> SMatrix<f64, D, D>,
    ) -> Self::Stencils {
        SeparableStencils::new(lanes, grid, window, x, self)
    }

    fn reach(&self) -> (i32, i32) {
        (0, 1)
    }

    fn band(&self, spacing: f64) -> Band {
        Band::Projected([spacing; 3])
    }
}

impl Profile<2> for Linear {
    #[inline(always)]
    fn line<const N: usize>(&self, t: Numbers<N>) -> Line<2, N> {
        let (zero, one) = (Numbers::splat(0.0), Numbers::splat(1.0));
        (zero, [one - t, t], [-one, one])
    }
}
