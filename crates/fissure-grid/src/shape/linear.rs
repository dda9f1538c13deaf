//! Linear functions: the corners of the particle's cell.

use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};

use crate::axes::Axes;
use crate::{Grid, Separable, Shape};

/// Multilinear functions of the particle's position (Sulsky, Chen & Schreyer 1994). The domain is not used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Linear;

impl<const D: usize> Shape<D> for Linear {
    type Stencil = Separable<D, 2>;

    fn name(&self) -> &'static str {
        "linear"
    }

    #[inline(always)]
    fn stencil(
        &self,
        grid: &Grid<D>,
        tile: [i32; D],
        x: &SVector<f64, D>,
        _domain: &SMatrix<f64, D, D>,
    ) -> Option<Self::Stencil> {
        Separable::new(grid, tile, x, |t| {
            let (zero, one) = (Axes::splat(0.0), Axes::splat(1.0));
            (zero, [one - t, t], [-one, one])
        })
    }

    fn reach(&self) -> (i32, i32) {
        (0, 1)
    }

    fn band(&self, spacing: f64) -> Band {
        Band::Projected([spacing; 3])
    }
}
