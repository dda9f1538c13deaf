//! From nodal displacements to particles.

use fissure_grid::{Shape, Stencil};
use fissure_particles::{MotionSlices, MotionSlicesMut};
use fissure_scene::{Body, KernelFailure, Kinematics, Run, RunKernel};
use nalgebra::{SMatrix, SVector};

use crate::to_grid::{NodeLookup, Transfers};

/// Moves and strains particles by the displacement increments of the nodes.
pub(crate) struct DisplacementKernel<'a, S, const D: usize> {
    pub transfers: &'a Transfers<'a, S, D>,
    /// Displacement increments, m.
    pub displacement: &'a [SVector<f64, D>],
    pub half_edges: SMatrix<f64, D, D>,
    pub dt: f64,
}

impl<S: Shape<D>, const D: usize> RunKernel<D> for DisplacementKernel<'_, S, D> {
    fn gather(
        &self,
        run: &Run,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) -> Result<(), KernelFailure> {
        let Transfers {
            grid,
            shape,
            placement,
            kinematics,
        } = self.transfers;
        let lookup = NodeLookup::new(&placement.tiles, run.tile as usize);
        let tile = placement.tiles.coordinates(run.tile as usize);
        for row in 0..old.len() {
            let f_old = &old.deformation_gradient[row];
            let domain = shape.domain(&self.half_edges, &Body::<D>::in_space(f_old));
            let x = &old.position[row];
            let stencil = shape
                .stencil(grid, tile, x, &domain)
                .ok_or(KernelFailure { row })?;
            let mut way = SVector::zeros();
            let mut gradient_sum: SMatrix<f64, D, D> = SMatrix::zeros();
            stencil.visit(|entry, weight, gradient| {
                let u = self.displacement[lookup.node(entry)];
                way += u * weight;
                gradient_sum += u * gradient.transpose();
            });
            let mut f = *f_old;
            for i in 0..D {
                for j in 0..3 {
                    for k in 0..D {
                        f[(i, j)] += gradient_sum[(i, k)] * f_old[(k, j)];
                    }
                }
            }
            if *kinematics == Kinematics::Axisymmetric {
                f.m33 *= 1.0 + way[0] / x[0];
            }
            new.deformation_gradient[row] = f;
            new.position[row] = x + way;
            new.velocity[row] = way / self.dt;
            if let Some(affine) = new.affine.get_mut(row) {
                *affine = gradient_sum / self.dt;
            }
            if !grid.contains(&new.position[row]) {
                return Err(KernelFailure { row });
            }
        }
        Ok(())
    }
}
