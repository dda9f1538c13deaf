//! Uniform B-splines of second and third degree (Steffen, Kirby & Berzins 2008), not modified at the grid's faces.

use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};

use crate::axes::Numbers;
use crate::separable::{Line, Profile};
use crate::simd::{EIGHT, Lanes};
use crate::{Grid, Separable, SeparableStencils, Shape, Window};

/// Quadratic B-splines, continuous gradient. The domain is not used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bspline2;

/// Cubic B-splines, continuous second derivative. The domain is not used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bspline3;

impl<const D: usize> Shape<D> for Bspline2 {
    type Stencil = Separable<D, 3>;
    type Stencils = SeparableStencils<D, 3>;
    const MOMENTS: bool = true;

    fn name(&self) -> &'static str {
        "bspline2"
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
    type Stencils = SeparableStencils<D, 4>;
    const MOMENTS: bool = true;

    fn name(&self) -> &'static str {
        "bspline3"
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
        (1, 2)
    }

    fn band(&self, spacing: f64) -> Band {
        Band::Uniform(3.0 * spacing)
    }

    fn affine_inverse(&self, spacing: f64) -> Option<f64> {
        Some(3.0 / (spacing * spacing))
    }
}

impl Profile<3> for Bspline2 {
    /// The nearest node and the ones beside it; `d` is the distance to it in cells.
    #[inline(always)]
    fn line<const N: usize>(&self, t: Numbers<N>) -> Line<3, N> {
        let nearest = t.step(0.5);
        let d = t - nearest;
        let (below, above) = (-d + 0.5, d + 0.5);
        (
            nearest + -1.0,
            [below * below * 0.5, -(d * d) + 0.75, above * above * 0.5],
            [-below, d * -2.0, above],
        )
    }
}

impl Profile<4> for Bspline3 {
    #[inline(always)]
    fn line<const N: usize>(&self, t: Numbers<N>) -> Line<4, N> {
        let s = -t + 1.0;
        let (t2, s2) = (t * t, s * s);
        let sixth = 1.0 / 6.0;
        (
            Numbers::splat(-1.0),
            [
                s2 * s * sixth,
                t2 * (t * 0.5 + -1.0) + 2.0 / 3.0,
                s2 * (s * 0.5 + -1.0) + 2.0 / 3.0,
                t2 * t * sixth,
            ],
            [
                s2 * -0.5,
                t * (t * 1.5 + -2.0),
                -(s * (s * 1.5 + -2.0)),
                t2 * 0.5,
            ],
        )
    }
}
