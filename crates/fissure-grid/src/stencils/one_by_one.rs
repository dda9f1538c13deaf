//! Eight stencils made one by one, for shapes that are no products.

use nalgebra::SVector;

use super::{By, Stencils};
use crate::simd::{EIGHT, Lanes};
use crate::stencil::{FIELD, Gathered, Gift, SUMS};
use crate::{Stencil, sums_entry};

/// Stencils that were made one by one.
#[derive(Clone, Copy, Debug)]
pub struct OneByOne<S>(pub [Option<S>; EIGHT]);

impl<S: Stencil<D>, const D: usize> Stencils<D> for OneByOne<S> {
    #[inline(always)]
    fn fitting(&self) -> u8 {
        let mut bits = 0;
        for (place, stencil) in self.0.iter().enumerate() {
            bits |= u8::from(stencil.is_some()) << place;
        }
        bits
    }

    const SMOOTH: bool = false;

    #[inline(always)]
    fn gather<L: Lanes, const G: bool, const M: bool>(
        &self,
        lanes: L,
        field: &[f64],
    ) -> Gathered<L::Eight, D> {
        let mut sums = Gathered::<[f64; EIGHT], D>::of([0.0; EIGHT]);
        for (place, stencil) in self.0.iter().enumerate() {
            let Some(stencil) = stencil else { continue };
            stencil.visit(|window, weight, gradient| {
                let arm = if M {
                    stencil.arm(window)
                } else {
                    SVector::zeros()
                };
                for c in 0..FIELD {
                    let v = field[FIELD * window + c];
                    sums.value[c][place] += v * weight;
                    for a in 0..D {
                        sums.gradient[a][c][place] += if G { v * gradient[a] } else { 0.0 };
                        sums.moment[a][c][place] += if M { v * (weight * arm[a]) } else { 0.0 };
                    }
                }
            });
        }
        let mut gathered = Gathered::of(lanes.splat(0.0));
        for c in 0..FIELD {
            gathered.value[c] = lanes.load(&sums.value[c]);
            for a in 0..D {
                gathered.gradient[a][c] = lanes.load(&sums.gradient[a][c]);
                gathered.moment[a][c] = lanes.load(&sums.moment[a][c]);
            }
        }
        gathered
    }

    #[inline(always)]
    fn scatter<L: Lanes, B: By>(
        &self,
        _lanes: L,
        gifts: &[Gift<D>; EIGHT],
        count: usize,
        sums: &mut [[f64; SUMS]],
    ) {
        for (stencil, gift) in self.0.iter().zip(gifts).take(count) {
            let Some(stencil) = stencil else { continue };
            stencil.visit(|window, weight, gradient| {
                let arm = if B::NOTHING {
                    SVector::zeros()
                } else {
                    stencil.arm(window)
                };
                for (c, sum) in sums[sums_entry::<D>(window)].iter_mut().enumerate() {
                    *sum += gift.value[c] * weight;
                    for a in 0..if B::NOTHING { 0 } else { D } {
                        let factor = if B::ARMS || c < FIELD {
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
}
