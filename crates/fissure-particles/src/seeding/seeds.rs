//! Where particles go.

use nalgebra::{SMatrix, SVector};

/// Where particles go and how much volume each stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Seeds<const D: usize> {
    /// Positions, m.
    pub position: Vec<SVector<f64, D>>,
    /// D-dimensional measure of each: m in 1D, m² in 2D (times a thickness later), m³ in 3D.
    pub volume: Vec<f64>,
    /// The columns are the half-edge vectors of a particle's domain, m.
    pub half_edges: SMatrix<f64, D, D>,
}

impl<const D: usize> Seeds<D> {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Sum of the measures in the order of the seeds: m in 1D, m² in 2D, m³ in 3D.
    pub fn total_volume(&self) -> f64 {
        self.volume.iter().sum()
    }
}
