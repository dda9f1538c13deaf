//! A small dense linear system on the stack.

use fissure_tensor::Sym;

use super::Plane;

/// Most unknowns: three for each of twenty planes.
const MOST: usize = 60;

/// `A x = b` with up to 60 unknowns; all zero at first.
pub(super) struct Dense {
    rows: [[f64; MOST]; MOST],
    right: [f64; MOST],
    size: usize,
}

impl Dense {
    /// `size` unknowns; `None` for more than 60.
    pub fn new(size: usize) -> Option<Self> {
        (size <= MOST).then_some(Self {
            rows: [[0.0; MOST]; MOST],
            right: [0.0; MOST],
            size,
        })
    }

    /// What the jumps of the planes other than the line's own change a component of its jump by, whose rate with the strain
    /// is `stiff`.
    pub fn set_others(&mut self, line: usize, stiff: &Sym, planes: &[Plane]) {
        for (column, plane) in planes.iter().enumerate() {
            if column != line / 3 {
                let along = stiff.traction(&plane.normal()) / plane.width;
                for other in 0..3 {
                    self.set(line, 3 * column + other, along[other]);
                }
            }
        }
    }

    pub fn set(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][column] = value;
    }

    pub fn set_right(&mut self, row: usize, value: f64) {
        self.right[row] = value;
    }

    /// Right side before [`solve`](Self::solve), unknown after.
    pub fn right(&self, row: usize) -> f64 {
        self.right[row]
    }

    /// Gauss-Jordan elimination with row pivoting; an unknown without a pivot stays zero.
    pub fn solve(&mut self) {
        let mut place: [Option<usize>; MOST] = [None; MOST];
        let mut used = 0;
        for (column, spot) in place.iter_mut().enumerate().take(self.size) {
            let best = (used..self.size).max_by(|a, b| {
                self.rows[*a][column]
                    .abs()
                    .total_cmp(&self.rows[*b][column].abs())
            });
            let Some(pivot_row) = best else { break };
            let pivot = self.rows[pivot_row][column];
            if !(pivot.abs() > 1e-10) {
                continue;
            }
            self.rows.swap(used, pivot_row);
            self.right.swap(used, pivot_row);
            let (line, right) = (self.rows[used], self.right[used]);
            for row in (0..self.size).filter(|row| *row != used) {
                let factor = self.rows[row][column] / pivot;
                if factor != 0.0 {
                    for (entry, value) in self.rows[row][..self.size].iter_mut().zip(&line) {
                        *entry -= factor * value;
                    }
                    self.right[row] -= factor * right;
                }
            }
            *spot = Some(used);
            used += 1;
        }
        let mut solution = [0.0; MOST];
        for (column, value) in solution.iter_mut().enumerate().take(self.size) {
            if let Some(row) = place[column] {
                *value = self.right[row] / self.rows[row][column];
            }
        }
        self.right = solution;
    }
}
