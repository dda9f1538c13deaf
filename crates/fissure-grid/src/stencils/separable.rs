//! Eight stencils that are products of a weight per axis.

use std::hint::black_box;

use super::affine::AffineStencils;
use super::{By, Stencils};
use crate::axes::Numbers;
use crate::separable::Profile;
use crate::simd::{EIGHT, Lanes, chunks};
use crate::stencil::{FIELD, Gathered, Gift, SUMS};
use crate::{Grid, Window, sums_entry};

/// A number whose last bit counts ones: added to a whole number it leaves that in its last bits.
const LAST_BIT_ONE: f64 = 4_503_599_627_370_496.0;

/// Stencils that are products of one weight per axis, K nodes along each of D axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeparableStencils<const D: usize, const K: usize> {
    pub(super) along: [Along<K>; D],
    /// Window index of the lowest node, in the last bits; any if the particle does not fit.
    pub(super) base: [u64; EIGHT],
    /// Cell width, m.
    pub(super) spacing: f64,
    fitting: u8,
}

/// The weights of K nodes along an axis, each for eight particles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(super) struct Along<const K: usize> {
    pub values: [[f64; EIGHT]; K],
    /// From the particle to the first node, m.
    pub arm: [f64; EIGHT],
    /// Derivatives of the values, 1/m.
    slopes: [[f64; EIGHT]; K],
    /// Values times arms, m.
    moments: [[f64; EIGHT]; K],
}

impl<const K: usize> Along<K> {
    const NOTHING: Self = Self {
        values: [[0.0; EIGHT]; K],
        arm: [0.0; EIGHT],
        slopes: [[0.0; EIGHT]; K],
        moments: [[0.0; EIGHT]; K],
    };

    /// Sets the weights along an axis. The place of the lowest node in the window, and a bit for each particle: whether it
    /// is on the grid and its nodes in the window.
    #[inline(always)]
    fn set<L: Lanes, const D: usize>(
        &mut self,
        lanes: L,
        grid: &Grid<D>,
        axis: usize,
        window: &Window<D>,
        x: &[[f64; EIGHT]; D],
        profile: &impl Profile<K>,
    ) -> (Numbers<EIGHT>, u8) {
        let position = Numbers(x[axis]);
        let (cell, local) = grid.along(axis, position);
        let (first, values, slopes) = profile.line(local);
        let start = cell + first + -f64::from(window.first[axis]);
        let arm = (first - local) * grid.spacing();
        self.arm = arm.0;
        for k in 0..K {
            self.values[k] = values[k].0;
            self.slopes[k] = (slopes[k] * grid.inverse_spacing()).0;
            self.moments[k] = (values[k] * (arm + k as f64 * grid.spacing())).0;
        }
        // The position comes last, so that what is no number stays so.
        let to_ends = start.min(-start + (f64::from(window.nodes) - K as f64));
        let above = position + -grid.origin()[axis];
        let below = -position + grid.max()[axis];
        let fitting = lanes.not_negative(lanes.load(&to_ends.min(above).min(below).0));
        (start, fitting)
    }

    /// Value times arm and slope of a node for one of the particles, each as often as a [`Gift`] has numbers that go by it.
    #[inline(always)]
    fn pair<L: Lanes>(&self, lanes: L, k: usize, place: usize) -> L::Eight {
        lanes.pair(self.moments[k][place], self.slopes[k][place])
    }

    /// Value, slope and value times arm of a node, for eight particles.
    #[inline(always)]
    fn at<L: Lanes>(&self, lanes: L, k: usize) -> [L::Eight; 3] {
        [
            lanes.load(&self.values[k]),
            lanes.load(&self.slopes[k]),
            lanes.load(&self.moments[k]),
        ]
    }
}

/// Numbers of a node for eight particles, whose first nodes stand where `around` begins; the last one if `marked`.
#[inline(always)]
fn node_columns<L: Lanes, const D: usize>(
    lanes: L,
    around: &[&[f64]; EIGHT],
    node: usize,
    marked: bool,
) -> [L::Eight; FIELD] {
    let at = FIELD * node;
    if D > 2 || marked {
        return lanes.columns4(chunks(*around, at));
    }
    let [a, b] = lanes.columns2(chunks(*around, at));
    let zero = lanes.splat(0.0);
    [a, b, zero, zero]
}

impl<const D: usize, const K: usize> SeparableStencils<D, K> {
    /// Builds from the weights along an axis, given the particles' coordinates [0, 1] in their cells.
    #[inline(always)]
    pub(crate) fn new<L: Lanes>(
        lanes: L,
        grid: &Grid<D>,
        window: &Window<D>,
        x: &[[f64; EIGHT]; D],
        profile: &impl Profile<K>,
    ) -> Self {
        let mut along = [Along::NOTHING; D];
        // Written out, so that no axis is a number at run time.
        let (mut base, mut fitting) = along[0].set(lanes, grid, 0, window, x, profile);
        if D > 1 {
            let (start, fits) = along[1 % D].set(lanes, grid, 1, window, x, profile);
            base = base + start * Self::ROW as f64;
            fitting &= fits;
        }
        if D > 2 {
            let (start, fits) = along[2 % D].set(lanes, grid, 2, window, x, profile);
            base = base + start * Self::LAYER as f64;
            fitting &= fits;
        }
        let mut stencils = Self {
            along,
            base: [0; EIGHT],
            spacing: grid.spacing(),
            fitting,
        };
        for (to, base) in stencils.base.iter_mut().zip((base + LAST_BIT_ONE).0) {
            *to = base.to_bits();
        }
        stencils
    }

    /// Nothing that fits.
    pub(crate) fn none() -> Self {
        Self {
            along: [Along::NOTHING; D],
            base: [0; EIGHT],
            spacing: 0.0,
            fitting: 0,
        }
    }

    /// Window index of the lowest node, given what [`base`](Self::base) holds; that of some node if the particle does not fit.
    #[inline(always)]
    pub(super) fn first_node(base: u64) -> usize {
        (base as u16 as usize).min(Self::LAST)
    }

    /// Nodes along an axis; the axes that space has not have one.
    #[inline(always)]
    pub(super) fn nodes(axis: usize) -> usize {
        if axis < D { K } else { 1 }
    }

    /// From a node to the next along axis 1.
    pub(super) const ROW: usize = Window::<D>::ROW;
    /// From a node to the next along axis 2.
    pub(super) const LAYER: usize = Self::ROW * Self::ROW;
    /// The last window index.
    const LAST: usize = Window::<D>::ENTRIES - 1;

    /// Nodes from the stencil's first to its last.
    const SPAN: usize = match D {
        1 => K,
        2 => Self::ROW * (K - 1) + K,
        _ => (Self::ROW + Self::LAYER) * (K - 1) + K,
    };

    /// Sums from the stencil's first node to its last.
    pub(super) const SUMS_SPAN: usize = match D {
        1 => K,
        2 => Self::ROW * (K - 1) + K,
        _ => (Self::ROW + sums_entry::<D>(Self::LAYER)) * (K - 1) + K,
    };

    /// What goes by slope and arm along an axis is made once for each of its nodes; a node then costs two multiply-adds.
    #[inline(always)]
    fn scatter_one<L: Lanes, B: By>(
        &self,
        lanes: L,
        place: usize,
        gift: &Gift<D>,
        sums: &mut [[f64; SUMS]],
    ) {
        let has_slopes = !B::NOTHING;
        let value = lanes.load(&gift.value);
        let zero = lanes.splat(0.0);
        let mut extra = [[zero; K]; 3];
        if has_slopes {
            for axis in 1..D {
                let sloped = lanes.load(&gift.sloped[axis]);
                for (k, extra) in extra[axis].iter_mut().enumerate() {
                    *extra = lanes.mul(sloped, self.along[axis].pair(lanes, k, place));
                }
            }
        }
        let sloped = lanes.load(&gift.sloped[0]);
        let sums =
            &mut sums[sums_entry::<D>(Self::first_node(self.base[place]))..][..Self::SUMS_SPAN];
        for i in 0..rolled::<D>(K) {
            let w0 = self.along[0].values[i][place];
            let mut along_0 = lanes.mul(value, lanes.splat(w0));
            if has_slopes {
                let pair = self.along[0].pair(lanes, i, place);
                along_0 = lanes.mul_add(sloped, pair, along_0);
            }
            for j in 0..Self::nodes(1) {
                let node = Self::ROW * j + i;
                if D == 1 {
                    let sum = lanes.load(&sums[node]);
                    add(lanes, along_0, 1.0, sum, &mut sums[node]);
                    continue;
                }
                let w1 = self.along[1 % D].values[j][place];
                if D == 2 {
                    let mut sum = lanes.load(&sums[node]);
                    if has_slopes {
                        sum = lanes.mul_add(extra[1][j], lanes.splat(w0), sum);
                    }
                    add(lanes, along_0, w1, sum, &mut sums[node]);
                    continue;
                }
                let mut along_1 = lanes.mul(along_0, lanes.splat(w1));
                if has_slopes {
                    along_1 = lanes.mul_add(extra[1][j], lanes.splat(w0), along_1);
                }
                let both = lanes.splat(w0 * w1);
                for (k, extra) in extra[2].iter().enumerate() {
                    let node = sums_entry::<D>(Self::LAYER) * k + node;
                    let mut sum = lanes.load(&sums[node]);
                    if has_slopes {
                        sum = lanes.mul_add(*extra, both, sum);
                    }
                    add(
                        lanes,
                        along_1,
                        self.along[2 % D].values[k][place],
                        sum,
                        &mut sums[node],
                    );
                }
            }
        }
    }
}

impl<const D: usize, const K: usize> Stencils<D> for SeparableStencils<D, K> {
    #[inline(always)]
    fn fitting(&self) -> u8 {
        self.fitting
    }

    const SMOOTH: bool = K > 2;

    /// Eight particles at once: a node's numbers are read for each and brought into columns. Sums go along axis 0 first,
    /// then 1, then 2, so that each of those with slopes and arms starts from one of few partial ones.
    #[inline(always)]
    fn gather<L: Lanes, const G: bool, const M: bool>(
        &self,
        lanes: L,
        field: &[f64],
    ) -> Gathered<L::Eight, D> {
        // So long that no particle's nodes have to be checked.
        let field = &field[..FIELD * (Self::LAST + Self::SPAN)];
        let mut around = [&field[..0]; EIGHT];
        for (place, around) in around.iter_mut().enumerate() {
            *around = &field[FIELD * Self::first_node(self.base[place])..][..FIELD * Self::SPAN];
        }
        let nothing = Gathered::<L::Eight, D>::of(lanes.splat(0.0));
        let mut all = nothing;
        for k in 0..rolled::<D>(Self::nodes(2)) {
            let mut layer = nothing;
            for j in 0..Self::nodes(1) {
                let mut line = nothing;
                for i in 0..K {
                    let v = node_columns::<L, D>(
                        lanes,
                        &around,
                        Self::LAYER * k + Self::ROW * j + i,
                        G && !Self::SMOOTH,
                    );
                    let factors = self.along[0].at(lanes, i);
                    line.add::<L, G, M>(lanes, &v, factors, 0);
                }
                if D > 1 {
                    let factors = self.along[1 % D].at(lanes, j);
                    layer.add_partial::<L, G, M>(lanes, &line, factors, 1);
                } else {
                    layer = line;
                }
            }
            if D > 2 {
                let factors = self.along[2 % D].at(lanes, k);
                all.add_partial::<L, G, M>(lanes, &layer, factors, 2);
            } else {
                all = layer;
            }
        }
        all
    }

    /// Particle by particle.
    #[inline(always)]
    fn scatter<L: Lanes, B: By>(
        &self,
        lanes: L,
        gifts: &[Gift<D>; EIGHT],
        count: usize,
        sums: &mut [[f64; SUMS]],
    ) {
        // So long that no particle's nodes have to be checked.
        let sums = &mut sums[..sums_entry::<D>(Self::LAST) + Self::SUMS_SPAN];
        let mut left = self.fitting & (u8::MAX >> (EIGHT - count.clamp(1, EIGHT)));
        if B::ARMS {
            let affine = AffineStencils::of(lanes, self);
            while left != 0 {
                let place = left.trailing_zeros() as usize % EIGHT;
                affine.scatter_one(lanes, place, &gifts[place], sums);
                left &= left - 1;
            }
            return;
        }
        while left != 0 {
            let place = left.trailing_zeros() as usize % EIGHT;
            self.scatter_one::<L, B>(lanes, place, &gifts[place], sums);
            left &= left - 1;
        }
    }
}

/// The end of a loop that in space is to stay one: with all of its turns written out there would be more numbers at
/// hand than registers.
#[inline(always)]
pub(super) fn rolled<const D: usize>(end: usize) -> usize {
    if D == 3 { black_box(end) } else { end }
}

/// Stores `x weight + sum`.
#[inline(always)]
pub(super) fn add<L: Lanes>(
    lanes: L,
    x: L::Eight,
    weight: f64,
    sum: L::Eight,
    to: &mut [f64; SUMS],
) {
    lanes.store(lanes.mul_add(x, lanes.splat(weight), sum), to);
}
