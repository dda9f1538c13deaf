//! From nodal displacements to particles.

use fissure_grid::{Shape, Stencil, Window};
use fissure_particles::{MotionSlices, MotionSlicesMut};
use fissure_scene::{KernelFailure, Kinematics, Run, RunConstants, RunKernel, WindowKernel};
use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};

use super::links::Increment;
use crate::transfers::Transfers;
use crate::window::WindowNodes;

/// Moves and strains particles by the displacement increments of the nodes.
pub(crate) struct DisplacementKernel<'a, S, const D: usize> {
    pub transfers: &'a Transfers<'a, S, D>,
    /// Displacement increments, m.
    pub displacement: &'a [SVector<f64, D>],
    /// Factors on the deformation gradients, one a particle, where volume changes are averaged.
    pub factors: Option<&'a [f64]>,
    /// What displaces the particles, one by one, where that is not what their shape functions say.
    pub increments: Option<&'a [Increment<D>]>,
    pub half_edges: SMatrix<f64, D, D>,
    /// Whether particles have bands of their own.
    pub banded: bool,
    pub dt: f64,
}

impl<S: Shape<D>, const D: usize> RunKernel<D> for DisplacementKernel<'_, S, D> {
    fn on_window(
        &self,
        window: u32,
        work: &mut dyn FnMut(&mut dyn WindowKernel<D>) -> Result<(), KernelFailure>,
    ) -> Result<(), KernelFailure> {
        let placement = self.transfers.placement;
        work(&mut Tile {
            step: self,
            nodes: placement.nodes(window),
            window: placement.window(window),
        })
    }
}

struct Tile<'a, S, const D: usize> {
    step: &'a DisplacementKernel<'a, S, D>,
    nodes: WindowNodes<'a, D>,
    window: Window<D>,
}

impl<S: Shape<D>, const D: usize> WindowKernel<D> for Tile<'_, S, D> {
    fn gather(
        &mut self,
        run: &Run,
        _constants: &RunConstants<'_>,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) -> Result<(), KernelFailure> {
        let DisplacementKernel {
            transfers,
            displacement,
            factors,
            increments,
            half_edges,
            dt,
            ..
        } = self.step;
        for row in 0..old.len() {
            let failure = KernelFailure {
                index: run.start as usize + row,
            };
            let (x, f_old) = (&old.position[row], &old.deformation_gradient[row]);
            let stencil = transfers
                .stencil_at(half_edges, &self.window, x, f_old)
                .ok_or(failure)?;
            let mut way = SVector::zeros();
            let mut gradient_sum: SMatrix<f64, D, D> = SMatrix::zeros();
            stencil.visit(|entry, weight, gradient| {
                let u = displacement[self.nodes.node(entry)];
                way += u * weight;
                gradient_sum += u * gradient.transpose();
            });
            if let Some(increments) = increments {
                let increment = &increments[run.start as usize + row];
                gradient_sum = increment.gradient;
                way += increment.way;
            }
            let mut f = *f_old;
            for i in 0..D {
                for j in 0..3 {
                    for k in 0..D {
                        f[(i, j)] += gradient_sum[(i, k)] * f_old[(k, j)];
                    }
                }
            }
            if let Some(factors) = factors {
                let factor = factors[run.start as usize + row];
                for i in 0..D {
                    for j in 0..3 {
                        f[(i, j)] *= factor;
                    }
                }
            }
            if transfers.kinematics == Kinematics::Axisymmetric {
                f.m33 *= 1.0 + way[0] / x[0];
                if let Some(factors) = factors {
                    f.m33 *= factors[run.start as usize + row];
                }
            }
            new.deformation_gradient[row] = f;
            new.position[row] = x + way;
            new.velocity[row] = way / *dt;
            if let Some(affine) = new.affine.get_mut(row) {
                *affine = gradient_sum / *dt;
            }
            if !transfers.grid.contains(&new.position[row]) {
                return Err(failure);
            }
        }
        Ok(())
    }

    fn sets_external(&self) -> bool {
        self.step.banded
    }

    fn band(&self, at: &SVector<f64, D>) -> Option<Band> {
        self.step.transfers.shape.band_at(at)
    }
}
