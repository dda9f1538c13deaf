//! What a particle gives to and takes from the nodes.

use nalgebra::SVector;

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
}

/// What a particle takes from a nodal field, four numbers each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gathered<Four, const D: usize> {
    /// `Σ N v`.
    pub value: Four,
    /// `Σ v ∂N/∂x_a` for each axis a, per m.
    pub gradient: [Four; D],
    /// `Σ N (x_i − x)_a v` for each axis a, m.
    pub moment: [Four; D],
}

impl<Four: Copy, const D: usize> Gathered<Four, D> {
    /// This value, and as gradients and moments as well.
    #[inline(always)]
    pub(crate) fn of(value: Four) -> Self {
        Self {
            value,
            gradient: [value; D],
            moment: [value; D],
        }
    }
}

/// What a particle gives to the nodal sums.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gift<const D: usize> {
    /// Multiplied by N.
    pub value: [f64; SUMS],
    /// For each axis a the first [`FIELD`] multiplied by N (x_i − x)_a, the rest by ∂N/∂x_a.
    pub sloped: [[f64; SUMS]; D],
}

impl<const D: usize> Default for Gift<D> {
    #[inline(always)]
    fn default() -> Self {
        Self {
            value: [0.0; SUMS],
            sloped: [[0.0; SUMS]; D],
        }
    }
}
