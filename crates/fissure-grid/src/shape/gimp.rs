//! Linear functions averaged over the particle's box.

use nalgebra::{SMatrix, SVector};

use crate::separable::Line;
use crate::{Grid, Separable, Shape};

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

    fn name(&self) -> &'static str {
        "gimp"
    }

    #[inline]
    fn stencil(
        &self,
        grid: &Grid<D>,
        tile: [i32; D],
        x: &SVector<f64, D>,
        domain: &SMatrix<f64, D, D>,
    ) -> Option<Self::Stencil> {
        let half = half_length(domain) * grid.inverse_spacing();
        if !(0.0..=0.5 + SLACK).contains(&half) {
            return None;
        }
        let half = half.min(0.5);
        Separable::new(grid, tile, x, |t| averaged(t, half))
    }

    fn reach(&self) -> (i32, i32) {
        (1, 2)
    }
}

/// Half the edge of the cube of equal volume, m.
#[inline]
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

/// Weights of the nearest node and the ones beside it for a box of half-length `l` ≤ ½ cell. Written with the distance
/// `d` to the nearest node, so that small boxes lose no digits.
#[inline]
fn averaged(t: f64, l: f64) -> Line<3> {
    let nearest = i32::from(t >= 0.5);
    let d = t - f64::from(nearest);
    let first = nearest - 1;
    if d >= l {
        (first, [0.0, 1.0 - d, d], [0.0, -1.0, 1.0])
    } else if d <= -l {
        (first, [-d, 1.0 + d, 0.0], [-1.0, 1.0, 0.0])
    } else {
        // The node's kink is inside the box: parts of length l − d and l + d lie below and above it.
        let (below, above) = ((l - d) / (2.0 * l), (l + d) / (2.0 * l));
        let (low, high) = (0.5 * below * (l - d), 0.5 * above * (l + d));
        (
            first,
            [low, 1.0 - (low + high), high],
            [-below, below - above, above],
        )
    }
}
