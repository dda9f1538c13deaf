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
    /// The window index is that of an entry of the [`Window`](crate::Window) that the stencil was made for. A node may be visited more than once (CPDI) or with zero weight. The order of visits
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

/// What eight particles take from a nodal field, [`FIELD`] numbers each, the numbers of the particles side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gathered<Eight, const D: usize> {
    /// `Σ N v`.
    pub value: [Eight; FIELD],
    /// `Σ v ∂N/∂x_a` for each axis a, per m.
    pub gradient: [[Eight; FIELD]; D],
    /// `Σ N (x_i − x)_a v` for each axis a, m.
    pub moment: [[Eight; FIELD]; D],
}

impl<Eight: Copy, const D: usize> Gathered<Eight, D> {
    /// This in every place.
    #[inline(always)]
    pub(crate) fn of(number: Eight) -> Self {
        Self {
            value: [number; FIELD],
            gradient: [[number; FIELD]; D],
            moment: [[number; FIELD]; D],
        }
    }
}

impl<Eight: Copy, const D: usize> Gathered<Eight, D> {
    /// Adds what stands at a place along an axis, with its value, slope and value times arm.
    #[inline(always)]
    pub(crate) fn add<L: Lanes<Eight = Eight>, const G: bool, const M: bool>(
        &mut self,
        lanes: L,
        v: &[Eight; FIELD],
        [value, slope, arm]: [Eight; 3],
        axis: usize,
    ) {
        for (c, v) in v.iter().enumerate() {
            self.value[c] = lanes.mul_add(*v, value, self.value[c]);
            if G {
                let sum = &mut self.gradient[axis][c];
                *sum = lanes.mul_add(*v, slope, *sum);
            }
            if M {
                let sum = &mut self.moment[axis][c];
                *sum = lanes.mul_add(*v, arm, *sum);
            }
        }
    }

    /// The same of sums along the axes before.
    #[inline(always)]
    pub(crate) fn add_partial<L: Lanes<Eight = Eight>, const G: bool, const M: bool>(
        &mut self,
        lanes: L,
        part: &Self,
        factors: [Eight; 3],
        axis: usize,
    ) {
        self.add::<L, G, M>(lanes, &part.value, factors, axis);
        for before in 0..axis {
            for c in 0..FIELD {
                if G {
                    let sum = &mut self.gradient[before][c];
                    *sum = lanes.mul_add(part.gradient[before][c], factors[0], *sum);
                }
                if M {
                    let sum = &mut self.moment[before][c];
                    *sum = lanes.mul_add(part.moment[before][c], factors[0], *sum);
                }
            }
        }
    }
}

/// What a particle gives to the nodal sums.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Gift<const D: usize> {
    /// Multiplied by N.
    pub value: [f64; SUMS],
    /// For each axis a what is multiplied by N (x_i − x)_a or ∂N/∂x_a, as [`By`](crate::By) says.
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
