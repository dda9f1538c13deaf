//! Background grids of sparse tiles and the shape functions that live on them.
