//! Background grids of sparse tiles, meshes of quadrilaterals, and the shape functions that live on them.
//!
//! Four words carry the crate:
//!
//! * A [`Grid`] is a box cut into equal square or cubic cells. It stores no nodes; it knows where node `[i, j, k]`
//!   would be and which cell owns a point.
//! * A **tile** is a block of `n` cells along each axis, four or eight ([`TileSize`]), and as many nodes: tile `t` holds
//!   nodes `nt ..= nt + n − 1` along an axis. [`Tiles`] lists the tiles near particles; memory is spent there and nowhere
//!   else. A node is addressed by `tile · n^D + local`, the local index running fastest along axis 0.
//! * The **window** of a tile is the `(n + 4)^D` nodes its particles may touch: nodes `nt − 2 ..= nt + n + 1`.
//!   A solver gathers a [`Window`] into a small dense array, works there, and writes it back; [`Tiles::map`] says
//!   which of the 3^D surrounding tiles owns each entry.
//! * A [`Stencil`] is one particle's list of (window index, weight N, gradient ∇N). A [`Shape`] makes it.
//!
//! ```text
//!    window of tile t   ·  ·  [·  ·  ·  ·] ·  ·        place k   0 1 2 3 4 5 6 7
//!                              tile t                  node      4t−2  …   4t+5
//! ```
//!
//! ```
//! use fissure_grid::{Grid, Shape, Stencil, TileSize, Tiles, shape, tile_of};
//! use nalgebra::{Matrix2, Vector2};
//!
//! let grid = Grid::over([0.0, 0.0], [1.0, 0.5], 0.05)?;
//! let x = Vector2::new(0.52, 0.26); // one particle, 2 per cell along each axis
//! let domain = Matrix2::identity() * 0.0125;
//!
//! let size = TileSize::Narrow;
//! let home = tile_of(grid.cell(&x).ok_or("outside")?, size.cells::<2>());
//! let mut tiles = Tiles::new();
//! tiles.rebuild(size, [home].into_iter());
//! let tile = tiles.find(home).ok_or("no tile")?;
//! let (window, around) = (tiles.window(tile), tiles.around(tile));
//!
//! let mut mass = vec![0.0; tiles.node_count()];
//! let stencil = shape::Gimp.stencil(&grid, &window, &x, &domain).ok_or("outside")?;
//! stencil.visit(|entry, weight, _gradient| {
//!     let (neighbour, local) = tiles.map()[entry];
//!     mass[around[neighbour as usize] as usize * tiles.nodes_each() + local as usize] += 3.0 * weight;
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
pub use stencils::{By, ByArms, ByArmsAndSlopes, ByNothing, OneByOne, SeparableStencils, Stencils};
pub use tiles::{ABSENT, TileSize, Tiles};
pub use window::{WINDOW_START, Window, sums_entry, tile_of};
