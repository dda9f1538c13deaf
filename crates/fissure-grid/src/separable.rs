//! Stencils that are products of one weight per axis.

use nalgebra::SVector;

use crate::axes::{Axes, Numbers};
use crate::{Grid, Stencil, Window};

/// Weights along each axis: the first node relative to the particle's cell, values, and slopes per cell width.
pub(crate) type Line<const K: usize, const N: usize> =
    (Numbers<N>, [Numbers<N>; K], [Numbers<N>; K]);

/// The weights of a shape along an axis, given coordinates [0, 1] in the cell.
pub(crate) trait Profile<const K: usize> {
    /// Must be `#[inline(always)]`: a call would not be compiled for the vector unit.
    fn line<const N: usize>(&self, t: Numbers<N>) -> Line<K, N>;
}

/// A stencil that is a tensor product: K nodes along each of D axes, `N = Π_a n_a`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separable<const D: usize, const K: usize> {
    /// Window index of the lowest node.
    base: usize,
    values: [Axes; K],
    /// Derivatives of the values, 1/m.
    slopes: [Axes; K],
    /// From the particle to the lowest node, m.
    arm: Axes,
    /// Cell width, m.
    spacing: f64,
}

impl<const D: usize, const K: usize> Separable<D, K> {
    /// Builds from the weights along the axes, given the particle's coordinates [0, 1] in its cell. None if the particle
    /// is outside the grid or one of the nodes outside the window.
    #[inline(always)]
    pub(crate) fn new(
        grid: &Grid<D>,
        window: &Window<D>,
        x: &SVector<f64, D>,
        profile: &impl Profile<K>,
    ) -> Option<Self> {
        if !grid.contains(x) {
            return None;
        }
        let (cell, local) = grid.cell_and_local(x);
        let (first, values, slopes) = profile.line(local);
        let start = cell + first - Axes::from_axes::<D>(|axis| f64::from(window.first[axis]));
        let (mut base, mut fits) = (0.0, true);
        for (axis, start) in start.0.iter().enumerate().take(D) {
            fits &= *start >= 0.0 && *start <= f64::from(window.nodes) - K as f64;
            base += start * Window::<D>::ROW.pow(axis as u32) as f64;
        }
        let arm = (first - local) * grid.spacing();
        let mut stencil = Self {
            // A small whole number, unless it does not fit.
            base: base as u16 as usize,
            values,
            slopes,
            arm,
            spacing: grid.spacing(),
        };
        for slope in &mut stencil.slopes {
            *slope = *slope * grid.inverse_spacing();
        }
        fits.then_some(stencil)
    }
}

impl<const D: usize, const K: usize> Stencil<D> for Separable<D, K> {
    // D is known when this is compiled for a use, so one branch of each method remains.
    #[inline]
    fn visit(&self, mut f: impl FnMut(usize, f64, SVector<f64, D>)) {
        let (value, slope) = (&self.values, &self.slopes);
        let mut gradient = SVector::zeros();
        let row = Window::<D>::ROW;
        if D == 3 {
            for k in 0..K {
                for j in 0..K {
                    let start = self.base + row * (row * k + j);
                    let both = value[j].0[1] * value[k].0[2];
                    let along_1 = slope[j].0[1] * value[k].0[2];
                    let along_2 = value[j].0[1] * slope[k].0[2];
                    for i in 0..K {
                        gradient[0] = slope[i].0[0] * both;
                        gradient[1] = value[i].0[0] * along_1;
                        gradient[2] = value[i].0[0] * along_2;
                        f(start + i, value[i].0[0] * both, gradient);
                    }
                }
            }
        } else if D == 2 {
            for j in 0..K {
                let start = self.base + row * j;
                for i in 0..K {
                    gradient[0] = slope[i].0[0] * value[j].0[1];
                    gradient[1] = value[i].0[0] * slope[j].0[1];
                    f(start + i, value[i].0[0] * value[j].0[1], gradient);
                }
            }
        } else {
            for i in 0..K {
                gradient[0] = slope[i].0[0];
                f(self.base + i, value[i].0[0], gradient);
            }
        }
    }

    #[inline]
    fn visit_values(&self, mut f: impl FnMut(usize, f64)) {
        let value = &self.values;
        let row = Window::<D>::ROW;
        if D == 3 {
            for k in 0..K {
                for j in 0..K {
                    let start = self.base + row * (row * k + j);
                    let both = value[j].0[1] * value[k].0[2];
                    for (i, along) in value.iter().enumerate() {
                        f(start + i, along.0[0] * both);
                    }
                }
            }
        } else if D == 2 {
            for j in 0..K {
                let start = self.base + row * j;
                for (i, along) in value.iter().enumerate() {
                    f(start + i, along.0[0] * value[j].0[1]);
                }
            }
        } else {
            for (i, along) in value.iter().enumerate() {
                f(self.base + i, along.0[0]);
            }
        }
    }

    #[inline]
    fn arm(&self, window: usize) -> SVector<f64, D> {
        let (there, base) = (Window::<D>::place(window), Window::<D>::place(self.base));
        SVector::from_fn(|axis, _| {
            let k = there[axis] as f64 - base[axis] as f64;
            self.arm.0[axis] + k * self.spacing
        })
    }
}
