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
/// them, so that a failed step leaves the present as it was. Space has `D` dimensions; the
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

    /// Row `i` of `self` becomes row `order[i]` of `from`; `order` holds valid rows of `from`.
    pub(crate) fn gather_from(&mut self, order: &[u32], from: &Self) {
        gather(order, &from.position, &mut self.position);
        gather(order, &from.velocity, &mut self.velocity);
        gather(
            order,
            &from.deformation_gradient,
            &mut self.deformation_gradient,
        );
        gather(order, &from.stress, &mut self.stress);
        if from.affine.is_empty() {
            self.affine.clear();
        } else {
            gather(order, &from.affine, &mut self.affine);
        }
    }
}
