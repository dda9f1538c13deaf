//! The affine part of a particle's velocity field.

use nalgebra::SMatrix;
use serde::{Deserialize, Serialize};

use crate::extra::Column;

/// The affine matrix of a particle in the affine particle-in-cell method (Jiang et al. 2015), D ×
/// D; zero at first.
///
/// Whether it holds the moment B (m²/s) or the velocity gradient C = B·D⁻¹ (1/s) is for the solver
/// which asks for the column to say; nothing else reads it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Affine<const D: usize>(pub SMatrix<f64, D, D>);

impl<const D: usize> Default for Affine<D> {
    fn default() -> Self {
        Self(SMatrix::zeros())
    }
}

impl<const D: usize> Column for Affine<D> {
    const NAME: &'static str = match D {
        1 => "affine-1d",
        2 => "affine-2d",
        3 => "affine-3d",
        _ => "affine",
    };
}
