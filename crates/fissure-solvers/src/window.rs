//! The nodes that a tile's particles reach, as dense arrays on the stack of one thread.

use fissure_grid::{FIELD, SUMS, Tiles, WINDOW, sums_entry, window_entries, window_map};

use crate::nodes::NodeSums;

/// Where the nodes of a window are.
pub(crate) struct WindowNodes<'a, const D: usize> {
    /// First node of each of the tiles around.
    bases: [usize; 27],
    map: &'static [(u8, u8)],
    /// The node of every entry, where some are split or they do not stand in rows.
    listed: Option<&'a [u32]>,
}

impl<'a, const D: usize> WindowNodes<'a, D> {
    /// The plain window of a tile.
    pub(crate) fn of_tile(tiles: &Tiles<D>, tile: usize) -> Self {
        let mut bases = [0; 27];
        for (base, &around) in bases.iter_mut().zip(tiles.around(tile)) {
            *base = around as usize * Tiles::<D>::NODES;
        }
        Self {
            bases,
            map: window_map::<D>(),
            listed: None,
        }
    }

    /// The window of these nodes.
    pub(crate) fn listed(nodes: &'a [u32]) -> Self {
        Self {
            bases: [0; 27],
            map: window_map::<D>(),
            listed: Some(nodes),
        }
    }

    /// Node of a window entry.
    #[inline]
    pub(crate) fn node(&self, entry: usize) -> usize {
        if let Some(nodes) = self.listed {
            return nodes[entry] as usize;
        }
        let (neighbour, local) = self.map[entry];
        self.bases[neighbour as usize] + local as usize
    }

    /// Calls `row(entry, node, count)` for each stretch of entries whose nodes stand side by side.
    #[inline(always)]
    fn rows(&self, mut row: impl FnMut(usize, usize, usize)) {
        if let Some(nodes) = self.listed {
            for (entry, &node) in nodes.iter().enumerate() {
                row(entry, node as usize, 1);
            }
            return;
        }
        // Two nodes of the tile below along axis 0, four of the tile itself, two of the one above.
        for start in (0..self.map.len()).step_by(WINDOW as usize) {
            for (offset, count) in [(0, 2), (2, 4), (6, 2)] {
                row(start + offset, self.node(start + offset), count);
            }
        }
    }

    /// Copies a field's numbers; the entry beyond the last is left as it is.
    #[inline]
    pub(crate) fn load(&self, field: &[[f64; FIELD]], window: &mut [[f64; FIELD]]) {
        self.rows(|entry, node, count| {
            window[entry..entry + count].copy_from_slice(&field[node..node + count]);
        });
    }

    /// Adds what was summed in the window to the nodes. Also zeros, where no particle reached: to ask is what a
    /// processor would often guess wrong.
    #[inline]
    pub(crate) fn add(&self, window: &[[f64; SUMS]], sums: &NodeSums<D>) {
        self.rows(|entry, node, count| {
            for i in 0..count {
                sums.add(node + i, &window[sums_entry(entry + i)]);
            }
        });
    }
}

/// Elements of arrays over a window in the plane.
pub(crate) const SQUARE: usize = window_entries(2);
/// The same of its sums.
pub(crate) const SQUARE_SUMS: usize = sums_entry(SQUARE);
/// Elements of arrays over a window in space.
pub(crate) const CUBE: usize = window_entries(3);
/// The same of its sums.
pub(crate) const CUBE_SUMS: usize = sums_entry(CUBE);

/// Sums of a window, aligned so that a node's numbers lie in one cache line.
#[repr(align(64))]
pub(crate) struct WindowSums<const N: usize>(pub [[f64; SUMS]; N]);

impl<const N: usize> WindowSums<N> {
    pub(crate) fn zero() -> Self {
        Self([[0.0; SUMS]; N])
    }
}
