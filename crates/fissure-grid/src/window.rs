//! The window of a tile: the nodes its particles may reach, and how its entries are numbered.

/// First node of a tile's window along an axis, relative to the tile's own first node.
pub const WINDOW_START: i32 = -2;

/// The tile, of so many cells along each axis, that holds a cell or owns a node: `floor(index / cells)`.
#[inline]
pub fn tile_of<const D: usize>(index: [i32; D], cells: i32) -> [i32; D] {
    index.map(|i| i.div_euclid(cells))
}

/// The nodes that particles of a tile may reach: so many along each axis, from `first` on.
///
/// An entry of a window is numbered `Σ_a k_a ROW^a`, with `k_a` in 0..`nodes`: a window that is less wide than the
/// widest leaves numbers out, so that the nodes of a stencil are always the same numbers apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window<const D: usize> {
    /// Grid index of the first node; on a mesh the first coordinate is the number of the patch.
    pub first: [i32; D],
    /// Nodes along an axis, at most [`ROW`](Self::ROW).
    pub nodes: i32,
}

impl<const D: usize> Window<D> {
    /// Most nodes along an axis: those of a tile of eight cells, in space of four.
    pub const ROW: usize = if D < 3 { 12 } else { 8 };
    /// Numbers of entries: ROW^D.
    pub const ENTRIES: usize = Self::ROW.pow(D as u32);
    /// Elements of an array over a window: its entries, and as many as a stencil of four nodes along each axis reaches
    /// past the last of them. Those hold nothing. They are there so that transfers need not ask where a stencil ends.
    pub const ELEMENTS: usize = Self::ENTRIES + Self::reach();

    const fn reach() -> usize {
        let (mut reach, mut axis) = (1, 0);
        while axis < D {
            reach += 3 * Self::ROW.pow(axis as u32);
            axis += 1;
        }
        reach
    }

    /// Of a tile of so many cells along each axis: two nodes more than its own on either side.
    #[inline]
    pub fn of_tile(tile: [i32; D], cells: i32) -> Self {
        let first = |t: i32| t.saturating_mul(cells).saturating_add(WINDOW_START);
        Self {
            first: tile.map(first),
            nodes: nodes_of(cells),
        }
    }

    /// What stands for the window of a patch of a mesh, whose entries are numbered one after another.
    #[inline]
    pub fn of_patch(patch: u32) -> Self {
        let mut first = [0; D];
        first[0] = patch as i32;
        Self { first, nodes: 0 }
    }

    /// Place of an entry along each axis.
    #[inline]
    pub fn place(entry: usize) -> [usize; D] {
        std::array::from_fn(|axis| entry / Self::ROW.pow(axis as u32) % Self::ROW)
    }

    /// Grid index of an entry's node.
    #[inline]
    pub fn node(&self, entry: usize) -> [i32; D] {
        let place = Self::place(entry);
        std::array::from_fn(|axis| self.first[axis].saturating_add(place[axis] as i32))
    }

    /// The entries, ascending.
    pub fn entries(&self) -> impl Iterator<Item = usize> + use<D> {
        let nodes = self.nodes as usize;
        (0..Self::ENTRIES).filter(move |&entry| Self::place(entry).iter().all(|&k| k < nodes))
    }

    /// The last of the entries.
    pub fn last(&self) -> usize {
        let place = self.nodes.max(1) as usize - 1;
        (0..D as u32).map(|axis| place * Self::ROW.pow(axis)).sum()
    }

    /// Place, along one axis, of the first of `count` nodes starting at `node`; None if they do not all fit.
    #[inline(always)]
    pub(crate) fn start(&self, axis: usize, node: i32, count: i32) -> Option<usize> {
        let start = node.saturating_sub(self.first[axis]);
        (start >= 0 && start <= self.nodes - count).then_some(start as usize)
    }
}

/// Nodes along an axis of the window of a tile of so many cells.
pub(crate) const fn nodes_of(cells: i32) -> i32 {
    cells - 2 * WINDOW_START
}

/// Where the sums of a window entry stand in an array of `sums_entry::<D>(Window::<D>::ELEMENTS)`: a layer of space takes
/// one place more than it has nodes. Else the nodes of a stencil in several layers would lie 4096 bytes apart, and a
/// processor takes the reading of one for the writing of another.
#[inline(always)]
pub const fn sums_entry<const D: usize>(entry: usize) -> usize {
    if D < 3 {
        entry
    } else {
        entry + entry / (Window::<D>::ROW * Window::<D>::ROW)
    }
}
