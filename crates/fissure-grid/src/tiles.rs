//! The sparse set of tiles that hold nodes.

mod lookup;
mod morton;

use nalgebra::SVector;

use crate::{Grid, WINDOW_START, Window};
use lookup::Lookup;
use morton::morton;

/// Marks a tile that is not held in [`Tiles::around`].
pub const ABSENT: u32 = u32::MAX;

/// How many cells a tile has along each axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TileSize {
    /// Four: 64 cells in space. In the plane where what is done for a window is dear, as at the tips of cracks.
    #[default]
    Narrow,
    /// Eight in the plane, where 64 cells then share a window of 144 nodes, and four tiles of four would take 256. In
    /// space four as well.
    Wide,
}

impl TileSize {
    /// Cells along an axis.
    #[inline]
    pub const fn cells<const D: usize>(self) -> i32 {
        1 << self.bits::<D>()
    }

    const fn bits<const D: usize>(self) -> u32 {
        match self {
            Self::Wide if D < 3 => 3,
            _ => 2,
        }
    }
}

/// The tiles that hold nodes now: the occupied ones and those their particles reach.
///
/// Tiles are numbered along a Morton curve, so neighbours in space are mostly neighbours in memory and the numbers
/// depend on the set of occupied tiles alone. Node numbers are `tile · cells^D + local`, local axis 0 fastest.
#[derive(Clone, Debug, Default)]
pub struct Tiles<const D: usize> {
    size: TileSize,
    /// Of every entry of a window where it is kept; see [`map`](Self::map).
    map: Vec<(u8, u8)>,
    /// Coordinates of all tiles, ascending along the curve.
    all: Vec<[i32; D]>,
    /// Coordinates of the occupied ones, ascending; kept for its allocation.
    holders: Vec<[i32; D]>,
    occupied: Vec<u32>,
    /// 3^D tiles around each tile.
    around: Vec<u32>,
    lookup: Lookup,
}

impl<const D: usize> Tiles<D> {
    /// Tiles around a tile, itself included: 3^D.
    pub const AROUND: usize = 3_usize.pow(D as u32);

    /// No tiles.
    pub fn new() -> Self {
        Self::default()
    }

    /// Rebuilds from the coordinates of the tiles of this size that hold particles, in any order and with repetitions.
    /// Every tile within one of an occupied tile along each axis is made, since the window covers those. Memory is
    /// reused.
    pub fn rebuild(&mut self, size: TileSize, occupied: impl Iterator<Item = [i32; D]>) {
        if self.map.is_empty() || size != self.size {
            self.size = size;
            self.map = window_map::<D>(self.cells());
        }
        self.holders.clear();
        for coordinates in occupied {
            // Sorted particles name their tile many times in a row.
            if self.holders.last() != Some(&coordinates) {
                self.holders.push(coordinates);
            }
        }
        sort(&mut self.holders);

        self.all.clear();
        self.all.extend_from_slice(&self.holders);
        for axis in 0..D {
            self.widen(axis);
        }
        self.lookup.rebuild(&self.all);

        let Self {
            all,
            holders,
            occupied,
            around,
            lookup,
            ..
        } = self;
        occupied.clear();
        occupied.extend(holders.iter().filter_map(|&tile| lookup.find(all, tile)));
        around.clear();
        around.reserve(all.len() * Self::AROUND);
        for &tile in all.iter() {
            around.extend((0..Self::AROUND).map(|neighbour| {
                beside(tile, neighbour)
                    .and_then(|coordinates| lookup.find(all, coordinates))
                    .unwrap_or(ABSENT)
            }));
        }
    }

    /// Adds the two tiles beside each along an axis; done for every axis it gives all 3^D.
    fn widen(&mut self, axis: usize) {
        for i in 0..self.all.len() {
            for step in [-1, 1] {
                let mut coordinates = self.all[i];
                coordinates[axis] = coordinates[axis].saturating_add(step);
                self.all.push(coordinates);
            }
        }
        sort(&mut self.all);
    }

    /// Number of tiles.
    #[inline]
    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Whether there is no tile.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Cells, and owned nodes, of a tile along each axis.
    #[inline]
    pub fn cells(&self) -> i32 {
        self.size.cells::<D>()
    }

    /// Nodes owned by a tile: cells^D.
    #[inline]
    pub fn nodes_each(&self) -> usize {
        1 << (self.size.bits::<D>() as usize * D)
    }

    /// Number of nodes: tiles × cells^D.
    #[inline]
    pub fn node_count(&self) -> usize {
        self.all.len() * self.nodes_each()
    }

    /// For each number of a window's entry where it is kept: which of the 3^D tiles around (offsets −1..=1, axis 0
    /// fastest, as in [`around`](Self::around)), and the node inside it (axis 0 fastest). Numbers that are no entry
    /// (see [`Window`]) have a tile beyond 3^D. Empty before the first [`rebuild`](Self::rebuild).
    #[inline]
    pub fn map(&self) -> &[(u8, u8)] {
        &self.map
    }

    /// Window of a tile; `tile` as for [`coordinates`](Self::coordinates).
    #[inline]
    pub fn window(&self, tile: usize) -> Window<D> {
        Window::of_tile(self.all[tile], self.cells())
    }

    /// Coordinates of a tile: it holds cells and nodes `cells · t .. cells · (t + 1)`. `tile` must be below [`Tiles::len`], as for a slice.
    #[inline]
    pub fn coordinates(&self, tile: usize) -> [i32; D] {
        self.all[tile]
    }

    /// The tile at the given coordinates, if it is held.
    #[inline]
    pub fn find(&self, coordinates: [i32; D]) -> Option<usize> {
        self.lookup
            .find(&self.all, coordinates)
            .map(|tile| tile as usize)
    }

    /// The tiles that hold particles, ascending.
    #[inline]
    pub fn occupied(&self) -> &[u32] {
        &self.occupied
    }

    /// The 3^D tiles around a tile (offsets −1..=1 along each axis, axis 0 fastest, itself in the middle), [`ABSENT`]
    /// where there is none, which happens only round unoccupied tiles. Empty for a tile that does not exist.
    #[inline]
    pub fn around(&self, tile: usize) -> &[u32] {
        self.around
            .chunks_exact(Self::AROUND)
            .nth(tile)
            .unwrap_or(&[])
    }

    /// Grid index of a node; `node` must be below [`Tiles::node_count`], as for a slice.
    #[inline]
    pub fn node_index(&self, node: usize) -> [i32; D] {
        let (tile, local) = (self.all[node / self.nodes_each()], node % self.nodes_each());
        let (cells, bits) = (self.cells(), self.size.bits::<D>() as usize);
        std::array::from_fn(|axis| {
            let along = (local >> (bits * axis)) as i32 & (cells - 1);
            tile[axis].saturating_mul(cells).saturating_add(along)
        })
    }

    /// Position of a node, m; `node` must be below [`Tiles::node_count`], as for a slice.
    #[inline]
    pub fn node_position(&self, grid: &Grid<D>, node: usize) -> SVector<f64, D> {
        grid.node(self.node_index(node))
    }
}

/// See [`Tiles::map`].
fn window_map<const D: usize>(cells: i32) -> Vec<(u8, u8)> {
    let mut map = vec![(u8::MAX, 0); Window::<D>::ENTRIES];
    for entry in Window::<D>::of_tile([0; D], cells).entries() {
        let place = Window::<D>::place(entry);
        let (mut neighbour, mut local) = (0, 0);
        for axis in (0..D).rev() {
            let node = place[axis] as i32 + WINDOW_START;
            neighbour = 3 * neighbour + node.div_euclid(cells) + 1;
            local = cells * local + node.rem_euclid(cells);
        }
        map[entry] = (neighbour as u8, local as u8);
    }
    map
}

/// Ascending along the curve, each once.
fn sort<const D: usize>(tiles: &mut Vec<[i32; D]>) {
    tiles.sort_unstable_by(morton);
    tiles.dedup();
}

/// Coordinates of one of the 3^D tiles around; None beyond what an index can express.
#[inline]
fn beside<const D: usize>(tile: [i32; D], neighbour: usize) -> Option<[i32; D]> {
    let mut coordinates = tile;
    let mut rest = neighbour;
    for coordinate in &mut coordinates {
        *coordinate = coordinate.checked_add((rest % 3) as i32 - 1)?;
        rest /= 3;
    }
    Some(coordinates)
}
