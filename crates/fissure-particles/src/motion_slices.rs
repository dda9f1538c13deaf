//! Borrowed ranges of the columns of a motion, which can be split into disjoint ranges.

use fissure_tensor::Sym;
use nalgebra::{Matrix3, SMatrix, SVector};

/// A range of rows of a [`Motion`](crate::Motion), to read. The columns have the same length.
#[derive(Clone, Copy, Debug)]
pub struct MotionSlices<'a, const D: usize> {
    /// Present position, m.
    pub position: &'a [SVector<f64, D>],
    /// Velocity, m/s.
    pub velocity: &'a [SVector<f64, D>],
    /// Deformation gradient, dimensionless.
    pub deformation_gradient: &'a [Matrix3<f64>],
    /// Cauchy stress, Pa.
    pub stress: &'a [Sym],
    /// Velocity gradients of an affine transfer, 1/s; empty unless asked for.
    pub affine: &'a [SMatrix<f64, D, D>],
}

impl<'a, const D: usize> MotionSlices<'a, D> {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// The rows before `row` and those from `row` on. A `row` beyond the end leaves the second part
    /// empty.
    pub fn split_at(self, row: usize) -> (Self, Self) {
        let row = row.min(self.len());
        let (position, position_rest) = split(self.position, row);
        let (velocity, velocity_rest) = split(self.velocity, row);
        let (gradient, gradient_rest) = split(self.deformation_gradient, row);
        let (stress, stress_rest) = split(self.stress, row);
        let (affine, affine_rest) = split(self.affine, row);
        let first = Self {
            position,
            velocity,
            deformation_gradient: gradient,
            stress,
            affine,
        };
        let rest = Self {
            position: position_rest,
            velocity: velocity_rest,
            deformation_gradient: gradient_rest,
            stress: stress_rest,
            affine: affine_rest,
        };
        (first, rest)
    }
}

/// A range of rows of a [`Motion`](crate::Motion), to write. The columns have the same length.
///
/// `split_at` gives two ranges which share no row, so that `rayon::join` can recurse on both.
#[derive(Debug)]
pub struct MotionSlicesMut<'a, const D: usize> {
    /// Present position, m.
    pub position: &'a mut [SVector<f64, D>],
    /// Velocity, m/s.
    pub velocity: &'a mut [SVector<f64, D>],
    /// Deformation gradient, dimensionless.
    pub deformation_gradient: &'a mut [Matrix3<f64>],
    /// Cauchy stress, Pa.
    pub stress: &'a mut [Sym],
    /// Velocity gradients of an affine transfer, 1/s; empty unless asked for.
    pub affine: &'a mut [SMatrix<f64, D, D>],
}

impl<'a, const D: usize> MotionSlicesMut<'a, D> {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// The same rows, to read.
    pub fn as_slices(&self) -> MotionSlices<'_, D> {
        MotionSlices {
            position: self.position,
            velocity: self.velocity,
            deformation_gradient: self.deformation_gradient,
            stress: self.stress,
            affine: self.affine,
        }
    }

    /// The same rows for a shorter time, so that the range can be used again afterwards.
    pub fn reborrow(&mut self) -> MotionSlicesMut<'_, D> {
        MotionSlicesMut {
            position: self.position,
            velocity: self.velocity,
            deformation_gradient: self.deformation_gradient,
            stress: self.stress,
            affine: self.affine,
        }
    }

    /// The rows before `row` and those from `row` on. A `row` beyond the end leaves the second part
    /// empty.
    pub fn split_at(self, row: usize) -> (Self, Self) {
        let row = row.min(self.len());
        let (position, position_rest) = split_mut(self.position, row);
        let (velocity, velocity_rest) = split_mut(self.velocity, row);
        let (gradient, gradient_rest) = split_mut(self.deformation_gradient, row);
        let (stress, stress_rest) = split_mut(self.stress, row);
        let (affine, affine_rest) = split_mut(self.affine, row);
        let first = Self {
            position,
            velocity,
            deformation_gradient: gradient,
            stress,
            affine,
        };
        let rest = Self {
            position: position_rest,
            velocity: velocity_rest,
            deformation_gradient: gradient_rest,
            stress: stress_rest,
            affine: affine_rest,
        };
        (first, rest)
    }
}

// The fields are public, so that a column may have been made shorter than the others: clamped, not
// a panic.
fn split<T>(column: &[T], row: usize) -> (&[T], &[T]) {
    column.split_at(row.min(column.len()))
}

fn split_mut<T>(column: &mut [T], row: usize) -> (&mut [T], &mut [T]) {
    let row = row.min(column.len());
    column.split_at_mut(row)
}

#[cfg(test)]
mod tests {
    use crate::Motion;
    use nalgebra::Vector2;

    #[test]
    fn ranges_split_in_parallel_write_every_row_once() {
        fn number(mut rows: crate::MotionSlicesMut<'_, 2>, first: usize) {
            if rows.len() > 3 {
                let half = rows.len() / 2;
                let (a, b) = rows.split_at(half);
                rayon::join(|| number(a, first), || number(b, first + half));
                return;
            }
            let rows = rows.reborrow();
            for (i, x) in rows.position.iter_mut().enumerate() {
                x[0] += (first + i) as f64;
            }
        }
        let mut motion = Motion::<2>::default();
        motion.resize(101);
        number(motion.slices_mut(), 0);
        for (i, x) in motion.position.iter().enumerate() {
            assert_eq!(*x, Vector2::new(i as f64, 0.0));
        }
    }

    #[test]
    fn splitting_beyond_the_end_leaves_the_rest_empty() {
        let mut motion = Motion::<3>::default();
        motion.resize(5);
        let (first, rest) = motion.slices().split_at(9);
        assert_eq!((first.len(), rest.len()), (5, 0));
        let (first, rest) = motion.slices_mut().split_at(2);
        assert_eq!((first.len(), rest.len()), (2, 3));
        assert_eq!((rest.as_slices().stress.len(), rest.is_empty()), (3, false));
    }
}
