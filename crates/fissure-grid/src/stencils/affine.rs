//! Giving numbers that are affine in the place: `N (value + sloped · arm)`.
//!
//! From node to node along an axis the factor of N changes by the same numbers, so that a node costs an addition and a
//! multiply-add.

use super::separable::{SeparableStencils, add, rolled};
use crate::simd::{EIGHT, Lanes};
use crate::stencil::{Gift, SUMS};
use crate::sums_entry;

/// What eight stencils that are products need for it.
pub(super) struct AffineStencils<const D: usize, const K: usize> {
    /// Products of the values along axes 0 and 1: `[j][i]`; where space has one axis only its values, for all j.
    values: [[[f64; EIGHT]; K]; K],
    /// Values along axis 2.
    last: [[f64; EIGHT]; K],
    /// From the particle to its first node along each axis, m.
    arms: [[f64; EIGHT]; D],
    base: [u64; EIGHT],
    /// Cell width, m.
    spacing: f64,
}

impl<const D: usize, const K: usize> AffineStencils<D, K> {
    #[inline(always)]
    pub(super) fn of<L: Lanes>(lanes: L, stencils: &SeparableStencils<D, K>) -> Self {
        let along = &stencils.along;
        let mut values = [[[0.0; EIGHT]; K]; K];
        for (j, row) in values.iter_mut().enumerate() {
            for (i, to) in row.iter_mut().enumerate() {
                let mut product = lanes.load(&along[0].values[i]);
                if D > 1 {
                    product = lanes.mul(product, lanes.load(&along[1 % D].values[j]));
                }
                lanes.store(product, to);
            }
        }
        let mut arms = [[0.0; EIGHT]; D];
        for (arm, along) in arms.iter_mut().zip(along) {
            *arm = along.arm;
        }
        Self {
            values,
            last: along[D - 1].values,
            arms,
            base: stencils.base,
            spacing: stencils.spacing,
        }
    }

    #[inline(always)]
    pub(super) fn scatter_one<L: Lanes>(
        &self,
        lanes: L,
        place: usize,
        gift: &Gift<D>,
        sums: &mut [[f64; SUMS]],
    ) {
        let mut line = lanes.load(&gift.value);
        let mut steps = [line; D];
        let spacing = lanes.splat(self.spacing);
        for (axis, step) in steps.iter_mut().enumerate() {
            let sloped = lanes.load(&gift.sloped[axis]);
            line = lanes.mul_add(sloped, lanes.splat(self.arms[axis][place]), line);
            *step = lanes.mul(sloped, spacing);
        }
        let first = SeparableStencils::<D, K>::first_node(self.base[place]);
        let sums = &mut sums[sums_entry::<D>(first)..][..SeparableStencils::<D, K>::SUMS_SPAN];
        for j in 0..rolled::<D>(SeparableStencils::<D, K>::nodes(1)) {
            let mut here = line;
            for i in 0..K {
                let node = SeparableStencils::<D, K>::ROW * j + i;
                let value = self.values[j][i][place];
                if D < 3 {
                    let sum = lanes.load(&sums[node]);
                    add(lanes, here, value, sum, &mut sums[node]);
                } else {
                    let mut part = lanes.mul(here, lanes.splat(value));
                    let step = lanes.mul(steps[2 % D], lanes.splat(value));
                    for k in 0..K {
                        let node = sums_entry::<D>(SeparableStencils::<D, K>::LAYER) * k + node;
                        let sum = lanes.load(&sums[node]);
                        add(lanes, part, self.last[k][place], sum, &mut sums[node]);
                        part = lanes.add(part, step);
                    }
                }
                here = lanes.add(here, steps[0]);
            }
            if D > 1 {
                line = lanes.add(line, steps[1 % D]);
            }
        }
    }
}
