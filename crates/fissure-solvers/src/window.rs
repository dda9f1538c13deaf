//! The nodes that a tile's particles reach, as dense arrays on the stack of one thread.

use fissure_grid::{FIELD, SUMS, Tiles, WINDOW_START, Window, sums_entry};

use crate::nodes::NodeSums;
use crate::splits::NONE;

/// Where the nodes of a window are.
pub(crate) struct WindowNodes<'a, const D: usize> {
    /// First node of each of the tiles around.
    bases: [usize; 27],
    tiles: &'a Tiles<D>,
    /// The node of every entry, where some are split or they do not stand in rows; [`NONE`] for a number that is no entry.
    listed: Option<&'a [u32]>,
}

impl<'a, const D: usize> WindowNodes<'a, D> {
    /// The plain window of a tile.
    pub(crate) fn of_tile(tiles: &'a Tiles<D>, tile: usize) -> Self {
        let mut bases = [0; 27];
        for (base, &around) in bases.iter_mut().zip(tiles.around(tile)) {
            *base = around as usize * tiles.nodes_each();
        }
        Self {
            bases,
            tiles,
            listed: None,
        }
    }

    /// The window of these nodes.
    pub(crate) fn listed(tiles: &'a Tiles<D>, nodes: &'a [u32]) -> Self {
        Self {
            bases: [0; 27],
            tiles,
            listed: Some(nodes),
        }
    }

    /// Node of a window entry.
    #[inline]
    pub(crate) fn node(&self, entry: usize) -> usize {
        if let Some(nodes) = self.listed {
            return nodes[entry] as usize;
        }
        let (neighbour, local) = self.tiles.map()[entry];
        self.bases[neighbour as usize] + local as usize
    }

    /// Calls `row(entry, node, count)` for each stretch of entries whose nodes stand side by side.
    #[inline(always)]
    fn rows(&self, mut row: impl FnMut(usize, usize, usize)) {
        if let Some(nodes) = self.listed {
            for (entry, &node) in nodes.iter().enumerate() {
                if node != NONE {
                    row(entry, node as usize, 1);
                }
            }
            return;
        }
        // Numbers that are known when this is compiled make short work of a row.
        match self.tiles.cells() {
            8 => self.plain_rows::<8>(row),
            _ => self.plain_rows::<4>(row),
        }
    }

    /// The rows of a plain window: two nodes of the tile below along axis 0, those of the tile itself, two of the one above.
    #[inline(always)]
    fn plain_rows<const CELLS: usize>(&self, mut row: impl FnMut(usize, usize, usize)) {
        const BESIDE: usize = -WINDOW_START as usize;
        let lines = |axis| if axis < D { CELLS + 2 * BESIDE } else { 1 };
        for k in 0..lines(2) {
            for j in 0..lines(1) {
                let start = Window::<D>::ROW * (Window::<D>::ROW * k + j);
                let mut part =
                    |offset, count| row(start + offset, self.node(start + offset), count);
                part(0, BESIDE);
                part(BESIDE, CELLS);
                part(BESIDE + CELLS, BESIDE);
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
                sums.add(node + i, &window[sums_entry::<D>(entry + i)]);
            }
        });
    }
}

/// Elements of arrays over a window in the plane.
pub(crate) const SQUARE: usize = Window::<2>::ELEMENTS;
/// The same of its sums.
pub(crate) const SQUARE_SUMS: usize = sums_entry::<2>(SQUARE);
/// Elements of arrays over a window in space.
pub(crate) const CUBE: usize = Window::<3>::ELEMENTS;
/// The same of its sums.
pub(crate) const CUBE_SUMS: usize = sums_entry::<3>(CUBE);

/// Sums of a window, aligned so that a node's numbers lie in one cache line.
#[repr(align(64))]
pub(crate) struct WindowSums<const N: usize>(pub [[f64; SUMS]; N]);

impl<const N: usize> WindowSums<N> {
    pub(crate) fn zero() -> Self {
        Self([[0.0; SUMS]; N])
    }
}
