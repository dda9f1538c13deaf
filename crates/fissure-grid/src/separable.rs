//! Stencils that are products of one weight per axis.

use nalgebra::SVector;

use crate::window::window_start;
use crate::{Grid, Stencil, WINDOW};

/// Window stride of axis 1.
const ROW: usize = WINDOW as usize;
/// Window stride of axis 2.
const LAYER: usize = (WINDOW * WINDOW) as usize;

/// Weights along one axis: the first node relative to the particle's cell, values, and slopes per cell width.
pub(crate) type Line<const K: usize> = (i32, [f64; K], [f64; K]);

/// A stencil that is a tensor product: K nodes along each of D axes, `N = Π_a n_a`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separable<const D: usize, const K: usize> {
    /// Window index of the lowest node.
    base: usize,
    values: [[f64; K]; D],
    /// Derivatives of the values, 1/m.
    slopes: [[f64; K]; D],
}

impl<const D: usize, const K: usize> Separable<D, K> {
    /// Builds from the weights along an axis, given the particle's coordinate [0, 1] in its cell. None if the particle is
    /// outside the grid or one of the nodes outside the tile's window.
    #[inline]
    pub(crate) fn new(
        grid: &Grid<D>,
        tile: [i32; D],
        x: &SVector<f64, D>,
        line: impl Fn(f64) -> Line<K>,
    ) -> Option<Self> {
        let (cell, local) = grid.locate(x)?;
        let mut stencil = Self {
            base: 0,
            values: [[0.0; K]; D],
            slopes: [[0.0; K]; D],
        };
        for axis in 0..D {
            let (first, values, slopes) = line(local[axis]);
            stencil.base += window_start(tile[axis], cell[axis] + first, K as i32)? << (3 * axis);
            stencil.values[axis] = values;
            stencil.slopes[axis] = slopes.map(|slope| slope * grid.inverse_spacing());
        }
        Some(stencil)
    }
}

impl<const D: usize, const K: usize> Stencil<D> for Separable<D, K> {
    // D is known when this is compiled for a use, so one branch of each method remains.
    #[inline]
    fn visit(&self, mut f: impl FnMut(usize, f64, SVector<f64, D>)) {
        let (value, slope) = (&self.values, &self.slopes);
        let mut gradient = SVector::zeros();
        if D == 3 {
            for k in 0..K {
                for j in 0..K {
                    let start = self.base + LAYER * k + ROW * j;
                    let both = value[1][j] * value[2][k];
                    let along_1 = slope[1][j] * value[2][k];
                    let along_2 = value[1][j] * slope[2][k];
                    for i in 0..K {
                        gradient[0] = slope[0][i] * both;
                        gradient[1] = value[0][i] * along_1;
                        gradient[2] = value[0][i] * along_2;
                        f(start + i, value[0][i] * both, gradient);
                    }
                }
            }
        } else if D == 2 {
            for j in 0..K {
                let start = self.base + ROW * j;
                for i in 0..K {
                    gradient[0] = slope[0][i] * value[1][j];
                    gradient[1] = value[0][i] * slope[1][j];
                    f(start + i, value[0][i] * value[1][j], gradient);
                }
            }
        } else {
            for i in 0..K {
                gradient[0] = slope[0][i];
                f(self.base + i, value[0][i], gradient);
            }
        }
    }

    #[inline]
    fn visit_values(&self, mut f: impl FnMut(usize, f64)) {
        let value = &self.values;
        if D == 3 {
            for k in 0..K {
                for j in 0..K {
                    let start = self.base + LAYER * k + ROW * j;
                    let both = value[1][j] * value[2][k];
                    for (i, along) in value[0].iter().enumerate() {
                        f(start + i, along * both);
                    }
                }
            }
        } else if D == 2 {
            for j in 0..K {
                let start = self.base + ROW * j;
                for (i, along) in value[0].iter().enumerate() {
                    f(start + i, along * value[1][j]);
                }
            }
        } else {
            for (i, &along) in value[0].iter().enumerate() {
                f(self.base + i, along);
            }
        }
    }
}
