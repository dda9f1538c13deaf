//! Tiles and windows: the constants, and where each entry of a window is kept.

/// Cells, and owned nodes, of a tile along an axis.
pub const TILE: i32 = 4;
/// Nodes the particles of a tile may reach along an axis: window indices 0..8 stand for nodes 4t − 2 ..= 4t + 5.
pub const WINDOW: i32 = 8;
/// First node of a tile's window along an axis, relative to the tile's own first node.
pub const WINDOW_START: i32 = -2;

/// The tile that holds a cell or owns a node: `floor(index / 4)` along each axis.
#[inline]
pub fn tile_of<const D: usize>(index: [i32; D]) -> [i32; D] {
    index.map(|i| i.div_euclid(TILE))
}

/// For each of the 8^D entries of a window (axis 0 fastest) where it is kept: which of the 3^D tiles around (offsets
/// −1..=1, axis 0 fastest, as in [`Tiles::around`](crate::Tiles::around)), and the node inside it (0..4^D, axis 0
/// fastest).
///
/// Read backwards it serves an owner that gathers: a tile's nodes lie in the window of its neighbour `n` at the entries
/// marked `3^D − 1 − n`, the direction from that neighbour to the tile.
#[inline]
pub fn window_map<const D: usize>() -> &'static [(u8, u8)] {
    static LINE: [(u8, u8); 8] = table(1);
    static SQUARE: [(u8, u8); 64] = table(2);
    static CUBE: [(u8, u8); 512] = table(3);
    match D {
        1 => &LINE,
        2 => &SQUARE,
        3 => &CUBE,
        _ => &[],
    }
}

const fn table<const N: usize>(dimensions: usize) -> [(u8, u8); N] {
    let mut map = [(0, 0); N];
    let mut entry = 0;
    while entry < N {
        let (mut neighbour, mut local) = (0, 0);
        let mut axis = dimensions;
        while axis > 0 {
            axis -= 1;
            let node = (entry >> (3 * axis)) as i32 % WINDOW + WINDOW_START;
            neighbour = 3 * neighbour + node.div_euclid(TILE) + 1;
            local = TILE * local + node.rem_euclid(TILE);
        }
        map[entry] = (neighbour as u8, local as u8);
        entry += 1;
    }
    map
}

/// Where the sums of a window entry stand in an array of [`sums_entry`]`(8^D)`: a layer of space takes one place more than
/// it has nodes. Else the nodes of a stencil in several layers would lie 4096 bytes apart, and a processor takes the
/// reading of one for the writing of another.
#[inline(always)]
pub const fn sums_entry(entry: usize) -> usize {
    entry + entry / (WINDOW * WINDOW) as usize
}

/// Entries of an array over a window: its own, and as many as a stencil of four nodes along each axis reaches past the
/// last of them. Those hold nothing. They are there so that transfers need not ask where a stencil ends.
pub const fn window_entries(dimensions: usize) -> usize {
    let (mut own, mut reach, mut axis) = (1, 1, 0);
    while axis < dimensions {
        reach += 3 * own;
        own *= WINDOW as usize;
        axis += 1;
    }
    own + reach
}

/// Grid index of a window entry's node; `entry` is below 8^D.
#[inline]
pub fn window_node<const D: usize>(tile: [i32; D], entry: usize) -> [i32; D] {
    std::array::from_fn(|axis| {
        tile[axis] * TILE + WINDOW_START + ((entry >> (3 * axis)) & 7) as i32
    })
}

/// Window index, along one axis, of the first of `count` nodes starting at `node`; None if they do not all fit.
#[inline(always)]
pub(crate) fn window_start(tile: i32, node: i32, count: i32) -> Option<usize> {
    let start = node
        .saturating_sub(tile.saturating_mul(TILE))
        .saturating_sub(WINDOW_START);
    (start >= 0 && start <= WINDOW - count).then_some(start as usize)
}
