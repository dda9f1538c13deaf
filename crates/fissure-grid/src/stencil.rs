//! What a particle gives to and takes from the nodes.

use nalgebra::SVector;

use crate::simd::Lanes;

/// Numbers per node of a field that particles gather: a vector of up to three components and one more.
pub const FIELD: usize = 4;
/// Numbers per node of the sums that particles scatter to.
pub const SUMS: usize = 8;

/// How much one particle gives to and takes from each node.
pub trait Stencil<const D: usize>: Copy + Send + Sync {
    /// Calls `f(window index, N, ∇N)` for each node reached; N is dimensionless, ∇N in 1/m.
    ///
    /// The window index is `Σ_a k_a 8^a` (axis 0 fastest), `k_a` in 0..8, relative to the tile the stencil was made for,
    /// and always below 8^D. A node may be visited more than once (CPDI) or with zero weight. The order of visits
    /// depends on the shape alone, so sums are reproducible.
    fn visit(&self, f: impl FnMut(usize, f64, SVector<f64, D>));

    /// Calls `f(window index, N)` for each node reached, as [`Stencil::visit`] without gradients.
    #[inline]
    fn visit_values(&self, mut f: impl FnMut(usize, f64)) {
        self.visit(|window, value, _| f(window, value));
    }

    /// From the particle to the node of a window index, m.
    fn arm(&self, window: usize) -> SVector<f64, D>;

    /// Sums of a field over the nodes: `Σ N v`, with `G` the `Σ v ∂_a N`, with `M` the `Σ N (x_i − x)_a v`.
    ///
    /// `field` holds [`FIELD`] numbers for each entry of the window and one entry more, whose numbers are not used but
    /// finite.
    #[inline(always)]
    fn gather<L: Lanes, const G: bool, const M: bool>(
        &self,
        _lanes: L,
        field: &[f64],
    ) -> Gathered<D> {
        let mut sums = Gathered::default();
        self.visit(|window, weight, gradient| {
            let arm = if M {
                self.arm(window)
            } else {
                SVector::zeros()
            };
            for c in 0..FIELD {
                let v = field[FIELD * window + c];
                sums.value[c] += v * weight;
                for a in 0..D {
                    sums.gradient[a][c] += if G { v * gradient[a] } else { 0.0 };
                    sums.moment[a][c] += if M { v * (weight * arm[a]) } else { 0.0 };
                }
            }
        });
        sums
    }

    /// Adds to the sums of every node: `N value`, with `G` also `∂_a N gradient_a`, with `M` also `N (x_i − x)_a
    /// moment_a`. `sums` holds an element for each entry of the window.
    #[inline(always)]
    fn scatter<L: Lanes, const G: bool, const M: bool>(
        &self,
        _lanes: L,
        gift: &Gift<D>,
        sums: &mut [[f64; SUMS]],
    ) {
        self.visit(|window, weight, gradient| {
            let arm = if M {
                self.arm(window)
            } else {
                SVector::zeros()
            };
            for (c, sum) in sums[window].iter_mut().enumerate() {
                *sum += gift.value[c] * weight;
                for a in 0..D {
                    *sum += if G {
                        gift.gradient[a][c] * gradient[a]
                    } else {
                        0.0
                    };
                    *sum += if M {
                        gift.moment[a][c] * (weight * arm[a])
                    } else {
                        0.0
                    };
                }
            }
        });
    }
}

/// What a particle takes from a nodal field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gathered<const D: usize> {
    /// `Σ N v`.
    pub value: [f64; FIELD],
    /// `Σ v ∂N/∂x_a` for each axis a, per m.
    pub gradient: [[f64; FIELD]; D],
    /// `Σ N (x_i − x)_a v` for each axis a, m.
    pub moment: [[f64; FIELD]; D],
}

impl<const D: usize> Default for Gathered<D> {
    #[inline(always)]
    fn default() -> Self {
        Self {
            value: [0.0; FIELD],
            gradient: [[0.0; FIELD]; D],
            moment: [[0.0; FIELD]; D],
        }
    }
}

/// What a particle gives to the nodal sums, to be multiplied by weight, gradient and weighted arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gift<const D: usize> {
    /// Multiplied by N.
    pub value: [f64; SUMS],
    /// Multiplied by ∂N/∂x_a.
    pub gradient: [[f64; SUMS]; D],
    /// Multiplied by N (x_i − x)_a.
    pub moment: [[f64; SUMS]; D],
}

impl<const D: usize> Default for Gift<D> {
    #[inline(always)]
    fn default() -> Self {
        Self {
            value: [0.0; SUMS],
            gradient: [[0.0; SUMS]; D],
            moment: [[0.0; SUMS]; D],
        }
    }
}
