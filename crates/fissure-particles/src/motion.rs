//! The columns which a step writes.

use fissure_tensor::Sym;
use nalgebra::{Matrix3, SMatrix, SVector};
use serde::{Deserialize, Serialize};

use crate::error::ParticleError;
use crate::motion_slices::{MotionSlices, MotionSlicesMut};
use crate::order::gather;

/// The columns which a step writes, one row per particle.
///
/// A body has two of these, the present and the trial: a step reads one, writes the other and swaps
/// them, so that a failed step leaves the present as it was. A step [in place](Motion::slices_in_place) has positions and
/// deformation gradients twice and writes over the rest. Space has `D` dimensions; the
/// deformation gradient and the stress are 3-D always, and plane strain keeps F₃₃ = 1.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion<const D: usize> {
    /// Present position, m.
    pub position: Vec<SVector<f64, D>>,
    /// Velocity, m/s.
    pub velocity: Vec<SVector<f64, D>>,
    /// Deformation gradient F from the reference to the present placement, dimensionless.
    pub deformation_gradient: Vec<Matrix3<f64>>,
    /// Cauchy stress, Pa.
    pub stress: Vec<Sym>,
    /// Velocity gradient of an affine transfer (APIC), 1/s. Empty unless a solver asks for it with
    /// [`ensure_affine`](Self::ensure_affine).
    pub affine: Vec<SMatrix<f64, D, D>>,
}

impl<const D: usize> Motion<D> {
    /// Number of rows. Columns of different lengths are the caller's mistake, which
    /// [`Motion::check`] reports.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Adds a row: undeformed (F = 1) and free of stress. `position` in m, `velocity` in m/s.
    pub fn push(&mut self, position: SVector<f64, D>, velocity: SVector<f64, D>) {
        self.position.push(position);
        self.velocity.push(velocity);
        self.deformation_gradient.push(Matrix3::identity());
        self.stress.push(Sym::default());
        if !self.affine.is_empty() {
            self.affine.push(SMatrix::zeros());
        }
    }

    /// Makes every column `len` rows long. New rows are at the origin, at rest, undeformed and free
    /// of stress; the allocation is kept.
    pub fn resize(&mut self, len: usize) {
        self.position.resize(len, SVector::zeros());
        self.velocity.resize(len, SVector::zeros());
        self.deformation_gradient.resize(len, Matrix3::identity());
        self.stress.resize(len, Sym::default());
        if !self.affine.is_empty() {
            self.affine.resize(len, SMatrix::zeros());
        }
    }

    /// Makes the affine column, filled with zeros, if it is not there.
    pub fn ensure_affine(&mut self) {
        self.affine.resize(self.position.len(), SMatrix::zeros());
    }

    /// All rows, to read.
    pub fn slices(&self) -> MotionSlices<'_, D> {
        MotionSlices {
            position: &self.position,
            velocity: &self.velocity,
            deformation_gradient: &self.deformation_gradient,
            stress: &self.stress,
            affine: &self.affine,
        }
    }

    /// All rows, to write.
    pub fn slices_mut(&mut self) -> MotionSlicesMut<'_, D> {
        MotionSlicesMut {
            position: &mut self.position,
            velocity: &mut self.velocity,
            deformation_gradient: &mut self.deformation_gradient,
            stress: &mut self.stress,
            affine: &mut self.affine,
        }
    }

    /// Every column must have `expected` rows.
    ///
    /// # Errors
    /// [`ParticleError::ColumnLength`] for the first column which has not.
    pub fn check(&self, expected: usize) -> Result<(), ParticleError> {
        let columns = [
            ("position", self.position.len()),
            ("velocity", self.velocity.len()),
            ("deformation_gradient", self.deformation_gradient.len()),
            ("stress", self.stress.len()),
            (
                "affine",
                if self.affine.is_empty() {
                    expected
                } else {
                    self.affine.len()
                },
            ),
        ];
        for (column, found) in columns {
            if found != expected {
                return Err(ParticleError::ColumnLength {
                    column,
                    found,
                    expected,
                });
            }
        }
        Ok(())
    }

    /// Row `i` becomes what row `order[i]` was; `order` holds valid rows. Columns that `spare` has too are gathered into
    /// its storage.
    pub(crate) fn reorder(&mut self, order: &[u32], spare: &mut Self) {
        sorted(order, &mut self.position, &mut spare.position);
        sorted(order, &mut self.velocity, &mut spare.velocity);
        let gradient = &mut spare.deformation_gradient;
        sorted(order, &mut self.deformation_gradient, gradient);
        sorted(order, &mut self.stress, &mut spare.stress);
        if self.affine.is_empty() {
            spare.affine.clear();
        } else {
            sorted(order, &mut self.affine, &mut spare.affine);
        }
    }

    /// The rows of a step that writes over velocities, stresses and affine parts: to read, positions and deformation
    /// gradients of this motion, and to write, those of `trial` and the rest of this one.
    pub fn slices_in_place<'a>(
        &'a mut self,
        trial: &'a mut Self,
    ) -> (MotionSlices<'a, D>, MotionSlicesMut<'a, D>) {
        let old = MotionSlices {
            position: &self.position,
            velocity: &[],
            deformation_gradient: &self.deformation_gradient,
            stress: &[],
            affine: &[],
        };
        let new = MotionSlicesMut {
            position: &mut trial.position,
            velocity: &mut self.velocity,
            deformation_gradient: &mut trial.deformation_gradient,
            stress: &mut self.stress,
            affine: &mut self.affine,
        };
        (old, new)
    }
}

/// Brings a column into this order by way of another, which is empty again afterwards if it was before.
fn sorted<T: Copy + Send + Sync>(order: &[u32], column: &mut Vec<T>, spare: &mut Vec<T>) {
    let borrowed = spare.is_empty();
    gather(order, column, spare);
    std::mem::swap(column, spare);
    if borrowed {
        *spare = Vec::new();
    }
}
