//! Stencils that are products of one weight per axis.

use nalgebra::SVector;

use crate::axes::Axes;
use crate::simd::Lanes;
use crate::stencil::{FIELD, Gathered, Gift, SUMS};
use crate::{Grid, Stencil, TILE, WINDOW, WINDOW_START};

/// Window stride of axis 1.
const ROW: usize = WINDOW as usize;
/// Window stride of axis 2.
const LAYER: usize = (WINDOW * WINDOW) as usize;

/// Weights along each axis: the first node relative to the particle's cell, values, and slopes per cell width.
pub(crate) type Line<const K: usize> = (Axes, [Axes; K], [Axes; K]);

/// A stencil that is a tensor product: K nodes along each of D axes, `N = Π_a n_a`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separable<const D: usize, const K: usize> {
    /// Window index of the lowest node.
    base: usize,
    values: [Axes; K],
    /// Derivatives of the values, 1/m.
    slopes: [Axes; K],
    /// Values times arms, m.
    moments: [Axes; K],
    /// From the particle to the lowest node, m.
    arm: Axes,
    /// Cell width, m.
    spacing: f64,
}

impl<const D: usize, const K: usize> Separable<D, K> {
    /// Builds from the weights along the axes, given the particle's coordinates [0, 1] in its cell. None if the particle
    /// is outside the grid or one of the nodes outside the tile's window.
    #[inline(always)]
    pub(crate) fn new(
        grid: &Grid<D>,
        tile: [i32; D],
        x: &SVector<f64, D>,
        line: impl Fn(Axes) -> Line<K>,
    ) -> Option<Self> {
        if !grid.contains(x) {
            return None;
        }
        let (cell, local) = grid.cell_and_local(x);
        let (first, values, slopes) = line(local);
        let window = Axes::from_axes::<D>(|axis| {
            f64::from(TILE) * f64::from(tile[axis]) + f64::from(WINDOW_START)
        });
        let start = cell + first - window;
        let (mut base, mut fits) = (0.0, true);
        for (axis, start) in start.0.iter().enumerate().take(D) {
            fits &= *start >= 0.0 && *start <= f64::from(WINDOW) - K as f64;
            base += start * (1 << (3 * axis)) as f64;
        }
        let arm = (first - local) * grid.spacing();
        let mut stencil = Self {
            // A small whole number, unless it does not fit.
            base: base as u16 as usize,
            values,
            slopes,
            moments: values,
            arm,
            spacing: grid.spacing(),
        };
        for k in 0..K {
            stencil.slopes[k] = slopes[k] * grid.inverse_spacing();
            stencil.moments[k] = values[k] * (arm + k as f64 * grid.spacing());
        }
        fits.then_some(stencil)
    }

    /// Nodes along an axis; the axes that space has not have one.
    #[inline(always)]
    fn nodes(axis: usize) -> usize {
        if axis < D { K } else { 1 }
    }

    /// Value, slope and value times arm of a node along an axis; (1, 0, 0) along one that space has not, (0, 0, 0)
    /// beyond the last node.
    #[inline(always)]
    fn factors(&self, axis: usize, k: usize) -> (f64, f64, f64) {
        if axis >= D {
            return (1.0, 0.0, 0.0);
        }
        if k >= K {
            return (0.0, 0.0, 0.0);
        }
        (
            self.values[k].0[axis],
            self.slopes[k].0[axis],
            self.moments[k].0[axis],
        )
    }

    /// What a node gets besides its share of the value, for its place along one axis.
    #[inline(always)]
    fn extra<L: Lanes, const G: bool, const M: bool>(
        &self,
        lanes: L,
        gift: &Gift<D>,
        axis: usize,
        k: usize,
    ) -> L::Eight {
        let mut sum = lanes.splat(0.0);
        if axis < D {
            let (_, slope, arm) = self.factors(axis, k);
            if G {
                sum = lanes.mul(lanes.load(&gift.gradient[axis]), lanes.splat(slope));
            }
            if M {
                sum = lanes.mul_add(lanes.load(&gift.moment[axis]), lanes.splat(arm), sum);
            }
        }
        sum
    }

    /// Numbers of a field from the stencil's first node to its last pair of nodes.
    const FIELD_SPAN: usize = FIELD
        * (match D {
            1 => 0,
            2 => ROW * (K - 1),
            _ => (ROW + LAYER) * (K - 1),
        } + 2 * K.div_ceil(2));

    /// Sums from the stencil's first node to its last.
    const SUMS_SPAN: usize = match D {
        1 => K,
        2 => ROW * (K - 1) + K,
        _ => (ROW + LAYER) * (K - 1) + K,
    };
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
                let start = self.base + ROW * j;
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
        if D == 3 {
            for k in 0..K {
                for j in 0..K {
                    let start = self.base + LAYER * k + ROW * j;
                    let both = value[j].0[1] * value[k].0[2];
                    for (i, along) in value.iter().enumerate() {
                        f(start + i, along.0[0] * both);
                    }
                }
            }
        } else if D == 2 {
            for j in 0..K {
                let start = self.base + ROW * j;
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
        SVector::from_fn(|axis, _| {
            let k = (window >> (3 * axis) & 7) as f64 - (self.base >> (3 * axis) & 7) as f64;
            self.arm.0[axis] + k * self.spacing
        })
    }

    /// Two nodes along axis 0 are eight numbers in a row: they are summed along axis 2, then 1, then 0, so that each of
    /// the sums with slopes and arms starts from one of few partial ones.
    #[inline(always)]
    fn gather<L: Lanes, const G: bool, const M: bool>(
        &self,
        lanes: L,
        field: &[f64],
    ) -> Gathered<D> {
        let zero = lanes.splat(0.0);
        let (mut value, mut gradient, mut moment) = (zero, [zero; D], [zero; D]);
        let start = FIELD * self.base;
        let field = &field[start..start + Self::FIELD_SPAN];
        for pair in 0..K.div_ceil(2) {
            let (mut sum, mut gradients, mut moments) = (zero, [zero; 3], [zero; 3]);
            for j in 0..Self::nodes(1) {
                let (mut line, mut line_gradient, mut line_moment) = (zero, zero, zero);
                for k in 0..Self::nodes(2) {
                    let node = LAYER * k + ROW * j + 2 * pair;
                    let v = load(lanes, field, FIELD * node);
                    let (w, slope, arm) = self.factors(2, k);
                    if D < 3 {
                        line = v;
                        continue;
                    }
                    line = lanes.mul_add(v, lanes.splat(w), line);
                    if G {
                        line_gradient = lanes.mul_add(v, lanes.splat(slope), line_gradient);
                    }
                    if M {
                        line_moment = lanes.mul_add(v, lanes.splat(arm), line_moment);
                    }
                }
                let (w, slope, arm) = self.factors(1, j);
                if D < 2 {
                    sum = line;
                    continue;
                }
                let w = lanes.splat(w);
                sum = lanes.mul_add(line, w, sum);
                if G {
                    gradients[1] = lanes.mul_add(line, lanes.splat(slope), gradients[1]);
                    gradients[2] = lanes.mul_add(line_gradient, w, gradients[2]);
                }
                if M {
                    moments[1] = lanes.mul_add(line, lanes.splat(arm), moments[1]);
                    moments[2] = lanes.mul_add(line_moment, w, moments[2]);
                }
            }
            let (low, high) = (self.factors(0, 2 * pair), self.factors(0, 2 * pair + 1));
            let w = lanes.pair(low.0, high.0);
            value = lanes.mul_add(sum, w, value);
            if G {
                gradient[0] = lanes.mul_add(sum, lanes.pair(low.1, high.1), gradient[0]);
            }
            if M {
                moment[0] = lanes.mul_add(sum, lanes.pair(low.2, high.2), moment[0]);
            }
            for axis in 1..D {
                if G {
                    gradient[axis] = lanes.mul_add(gradients[axis], w, gradient[axis]);
                }
                if M {
                    moment[axis] = lanes.mul_add(moments[axis], w, moment[axis]);
                }
            }
        }
        // Loops, not closures: those would not be compiled for the vector unit.
        let mut gathered = Gathered {
            value: lanes.fold(value),
            ..Gathered::default()
        };
        for axis in 0..D {
            if G {
                gathered.gradient[axis] = lanes.fold(gradient[axis]);
            }
            if M {
                gathered.moment[axis] = lanes.fold(moment[axis]);
            }
        }
        gathered
    }

    /// What depends on the place along axis 2 alone is made once; a node then costs two multiply-adds.
    #[inline(always)]
    fn scatter<L: Lanes, const G: bool, const M: bool>(
        &self,
        lanes: L,
        gift: &Gift<D>,
        sums: &mut [[f64; SUMS]],
    ) {
        let value = lanes.load(&gift.value);
        let zero = lanes.splat(0.0);
        let (mut extra_1, mut extra_2) = ([zero; K], [zero; K]);
        if G || M {
            for k in 0..K {
                extra_1[k] = self.extra::<L, G, M>(lanes, gift, 1, k);
                extra_2[k] = self.extra::<L, G, M>(lanes, gift, 2, k);
            }
        }
        let sums = &mut sums[self.base..self.base + Self::SUMS_SPAN];
        for i in 0..K {
            let w0 = self.factors(0, i).0;
            let along_0 = {
                let extra = self.extra::<L, G, M>(lanes, gift, 0, i);
                lanes.mul_add(value, lanes.splat(w0), extra)
            };
            for j in 0..Self::nodes(1) {
                let w1 = self.factors(1, j).0;
                let mut along_1 = lanes.mul(along_0, lanes.splat(w1));
                if G || M {
                    along_1 = lanes.mul_add(extra_1[j], lanes.splat(w0), along_1);
                }
                let both = lanes.splat(w0 * w1);
                for k in 0..Self::nodes(2) {
                    let node = &mut sums[LAYER * k + ROW * j + i];
                    let w2 = self.factors(2, k).0;
                    let mut sum = lanes.load(node);
                    sum = lanes.mul_add(along_1, lanes.splat(w2), sum);
                    if D == 3 && (G || M) {
                        sum = lanes.mul_add(extra_2[k], both, sum);
                    }
                    lanes.store(sum, node);
                }
            }
        }
    }
}

#[inline(always)]
fn load<L: Lanes>(lanes: L, field: &[f64], at: usize) -> L::Eight {
    match field[at..].first_chunk() {
        Some(eight) => lanes.load(eight),
        None => lanes.splat(0.0),
    }
}
