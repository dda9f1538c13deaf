//! The uniform background grid: where nodes are and which cell owns a point.

use nalgebra::SVector;

use crate::GridError;
use crate::axes::{Axes, Numbers};
use crate::simd::EIGHT;

/// Largest number of cells along an axis.
const MOST_CELLS: i32 = 1 << 20;
/// Part of a cell that rounding of a coordinate may take.
const ROUNDING: f64 = 1e-9;

/// Uniform Cartesian background grid of cells `spacing` wide, in metres. Holds no nodes; it only knows where they would be.
///
/// Node `[0, 0, …]` sits at the origin, the lower corner; nodes outside the box have positions too, since wide shape
/// functions reach beyond it.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<const D: usize> {
    origin: SVector<f64, D>,
    top: SVector<f64, D>,
    spacing: f64,
    inverse: f64,
    cells: [i32; D],
}

impl<const D: usize> Grid<D> {
    /// The grid from `min` to at least `max` (m), of cells `spacing` (m) wide: `ceil((max − min)/spacing)` of them,
    /// forgiving 1e-9 of a cell.
    ///
    /// # Errors
    /// Bounds or spacing that are not finite, a spacing ≤ 0, an empty box, more than 2^20 cells along an axis, or a box
    /// so far from zero that rounding moves a point by more than 1e-9 of a cell.
    pub fn over(min: [f64; D], max: [f64; D], spacing: f64) -> Result<Self, GridError> {
        const { assert!(D >= 1 && D <= 3, "grids have 1 to 3 dimensions") }
        if !(spacing.is_finite() && spacing > 0.0) {
            return Err(GridError::Spacing { spacing });
        }
        let mut cells = [0; D];
        for axis in 0..D {
            cells[axis] = count_cells(axis, min[axis], max[axis], spacing)?;
        }
        let origin = SVector::from(min);
        // The requested corner may lie a rounding above the last node; it must still be inside.
        let top = SVector::from_fn(|axis, _| {
            (min[axis] + f64::from(cells[axis]) * spacing).max(max[axis])
        });
        Ok(Self {
            origin,
            top,
            spacing,
            inverse: 1.0 / spacing,
            cells,
        })
    }

    /// Position of the lower corner, m.
    #[inline]
    pub fn origin(&self) -> SVector<f64, D> {
        self.origin
    }

    /// Width of a cell, m.
    #[inline(always)]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// 1 / spacing, 1/m.
    #[inline(always)]
    pub fn inverse_spacing(&self) -> f64 {
        self.inverse
    }

    /// Number of cells along each axis.
    #[inline]
    pub fn cells(&self) -> [i32; D] {
        self.cells
    }

    /// Position of the upper corner, m; at or beyond the one asked for.
    #[inline]
    pub fn max(&self) -> SVector<f64, D> {
        self.top
    }

    /// Position of a node, m. Any index has one, inside the box or not.
    #[inline]
    pub fn node(&self, index: [i32; D]) -> SVector<f64, D> {
        SVector::from_fn(|axis, _| self.origin[axis] + f64::from(index[axis]) * self.spacing)
    }

    /// The cell that owns a point: cell `i` owns `[i, i + 1)` along each axis, the last one its upper face too. None if
    /// the point is outside or not a number.
    #[inline]
    pub fn cell(&self, x: &SVector<f64, D>) -> Option<[i32; D]> {
        self.locate(x).map(|(cell, _)| cell)
    }

    /// Whether a point is in the box, faces included; false for NaN.
    #[inline(always)]
    pub fn contains(&self, x: &SVector<f64, D>) -> bool {
        // Without branches, so that many points are asked about at once.
        let mut inside = true;
        for axis in 0..D {
            inside &= (x[axis] >= self.origin[axis]) & (x[axis] <= self.top[axis]);
        }
        inside
    }

    /// Whether eight points, axis by axis, are all in the box.
    #[inline(always)]
    pub fn contains_all(&self, x: &[[f64; EIGHT]; D]) -> bool {
        let mut inside = true;
        for axis in 0..D {
            for x in &x[axis] {
                inside &= (*x >= self.origin[axis]) & (*x <= self.top[axis]);
            }
        }
        inside
    }

    /// The cell that owns a point and the point's coordinate in it, [0, 1) in cells (1 on the grid's upper face). None if
    /// the point is outside or not a number.
    #[inline(always)]
    pub fn locate(&self, x: &SVector<f64, D>) -> Option<([i32; D], SVector<f64, D>)> {
        self.contains(x).then(|| self.local(x))
    }

    /// As [`Grid::locate`] for a point known to be inside. For others the nearest cell with the coordinate cut to
    /// [0, 1] (NaN stays NaN).
    #[inline(always)]
    pub fn local(&self, x: &SVector<f64, D>) -> ([i32; D], SVector<f64, D>) {
        let (cell, local) = self.cell_and_local(x);
        // A cast is exact for what is inside and saturates.
        let cell = std::array::from_fn(|axis| cell.0[axis] as i32);
        (cell, SVector::from_fn(|axis, _| local.0[axis]))
    }

    /// The same with the cell's whole numbers as `f64`, which vector units handle better.
    #[inline(always)]
    pub(crate) fn cell_and_local(&self, x: &SVector<f64, D>) -> (Axes, Axes) {
        let from_origin = Axes::from_axes::<D>(|axis| x[axis] - self.origin[axis]);
        let last = Axes::from_axes::<D>(|axis| f64::from(self.cells[axis] - 1));
        self.cells_and_locals(from_origin, last)
    }

    /// The same along one axis for several coordinates.
    #[inline(always)]
    pub(crate) fn along<const N: usize>(
        &self,
        axis: usize,
        x: Numbers<N>,
    ) -> (Numbers<N>, Numbers<N>) {
        let last = Numbers::splat(f64::from(self.cells[axis] - 1));
        self.cells_and_locals(x + -self.origin[axis], last)
    }

    #[inline(always)]
    fn cells_and_locals<const N: usize>(
        &self,
        from_origin: Numbers<N>,
        last: Numbers<N>,
    ) -> (Numbers<N>, Numbers<N>) {
        let scaled = from_origin * self.inverse;
        let cell = last.min(scaled.floor().max(Numbers::splat(0.0)));
        let local = scaled - cell;
        // Its number comes last, so that what is none stays so.
        let local = Numbers::splat(1.0).min(Numbers::splat(0.0).max(local));
        (cell, local)
    }
}

/// Cells that cover [min, max], or why not.
fn count_cells(axis: usize, min: f64, max: f64, spacing: f64) -> Result<i32, GridError> {
    if !(min.is_finite() && max.is_finite()) {
        return Err(GridError::NotFinite { axis, min, max });
    }
    if max <= min {
        return Err(GridError::Empty { axis, min, max });
    }
    let coordinate = if min.abs() > max.abs() { min } else { max };
    let limit = ROUNDING * spacing / f64::EPSILON;
    if coordinate.abs() > limit {
        return Err(GridError::TooFar {
            axis,
            coordinate,
            spacing,
            limit,
        });
    }
    let cells = ((max - min) / spacing - ROUNDING).ceil().max(1.0);
    if cells > f64::from(MOST_CELLS) {
        return Err(GridError::TooManyCells {
            axis,
            cells,
            limit: MOST_CELLS,
        });
    }
    Ok(cells as i32)
}
