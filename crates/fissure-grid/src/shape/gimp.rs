//! Linear functions averaged over the particle's box.

use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};

use crate::axes::Numbers;
use crate::separable::{Line, Profile};
use crate::simd::{EIGHT, Lanes};
use crate::{Grid, Separable, SeparableStencils, Shape, Window};

/// uGIMP: linear functions averaged over a cube of fixed size round the particle (Bardenhagen & Kober 2004).
///
/// The cube is aligned with the grid and has the volume of the particle's domain, whatever the domain's orientation:
/// half-length `l = ½ |det(2 edges)|^(1/D)`. No stencil if `l` exceeds half a cell (one particle per cell).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gimp;

/// Part of a cell by which a half-length may exceed half a cell through rounding.
const SLACK: f64 = 1e-9;

impl<const D: usize> Shape<D> for Gimp {
    type Stencil = Separable<D, 3>;
    type Stencils = SeparableStencils<D, 3>;

    fn name(&self) -> &'static str {
        "gimp"
    }

    #[inline(always)]
    fn stencil(
        &self,
        grid: &Grid<D>,
        window: &Window<D>,
        x: &SVector<f64, D>,
        domain: &SMatrix<f64, D, D>,
    ) -> Option<Self::Stencil> {
        Separable::new(grid, window, x, &Averaged::of(grid, domain)?)
    }

    #[inline(always)]
    fn stencils<L: Lanes>(
        &self,
        lanes: L,
        grid: &Grid<D>,
        window: &Window<D>,
        x: &[[f64; EIGHT]; D],
        domain: impl Fn(usize) -> SMatrix<f64, D, D>,
    ) -> Self::Stencils {
        match Averaged::of(grid, &domain(0)) {
            Some(averaged) => SeparableStencils::new(lanes, grid, window, x, &averaged),
            None => SeparableStencils::none(),
        }
    }

    fn reach(&self) -> (i32, i32) {
        (1, 2)
    }

    fn band(&self, spacing: f64) -> Band {
        Band::Uniform(spacing)
    }
}

/// Linear functions averaged over a box of half-length `half` in (0, ½] cells.
struct Averaged {
    half: f64,
    /// 1/(2 half).
    inverse: f64,
}

impl Averaged {
    /// `None` for a box that is too large.
    #[inline(always)]
    fn of<const D: usize>(grid: &Grid<D>, domain: &SMatrix<f64, D, D>) -> Option<Self> {
        let half = half_length(domain) * grid.inverse_spacing();
        if !(0.0..=0.5 + SLACK).contains(&half) {
            return None;
        }
        // A point is the limit of a small box.
        let half = half.clamp(f64::MIN_POSITIVE, 0.5);
        let inverse = 0.5 / half;
        Some(Self { half, inverse })
    }
}

/// Half the edge of the cube of equal volume, m.
#[inline(always)]
fn half_length<const D: usize>(edges: &SMatrix<f64, D, D>) -> f64 {
    // Almost every lattice is aligned and cubic: no root is needed, and no rounding happens.
    let first = edges[(0, 0)];
    if *edges == SMatrix::<f64, D, D>::from_diagonal_element(first) {
        return first.abs();
    }
    let e = |i: usize, j: usize| edges[(i, j)];
    match D {
        1 => first.abs(),
        2 => (e(0, 0) * e(1, 1) - e(0, 1) * e(1, 0)).abs().sqrt(),
        _ => {
            let minor = |j: usize, k: usize| e(1, j) * e(2, k) - e(1, k) * e(2, j);
            (e(0, 0) * minor(1, 2) - e(0, 1) * minor(0, 2) + e(0, 2) * minor(0, 1))
                .abs()
                .cbrt()
        }
    }
}

impl Profile<3> for Averaged {
    /// Weights of the nearest node and the ones beside it for a box of half-length `l`.
    ///
    /// Written with the distance `d` to the nearest node, so that small boxes lose no digits, and without branches, which
    /// particles would take at random: the node's kink cuts the box in parts of length l − a and l + a, one of them zero when
    /// the kink is outside, and the rest of `d` acts as on linear functions.
    #[inline(always)]
    fn line<const N: usize>(&self, t: Numbers<N>) -> Line<3, N> {
        let (l, inverse) = (self.half, self.inverse);
        let nearest = t.step(0.5);
        let d = t - nearest;
        let a = d.max(Numbers::splat(-l)).min(Numbers::splat(l));
        let (left, right) = (-a + l, a + l);
        let (below, above) = (left * inverse, right * inverse);
        let zero = Numbers::splat(0.0);
        let low = below * left * 0.5 + (a - d).max(zero);
        let high = above * right * 0.5 + (d - a).max(zero);
        (
            nearest + -1.0,
            [low, -(low + high) + 1.0, high],
            [-below, below - above, above],
        )
    }
}
