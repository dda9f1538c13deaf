//! Background grids of sparse tiles, meshes of quadrilaterals, and the shape functions that live on them.
//!
//! Four words carry the crate:
//!
//! * A [`Grid`] is a box cut into equal square or cubic cells. It stores no nodes; it knows where node `[i, j, k]`
//!   would be and which cell owns a point.
//! * A **tile** is a block of [`TILE`]`^D` = 4^D cells and as many nodes: tile `t` holds nodes `4t ..= 4t + 3` along an
//!   axis. [`Tiles`] lists the tiles near particles; memory is spent there and nowhere else. A node is addressed
//!   by `tile · 4^D + local`, the local index running fastest along axis 0.
//! * The **window** of a tile is the [`WINDOW`]`^D` = 8^D nodes its particles may touch: nodes `4t − 2 ..= 4t + 5`.
//!   A solver gathers a window into a small dense array, works there, and writes it back; [`window_map`] says
//!   which of the 3^D surrounding tiles owns each entry.
//! * A [`Stencil`] is one particle's list of (window index, weight N, gradient ∇N). A [`Shape`] makes it.
//!
//! ```text
//!    window of tile t   ·  ·  [·  ·  ·  ·] ·  ·        index k   0 1 2 3 4 5 6 7
//!                              tile t                  node      4t−2  …   4t+5
//! ```
//!
//! ```
//! use fissure_grid::{Grid, Shape, Stencil, Tiles, shape, tile_of, window_map};
//! use nalgebra::{Matrix2, Vector2};
//!
//! let grid = Grid::over([0.0, 0.0], [1.0, 0.5], 0.05)?;
//! let x = Vector2::new(0.52, 0.26); // one particle, 2 per cell along each axis
//! let domain = Matrix2::identity() * 0.0125;
//!
//! let tile = grid.cell(&x).map(tile_of).ok_or("outside")?;
//! let mut tiles = Tiles::new();
//! tiles.rebuild([tile].into_iter());
//! let around = tiles.around(tiles.find(tile).ok_or("no tile")?);
//!
//! let mut mass = vec![0.0; tiles.node_count()];
//! let stencil = shape::Gimp.stencil(&grid, tile, &x, &domain).ok_or("outside")?;
//! stencil.visit(|window, weight, _gradient| {
//!     let (neighbour, local) = window_map::<2>()[window];
//!     mass[around[neighbour as usize] as usize * 16 + local as usize] += 3.0 * weight;
//! });
//!
//! let centre = (0..tiles.node_count()).map(|n| tiles.node_position(&grid, n) * mass[n]).sum::<Vector2<f64>>() / 3.0;
//! assert!((centre - x).norm() <= 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`QuadMesh`] takes the place of the grid's nodes where these are not to stand in rows: its elements fall into
//! [`Patches`], which are to it what tiles are to a grid, and [`shape::Isoparametric`] makes the stencils.
//!
//! Space is `const D: usize`, 1 to 3 (the solvers use 2 and 3). Lengths are in metres. Nothing here depends on the
//! order of a hash map or on the number of threads.

mod axes;
mod error;
mod grid;
mod patches;
mod quads;
mod separable;
pub mod shape;
mod stencil;
mod stencils;
mod tiles;
mod window;

pub use error::GridError;
pub use fissure_tensor::simd;
pub use grid::Grid;
pub use patches::Patches;
pub use quads::{MeshError, QuadMesh, QuadStencil};
pub use separable::Separable;
pub use shape::Shape;
pub use stencil::{FIELD, Gathered, Gift, SUMS, Stencil};
pub use stencils::{OneByOne, SeparableStencils, Stencils};
pub use tiles::{ABSENT, Tiles};
pub use window::{
    TILE, WINDOW, WINDOW_START, sums_entry, tile_of, window_entries, window_map, window_node,
};
