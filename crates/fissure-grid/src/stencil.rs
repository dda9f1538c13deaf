//! What a particle gives to and takes from the nodes.

use nalgebra::SVector;

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
}
