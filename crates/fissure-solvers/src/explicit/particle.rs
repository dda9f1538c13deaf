//! What a pass does to one particle with what it gathered.

use fissure_grid::simd::Lanes;
use fissure_grid::{FIELD, Gathered, Shape};
use fissure_particles::{MotionSlices, MotionSlicesMut};
use fissure_scene::Kinematics;
use fissure_tensor::Sym;
use nalgebra::{Matrix3, SMatrix, SVector};

use super::kernels::StepKernel;
use super::settings::Transfer;
use crate::nodes::{MASSIVE, vector};

/// Velocity gradient times the length of the step.
#[derive(Clone, Copy)]
pub(super) struct Strain<const D: usize> {
    /// Columns, with a fourth number that is not used.
    pub columns: [[f64; FIELD]; D],
    /// Around the axis.
    pub hoop: f64,
}

impl<const D: usize> Default for Strain<D> {
    fn default() -> Self {
        Self {
            columns: [[0.0; FIELD]; D],
            hoop: 0.0,
        }
    }
}

impl<const D: usize> Strain<D> {
    /// Work of a stress per present volume, J/m³.
    #[inline(always)]
    pub fn work(&self, stress: &Sym) -> f64 {
        let full = stress.to_matrix();
        let mut work = full.m33 * self.hoop;
        for j in 0..D {
            for i in 0..D {
                work += full[(i, j)] * self.columns[j][i];
            }
        }
        work
    }
}

impl<S: Shape<D>, const D: usize> StepKernel<'_, S, D> {
    /// The first of these rows that the trial has outside the grid.
    #[inline(always)]
    pub(super) fn first_outside(
        &self,
        mut rows: std::ops::Range<usize>,
        new: &MotionSlicesMut<'_, D>,
    ) -> Option<usize> {
        let grid = self.transfers.grid;
        let mut all_inside = true;
        for x in &new.position[rows.clone()] {
            all_inside &= grid.contains(x);
        }
        if all_inside {
            return None;
        }
        rows.find(|&row| !grid.contains(&new.position[row]))
    }

    #[inline(always)]
    pub(super) fn move_particle<L: Lanes>(
        &self,
        lanes: L,
        row: usize,
        gathered: &Gathered<L::Four, D>,
        carried: Option<L::Four>,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) {
        let end: SVector<f64, D> = vector(&lanes.store4(gathered.value));
        new.position[row] = old.position[row] + end * self.dt;
        let carried = carried.map(|carried| vector(&lanes.store4(carried)));
        new.velocity[row] = match (self.transfer, carried) {
            (Transfer::Flip { pic }, Some(gain)) => {
                (old.velocity[row] + gain) * (1.0 - pic) + end * pic
            }
            (_, Some(filtered)) => filtered,
            (_, None) => end,
        };
    }

    /// By the moments on splines, else the velocity gradient.
    #[inline(always)]
    pub(super) fn affine_part<L: Lanes, const MOMENT: bool>(
        &self,
        lanes: L,
        gathered: &Gathered<L::Four, D>,
    ) -> SMatrix<f64, D, D> {
        let columns = if MOMENT {
            scaled(lanes, &gathered.moment, self.affine_inverse.unwrap_or(0.0))
        } else {
            gradient(lanes, gathered)
        };
        matrix(lanes, &columns)
    }

    #[inline(always)]
    pub(super) fn strained<L: Lanes>(
        &self,
        lanes: L,
        mut change: [L::Four; D],
        hoop: f64,
        f_old: &Matrix3<f64>,
    ) -> Matrix3<f64> {
        if self.backward {
            let one = SMatrix::<f64, D, D>::identity();
            if let Some(inverse) = (one - matrix(lanes, &change)).try_inverse() {
                change = columns(lanes, &(inverse - one));
            }
        }
        // Columns of F with a fourth number that is not used.
        let mut f = *f_old;
        for k in 0..3 {
            let mut column = lanes.load4([f_old[(0, k)], f_old[(1, k)], f_old[(2, k)], 0.0]);
            for j in 0..D {
                column = lanes.mul_add4(change[j], lanes.splat4(f_old[(j, k)]), column);
            }
            let column = lanes.store4(column);
            for i in 0..3 {
                f[(i, k)] = column[i];
            }
        }
        if self.transfers.kinematics == Kinematics::Axisymmetric {
            f.m33 *= if self.backward {
                1.0 / (1.0 - hoop)
            } else {
                1.0 + hoop
            };
        }
        f
    }

    /// Strain around the axis in the step.
    #[inline(always)]
    pub(super) fn hoop<L: Lanes>(
        &self,
        lanes: L,
        gathered: &Gathered<L::Four, D>,
        x: &SVector<f64, D>,
    ) -> f64 {
        if self.transfers.kinematics == Kinematics::Axisymmetric {
            self.dt * lanes.store4(gathered.value)[0] / x[0]
        } else {
            0.0
        }
    }
}

/// Columns of the velocity gradient. Σ∇N = 0, so the particle's own velocity may be taken off; a node
/// without mass (N = 0 but ∇N ≠ 0, on the face of a cell) then moves with the particle.
#[inline(always)]
pub(super) fn gradient<L: Lanes, const D: usize>(
    lanes: L,
    gathered: &Gathered<L::Four, D>,
) -> [L::Four; D] {
    let mut columns = gathered.gradient;
    for column in &mut columns {
        let massive = lanes.store4(*column)[MASSIVE];
        *column = lanes.mul_add4(gathered.value, lanes.splat4(-massive), *column);
    }
    columns
}

/// Columns times a number.
#[inline(always)]
pub(super) fn scaled<L: Lanes, const D: usize>(
    lanes: L,
    columns: &[L::Four; D],
    factor: f64,
) -> [L::Four; D] {
    let mut scaled = *columns;
    for column in &mut scaled {
        *column = lanes.mul4(*column, lanes.splat4(factor));
    }
    scaled
}

/// The matrix of these columns.
#[inline(always)]
fn matrix<L: Lanes, const D: usize>(lanes: L, columns: &[L::Four; D]) -> SMatrix<f64, D, D> {
    let mut matrix = SMatrix::zeros();
    for j in 0..D {
        let column = lanes.store4(columns[j]);
        for i in 0..D {
            matrix[(i, j)] = column[i];
        }
    }
    matrix
}

/// The columns of a matrix.
#[inline(always)]
fn columns<L: Lanes, const D: usize>(lanes: L, matrix: &SMatrix<f64, D, D>) -> [L::Four; D] {
    let mut columns = [lanes.splat4(0.0); D];
    for j in 0..D {
        let mut column = [0.0; 4];
        for i in 0..D {
            column[i] = matrix[(i, j)];
        }
        columns[j] = lanes.load4(column);
    }
    columns
}
