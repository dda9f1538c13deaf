//! Stencils of eight particles of a tile: what transfers between particles and nodes go through.

use std::hint::black_box;

use nalgebra::SVector;

use crate::axes::Numbers;
use crate::separable::Profile;
use crate::simd::{EIGHT, Lanes};
use crate::stencil::{FIELD, Gathered, Gift, SUMS};
use crate::{Grid, Stencil, TILE, WINDOW, WINDOW_START, sums_entry};

/// Window stride of axis 1.
const ROW: usize = WINDOW as usize;
/// Most pairs of nodes along axis 0.
const PAIRS: usize = 2;
/// Window stride of axis 2.
const LAYER: usize = (WINDOW * WINDOW) as usize;

/// How much each of eight particles, by its place, gives to and takes from the nodes of a window.
pub trait Stencils<const D: usize> {
    /// Whether the particle is on the grid, its nodes in the window, and the shape can use its domain. What the others
    /// give and take has no meaning.
    fn fits(&self, place: usize) -> bool;

    /// Sums of a field over the nodes: `Σ N v`, with `G` the `Σ v ∂_a N`, with `M` the `Σ N (x_i − x)_a v`.
    ///
    /// `field` holds [`FIELD`] numbers for each entry of the window and one entry more, whose numbers are not used but
    /// finite.
    fn gather<L: Lanes, const G: bool, const M: bool>(
        &self,
        lanes: L,
        place: usize,
        field: &[f64],
    ) -> Gathered<L::Four, D>;

    /// Adds to the sums of every node: `N value`, and with `E` what goes by gradient and weighted arm, as [`Gift`] says.
    /// `sums` holds an element for each entry of the window, at its [`sums_entry`](crate::sums_entry).
    fn scatter<L: Lanes, const E: bool>(
        &self,
        lanes: L,
        place: usize,
        gift: &Gift<D>,
        sums: &mut [[f64; SUMS]],
    );
}

/// Stencils that were made one by one.
#[derive(Clone, Copy, Debug)]
pub struct OneByOne<S>(pub [Option<S>; EIGHT]);

impl<S: Stencil<D>, const D: usize> Stencils<D> for OneByOne<S> {
    #[inline(always)]
    fn fits(&self, place: usize) -> bool {
        self.0[place].is_some()
    }

    #[inline(always)]
    fn gather<L: Lanes, const G: bool, const M: bool>(
        &self,
        lanes: L,
        place: usize,
        field: &[f64],
    ) -> Gathered<L::Four, D> {
        let zero = [0.0; FIELD];
        let (mut value, mut gradients, mut moments) = (zero, [zero; D], [zero; D]);
        if let Some(stencil) = &self.0[place] {
            stencil.visit(|window, weight, gradient| {
                let arm = if M {
                    stencil.arm(window)
                } else {
                    SVector::zeros()
                };
                for c in 0..FIELD {
                    let v = field[FIELD * window + c];
                    value[c] += v * weight;
                    for a in 0..D {
                        gradients[a][c] += if G { v * gradient[a] } else { 0.0 };
                        moments[a][c] += if M { v * (weight * arm[a]) } else { 0.0 };
                    }
                }
            });
        }
        let mut gathered = Gathered::of(lanes.load4(value));
        for a in 0..D {
            gathered.gradient[a] = lanes.load4(gradients[a]);
            gathered.moment[a] = lanes.load4(moments[a]);
        }
        gathered
    }

    #[inline(always)]
    fn scatter<L: Lanes, const E: bool>(
        &self,
        _lanes: L,
        place: usize,
        gift: &Gift<D>,
        sums: &mut [[f64; SUMS]],
    ) {
        let Some(stencil) = &self.0[place] else {
            return;
        };
        stencil.visit(|window, weight, gradient| {
            let arm = if E {
                stencil.arm(window)
            } else {
                SVector::zeros()
            };
            for (c, sum) in sums[sums_entry(window)].iter_mut().enumerate() {
                *sum += gift.value[c] * weight;
                for a in 0..if E { D } else { 0 } {
                    let factor = if c < FIELD {
                        weight * arm[a]
                    } else {
                        gradient[a]
                    };
                    *sum += gift.sloped[a][c] * factor;
                }
            }
        });
    }
}

/// Stencils that are products of one weight per axis, K nodes along each of D axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeparableStencils<const D: usize, const K: usize> {
    along: [Along<K>; D],
    /// Window index of the lowest node.
    base: [f64; EIGHT],
    /// 1 for those that fit, else 0.
    fits: [f64; EIGHT],
}

/// The weights of K nodes along an axis, each for eight particles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
struct Along<const K: usize> {
    values: [[f64; EIGHT]; K],
    /// Derivatives of the values, 1/m.
    slopes: [[f64; EIGHT]; K],
    /// Values times arms, m.
    moments: [[f64; EIGHT]; K],
}

impl<const K: usize> Along<K> {
    const NOTHING: Self = Self {
        values: [[0.0; EIGHT]; K],
        slopes: [[0.0; EIGHT]; K],
        moments: [[0.0; EIGHT]; K],
    };

    /// Sets the weights along an axis and adds to `base` and `fits`.
    #[inline(always)]
    fn set<const D: usize>(
        &mut self,
        grid: &Grid<D>,
        axis: usize,
        tile: i32,
        x: &[SVector<f64, D>; EIGHT],
        profile: &impl Profile<K>,
        base: &mut Numbers<EIGHT>,
        fits: &mut Numbers<EIGHT>,
    ) {
        let mut position = Numbers::splat(0.0);
        for place in 0..EIGHT {
            position.0[place] = x[place][axis];
        }
        let (cell, local) = grid.along(axis, position);
        let (first, values, slopes) = profile.line(local);
        let window = f64::from(TILE) * f64::from(tile) + f64::from(WINDOW_START);
        let start = cell + first + -window;
        *fits = *fits
            * start.within(0.0, f64::from(WINDOW) - K as f64)
            * position.within(grid.origin()[axis], grid.max()[axis]);
        *base = *base + start * (1 << (3 * axis)) as f64;
        let arm = (first - local) * grid.spacing();
        for k in 0..K {
            self.values[k] = values[k].0;
            self.slopes[k] = (slopes[k] * grid.inverse_spacing()).0;
            self.moments[k] = (values[k] * (arm + k as f64 * grid.spacing())).0;
        }
    }
}

impl<const D: usize, const K: usize> SeparableStencils<D, K> {
    /// Builds from the weights along an axis, given the particles' coordinates [0, 1] in their cells.
    #[inline(always)]
    pub(crate) fn new(
        grid: &Grid<D>,
        tile: [i32; D],
        x: &[SVector<f64, D>; EIGHT],
        profile: &impl Profile<K>,
    ) -> Self {
        let mut along = [Along::NOTHING; D];
        let (mut base, mut fits) = (Numbers::splat(0.0), Numbers::splat(1.0));
        let (b, f) = (&mut base, &mut fits);
        // Written out, so that no axis is a number at run time.
        along[0].set(grid, 0, tile[0], x, profile, b, f);
        if D > 1 {
            along[1 % D].set(grid, 1, tile[1 % D], x, profile, b, f);
        }
        if D > 2 {
            along[2 % D].set(grid, 2, tile[2 % D], x, profile, b, f);
        }
        Self {
            along,
            base: base.0,
            fits: fits.0,
        }
    }

    /// Nothing that fits.
    pub(crate) fn none() -> Self {
        Self {
            along: [Along::NOTHING; D],
            base: [0.0; EIGHT],
            fits: [0.0; EIGHT],
        }
    }

    /// Window index of the lowest node: a small whole number, unless the particle does not fit.
    #[inline(always)]
    fn base(&self, place: usize) -> usize {
        self.base[place] as u16 as usize
    }

    /// Nodes along an axis; the axes that space has not have one.
    #[inline(always)]
    fn nodes(axis: usize) -> usize {
        if axis < D { K } else { 1 }
    }

    /// Value, slope and value times arm of a node along an axis; zeros beyond the last node, and along an axis that space
    /// has not.
    #[inline(always)]
    fn factors(&self, place: usize, axis: usize, k: usize) -> (f64, f64, f64) {
        if k >= K || axis >= D {
            return (0.0, 0.0, 0.0);
        }
        (
            self.along[axis].values[k][place],
            self.along[axis].slopes[k][place],
            self.along[axis].moments[k][place],
        )
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
        _ => (ROW + sums_entry(LAYER)) * (K - 1) + K,
    };
}

impl<const D: usize, const K: usize> Stencils<D> for SeparableStencils<D, K> {
    #[inline(always)]
    fn fits(&self, place: usize) -> bool {
        self.fits[place] == 1.0
    }

    /// Two nodes along axis 0 are eight numbers in a row: they are summed along axis 2, then 1, then 0, so that each of
    /// the sums with slopes and arms starts from one of few partial ones.
    #[inline(always)]
    fn gather<L: Lanes, const G: bool, const M: bool>(
        &self,
        lanes: L,
        place: usize,
        field: &[f64],
    ) -> Gathered<L::Four, D> {
        let zero = lanes.splat(0.0);
        let start = FIELD * self.base(place);
        let field = &field[start..start + Self::FIELD_SPAN];
        // Of each pair of nodes along axis 0, summed along the others.
        let mut sum = [zero; PAIRS];
        let (mut gradients, mut moments) = ([[zero; 3]; PAIRS], [[zero; 3]; PAIRS]);
        for j in 0..rolled::<D>(Self::nodes(1)) {
            let (w, slope, arm) = self.factors(place, 1, j);
            let (w, slope, arm) = (lanes.splat(w), lanes.splat(slope), lanes.splat(arm));
            for pair in 0..K.div_ceil(2) {
                let (mut line, mut line_gradient, mut line_moment) = (zero, zero, zero);
                for k in 0..Self::nodes(2) {
                    let node = LAYER * k + ROW * j + 2 * pair;
                    let v = load(lanes, field, FIELD * node);
                    if D < 3 {
                        line = v;
                        continue;
                    }
                    let (w, slope, arm) = self.factors(place, 2, k);
                    line = lanes.mul_add(v, lanes.splat(w), line);
                    if G {
                        line_gradient = lanes.mul_add(v, lanes.splat(slope), line_gradient);
                    }
                    if M {
                        line_moment = lanes.mul_add(v, lanes.splat(arm), line_moment);
                    }
                }
                if D < 2 {
                    sum[pair] = line;
                    continue;
                }
                sum[pair] = lanes.mul_add(line, w, sum[pair]);
                if G {
                    let sums = &mut gradients[pair];
                    sums[1] = lanes.mul_add(line, slope, sums[1]);
                    sums[2] = lanes.mul_add(line_gradient, w, sums[2]);
                }
                if M {
                    let sums = &mut moments[pair];
                    sums[1] = lanes.mul_add(line, arm, sums[1]);
                    sums[2] = lanes.mul_add(line_moment, w, sums[2]);
                }
            }
        }
        let (mut value, mut gradient, mut moment) = (zero, [zero; D], [zero; D]);
        for pair in 0..K.div_ceil(2) {
            let low = self.factors(place, 0, 2 * pair);
            let high = self.factors(place, 0, 2 * pair + 1);
            let w = lanes.pair(low.0, high.0);
            value = lanes.mul_add(sum[pair], w, value);
            if G {
                gradient[0] = lanes.mul_add(sum[pair], lanes.pair(low.1, high.1), gradient[0]);
            }
            if M {
                moment[0] = lanes.mul_add(sum[pair], lanes.pair(low.2, high.2), moment[0]);
            }
            for axis in 1..D {
                if G {
                    gradient[axis] = lanes.mul_add(gradients[pair][axis], w, gradient[axis]);
                }
                if M {
                    moment[axis] = lanes.mul_add(moments[pair][axis], w, moment[axis]);
                }
            }
        }
        // Loops, not closures: those would not be compiled for the vector unit.
        let mut gathered = Gathered::of(lanes.fold(value));
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

    /// What goes by slope and arm along an axis is made once for each of its nodes; a node then costs two multiply-adds.
    #[inline(always)]
    fn scatter<L: Lanes, const E: bool>(
        &self,
        lanes: L,
        place: usize,
        gift: &Gift<D>,
        sums: &mut [[f64; SUMS]],
    ) {
        let value = lanes.load(&gift.value);
        let zero = lanes.splat(0.0);
        let mut extra = [[zero; K]; 3];
        if E {
            for axis in 1..D {
                let sloped = lanes.load(&gift.sloped[axis]);
                for (k, extra) in extra[axis].iter_mut().enumerate() {
                    let (_, slope, arm) = self.factors(place, axis, k);
                    *extra = lanes.mul(sloped, lanes.pair(arm, slope));
                }
            }
        }
        let sloped = lanes.load(&gift.sloped[0]);
        let base = sums_entry(self.base(place));
        let sums = &mut sums[base..base + Self::SUMS_SPAN];
        for i in 0..rolled::<D>(K) {
            let (w0, slope, arm) = self.factors(place, 0, i);
            let mut along_0 = lanes.mul(value, lanes.splat(w0));
            if E {
                along_0 = lanes.mul_add(sloped, lanes.pair(arm, slope), along_0);
            }
            for j in 0..Self::nodes(1) {
                let node = ROW * j + i;
                if D == 1 {
                    let sum = lanes.load(&sums[node]);
                    add(lanes, along_0, 1.0, sum, &mut sums[node]);
                    continue;
                }
                let w1 = self.along[1 % D].values[j][place];
                if D == 2 {
                    let mut sum = lanes.load(&sums[node]);
                    if E {
                        sum = lanes.mul_add(extra[1][j], lanes.splat(w0), sum);
                    }
                    add(lanes, along_0, w1, sum, &mut sums[node]);
                    continue;
                }
                let mut along_1 = lanes.mul(along_0, lanes.splat(w1));
                if E {
                    along_1 = lanes.mul_add(extra[1][j], lanes.splat(w0), along_1);
                }
                let both = lanes.splat(w0 * w1);
                for (k, extra) in extra[2].iter().enumerate() {
                    let node = sums_entry(LAYER) * k + node;
                    let mut sum = lanes.load(&sums[node]);
                    if E {
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

/// The end of a loop that in space is to stay one: with all of its turns written out there would be more numbers at
/// hand than registers.
#[inline(always)]
fn rolled<const D: usize>(end: usize) -> usize {
    if D == 3 { black_box(end) } else { end }
}

/// Stores `x weight + sum`.
#[inline(always)]
fn add<L: Lanes>(lanes: L, x: L::Eight, weight: f64, sum: L::Eight, to: &mut [f64; SUMS]) {
    lanes.store(lanes.mul_add(x, lanes.splat(weight), sum), to);
}

#[inline(always)]
fn load<L: Lanes>(lanes: L, field: &[f64], at: usize) -> L::Eight {
    match field[at..].first_chunk() {
        Some(eight) => lanes.load(eight),
        None => lanes.splat(0.0),
    }
}
