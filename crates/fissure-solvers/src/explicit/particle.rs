//! What a pass does to eight particles with what they gathered, component by component.

use fissure_grid::simd::{EIGHT, Lanes, read_columns, read_numbers, write_columns};
use fissure_grid::{FIELD, Gathered, Shape, Stencils};
use fissure_particles::{MotionSlices, MotionSlicesMut};
use fissure_scene::Kinematics;

use super::kernels::StepKernel;
use super::settings::Transfer;
use crate::eight::{Matrix, identity, inverse};
use crate::nodes::MASSIVE;

/// Velocity gradient times the length of the step, of eight particles.
#[derive(Clone, Copy)]
pub(super) struct Strain<Eight> {
    /// Columns; those of directions that space has not are zero.
    pub columns: Matrix<Eight>,
    /// Around the axis.
    pub hoop: Eight,
}

/// The strains of eight particles in memory.
pub(super) type StoredStrain = Strain<[f64; EIGHT]>;

impl StoredStrain {
    pub(super) const NONE: Self = Self {
        columns: [[[0.0; EIGHT]; 3]; 3],
        hoop: [0.0; EIGHT],
    };
}

impl<Eight: Copy> Strain<Eight> {
    #[inline(always)]
    pub(super) fn store<L: Lanes<Eight = Eight>, const D: usize>(
        &self,
        lanes: L,
        to: &mut StoredStrain,
    ) {
        for j in 0..D {
            for i in 0..D {
                lanes.store(self.columns[j][i], &mut to.columns[j][i]);
            }
        }
        lanes.store(self.hoop, &mut to.hoop);
    }

    /// Work of stresses, given column by column, per present volume, J/m³.
    #[inline(always)]
    pub(super) fn work<L: Lanes<Eight = Eight>, const D: usize>(
        &self,
        lanes: L,
        stress: &Matrix<Eight>,
    ) -> Eight {
        let mut work = lanes.mul(stress[2][2], self.hoop);
        for j in 0..D {
            for i in 0..D {
                work = lanes.mul_add(stress[j][i], self.columns[j][i], work);
            }
        }
        work
    }
}

impl StoredStrain {
    #[inline(always)]
    pub(super) fn load<L: Lanes, const D: usize>(&self, lanes: L) -> Strain<L::Eight> {
        let mut columns = [[lanes.splat(0.0); 3]; 3];
        for j in 0..D {
            for i in 0..D {
                columns[j][i] = lanes.load(&self.columns[j][i]);
            }
        }
        Strain {
            columns,
            hoop: lanes.load(&self.hoop),
        }
    }
}

impl<S: Shape<D>, const D: usize> StepKernel<'_, S, D> {
    /// The first of these rows that the trial has outside the grid.
    pub(super) fn first_outside(
        &self,
        mut rows: std::ops::Range<usize>,
        new: &MotionSlicesMut<'_, D>,
    ) -> usize {
        let first = rows.start;
        let outside = rows.find(|&row| !self.transfers.grid.contains(&new.position[row]));
        outside.unwrap_or(first)
    }

    /// New positions, from those at `x`, and velocities of the eight from row `first` on; whether all stay on the grid.
    #[inline(always)]
    pub(super) fn move_eight<L: Lanes>(
        &self,
        lanes: L,
        first: usize,
        x: &[[f64; EIGHT]; D],
        (gathered, carried): (&Gathered<L::Eight, D>, Option<&Gathered<L::Eight, D>>),
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) -> bool {
        let (mut moved, mut velocity) = ([lanes.splat(0.0); D], [lanes.splat(0.0); D]);
        let mut places = *x;
        // Rounded after the product, as they are made again from the velocities.
        for axis in 0..D {
            let end = gathered.value[axis];
            let way = lanes.mul(end, lanes.splat(self.dt));
            moved[axis] = lanes.add(lanes.load(&x[axis]), way);
            lanes.store(moved[axis], &mut places[axis]);
            velocity[axis] = end;
        }
        write_columns(lanes, &moved, &mut new.position[first..]);
        match (self.transfer, carried) {
            (Transfer::Flip { pic }, Some(gain)) => {
                let mut before = [lanes.splat(0.0); D];
                read_columns(lanes, &old.velocity[first..], &mut before);
                for axis in 0..D {
                    let flip = lanes.add(before[axis], gain.value[axis]);
                    let flip = lanes.mul(flip, lanes.splat(1.0 - pic));
                    velocity[axis] = lanes.mul_add(velocity[axis], lanes.splat(pic), flip);
                }
            }
            (_, Some(filtered)) => velocity.copy_from_slice(&filtered.value[..D]),
            (_, None) => {}
        }
        write_columns(lanes, &velocity, &mut new.velocity[first..]);
        self.transfers.grid.contains_all(&places)
    }

    /// Writes affine parts: by the moments on splines, else the velocity gradient.
    #[inline(always)]
    pub(super) fn write_affine<L: Lanes, const MOMENT: bool>(
        &self,
        lanes: L,
        first: usize,
        gathered: &Gathered<L::Eight, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) {
        let columns = if MOMENT {
            let inverse = self.affine_inverse.unwrap_or(0.0);
            scaled(lanes, &gathered.moment, inverse)
        } else {
            gradient::<L, S, D>(lanes, gathered)
        };
        let mut numbers = [lanes.splat(0.0); 9];
        for j in 0..D {
            numbers[D * j..D * (j + 1)].copy_from_slice(&columns[j][..D]);
        }
        write_columns(lanes, &numbers[..D * D], &mut new.affine[first..]);
    }

    /// Strain of eight at `x`, by the gradients of the functions or by the moments.
    #[inline(always)]
    pub(super) fn strain<L: Lanes, const GRADIENT: bool>(
        &self,
        lanes: L,
        x: &[[f64; EIGHT]; D],
        gathered: &Gathered<L::Eight, D>,
    ) -> Strain<L::Eight> {
        let zero = lanes.splat(0.0);
        let mut columns = [[zero; 3]; 3];
        let change = if GRADIENT {
            scaled(lanes, &gradient::<L, S, D>(lanes, gathered), self.dt)
        } else {
            let factor = self.affine_inverse.unwrap_or(0.0) * self.dt;
            scaled(lanes, &gathered.moment, factor)
        };
        for j in 0..D {
            columns[j][..D].copy_from_slice(&change[j][..D]);
        }
        let mut hoop = zero;
        if self.transfers.kinematics == Kinematics::Axisymmetric {
            let around = lanes.mul(gathered.value[0], lanes.splat(self.dt));
            hoop = lanes.div(around, lanes.load(&x[0]));
        }
        Strain { columns, hoop }
    }

    /// Deformation gradients after a strain, column by column.
    #[inline(always)]
    pub(super) fn strained<L: Lanes>(
        &self,
        lanes: L,
        strain: &Strain<L::Eight>,
        f_old: &Matrix<L::Eight>,
    ) -> Matrix<L::Eight> {
        let mut change = strain.columns;
        let one = lanes.splat(1.0);
        if self.backward {
            // (1 − ΔL)⁻¹ − 1.
            let unit = identity(lanes);
            for (column, unit) in change.iter_mut().zip(&unit) {
                for (number, unit) in column.iter_mut().zip(unit) {
                    *number = lanes.sub(*unit, *number);
                }
            }
            change = inverse::<L, D>(lanes, &change);
            for j in 0..D {
                change[j][j] = lanes.sub(change[j][j], one);
            }
        }
        let mut f = *f_old;
        for k in 0..3 {
            for j in 0..D {
                for i in 0..D {
                    f[k][i] = lanes.mul_add(change[j][i], f_old[k][j], f[k][i]);
                }
            }
        }
        if self.transfers.kinematics == Kinematics::Axisymmetric {
            let stretch = if self.backward {
                lanes.div(one, lanes.sub(one, strain.hoop))
            } else {
                lanes.add(one, strain.hoop)
            };
            f[2][2] = lanes.mul(f[2][2], stretch);
        }
        f
    }
}

/// Present volumes of the eight particles from row `first` on, m³.
#[inline(always)]
pub(super) fn volumes<L: Lanes>(
    lanes: L,
    first: usize,
    volume: &[f64],
    f: &Matrix<L::Eight>,
) -> L::Eight {
    let rest = read_numbers(lanes, &volume[first..]);
    lanes.mul(rest, crate::eight::determinant(lanes, f))
}

/// Columns of the velocity gradient. Σ∇N = 0, so the particle's own velocity may be taken off; a node
/// without mass (N = 0 but ∇N ≠ 0, on the face of a cell) then moves with the particle.
#[inline(always)]
fn gradient<L: Lanes, S: Shape<D>, const D: usize>(
    lanes: L,
    gathered: &Gathered<L::Eight, D>,
) -> [[L::Eight; FIELD]; D] {
    let mut columns = gathered.gradient;
    if !<S::Stencils as Stencils<D>>::SMOOTH {
        for column in &mut columns {
            let massive = column[MASSIVE];
            for i in 0..D {
                column[i] = lanes.sub(column[i], lanes.mul(gathered.value[i], massive));
            }
        }
    }
    columns
}

/// Columns times a number.
#[inline(always)]
fn scaled<L: Lanes, const D: usize>(
    lanes: L,
    columns: &[[L::Eight; FIELD]; D],
    factor: f64,
) -> [[L::Eight; FIELD]; D] {
    let mut scaled = *columns;
    for column in &mut scaled {
        for number in column {
            *number = lanes.mul(*number, lanes.splat(factor));
        }
    }
    scaled
}
