//! The nodes that a tile's particles reach, as dense arrays on the stack of one thread.

use fissure_grid::{FIELD, SUMS, Tiles, window_map};

use crate::nodes::NodeSums;

/// Where the nodes of a tile's window are.
pub(crate) struct WindowNodes<const D: usize> {
    /// First node of each of the tiles around.
    bases: [usize; 27],
    map: &'static [(u8, u8)],
}

impl<const D: usize> WindowNodes<D> {
    pub(crate) fn new(tiles: &Tiles<D>, tile: usize) -> Self {
        let mut bases = [0; 27];
        for (base, &around) in bases.iter_mut().zip(tiles.around(tile)) {
            *base = around as usize * Tiles::<D>::NODES;
        }
        Self {
            bases,
            map: window_map::<D>(),
        }
    }

    /// Node of a window entry.
    #[inline]
    pub(crate) fn node(&self, entry: usize) -> usize {
        let (neighbour, local) = self.map[entry];
        self.bases[neighbour as usize] + local as usize
    }

    /// Copies a field's numbers; the entry beyond the last is left as it is.
    #[inline]
    pub(crate) fn load(&self, field: &[[f64; FIELD]], window: &mut [[f64; FIELD]]) {
        for (to, &(neighbour, local)) in window.iter_mut().zip(self.map) {
            *to = field[self.bases[neighbour as usize] + local as usize];
        }
    }

    /// Adds what was summed in the window to the nodes; those that no particle reached are left
    /// out.
    #[inline]
    pub(crate) fn add(&self, window: &[[f64; SUMS]], sums: &NodeSums<D>) {
        for (numbers, &(neighbour, local)) in window.iter().zip(self.map) {
            if numbers.iter().any(|number| *number != 0.0) {
                sums.add(self.bases[neighbour as usize] + local as usize, numbers);
            }
        }
    }
}

/// Sums of a window, aligned so that a node's numbers lie in one cache line.
#[repr(align(64))]
pub(crate) struct WindowSums<const N: usize>(pub [[f64; SUMS]; N]);

impl<const N: usize> WindowSums<N> {
    pub(crate) fn zero() -> Self {
        Self([[0.0; SUMS]; N])
    }
}
