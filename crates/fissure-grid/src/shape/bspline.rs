//! Uniform B-splines of second and third degree (Steffen, Kirby & Berzins 2008), not modified at the grid's faces.

use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};

use crate::separable::Line;
use crate::{Grid, Separable, Shape};

/// Quadratic B-splines, continuous gradient. The domain is not used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bspline2;

/// Cubic B-splines, continuous second derivative. The domain is not used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bspline3;

impl<const D: usize> Shape<D> for Bspline2 {
    type Stencil = Separable<D, 3>;

    fn name(&self) -> &'static str {
        "bspline2"
    }

    #[inline(always)]
    fn stencil(
        &self,
        grid: &Grid<D>,
        tile: [i32; D],
        x: &SVector<f64, D>,
        _domain: &SMatrix<f64, D, D>,
    ) -> Option<Self::Stencil> {
        Separable::new(grid, tile, x, quadratic)
    }

    fn reach(&self) -> (i32, i32) {
        (1, 2)
    }

    fn band(&self, spacing: f64) -> Band {
        Band::Uniform(2.0 * spacing)
    }

    fn affine_inverse(&self, spacing: f64) -> Option<f64> {
        Some(4.0 / (spacing * spacing))
    }
}

impl<const D: usize> Shape<D> for Bspline3 {
    type Stencil = Separable<D, 4>;

    fn name(&self) -> &'static str {
        "bspline3"
    }

    #[inline(always)]
    fn stencil(
        &self,
        grid: &Grid<D>,
        tile: [i32; D],
        x: &SVector<f64, D>,
        _domain: &SMatrix<f64, D, D>,
    ) -> Option<Self::Stencil> {
        Separable::new(grid, tile, x, cubic)
    }

    fn reach(&self) -> (i32, i32) {
        (1, 2)
    }

    fn band(&self, spacing: f64) -> Band {
        Band::Uniform(3.0 * spacing)
    }

    fn affine_inverse(&self, spacing: f64) -> Option<f64> {
        Some(3.0 / (spacing * spacing))
    }
}

/// The nearest node and the ones beside it; `d` is the distance to it in cells.
#[inline(always)]
fn quadratic(t: f64) -> Line<3> {
    let nearest = if t >= 0.5 { 1.0 } else { 0.0 };
    let d = t - nearest;
    let (below, above) = (0.5 - d, 0.5 + d);
    (
        nearest - 1.0,
        [0.5 * below * below, 0.75 - d * d, 0.5 * above * above],
        [-below, -2.0 * d, above],
    )
}

#[inline(always)]
fn cubic(t: f64) -> Line<4> {
    let s = 1.0 - t;
    let (t2, s2) = (t * t, s * s);
    let inner = |square: f64, one: f64| 2.0 / 3.0 - square * (1.0 - 0.5 * one);
    (
        -1.0,
        [s2 * s / 6.0, inner(t2, t), inner(s2, s), t2 * t / 6.0],
        [
            -0.5 * s2,
            -t * (2.0 - 1.5 * t),
            s * (2.0 - 1.5 * s),
            0.5 * t2,
        ],
    )
}
