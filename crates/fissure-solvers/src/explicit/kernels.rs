//! From nodes to particles, run by run.

use fissure_grid::{Shape, Stencil};
use fissure_particles::{MotionSlices, MotionSlicesMut};
use fissure_scene::{Body, KernelFailure, Kinematics, Run, RunKernel};
use nalgebra::{SMatrix, SVector};

use super::grid_update::NodeMotion;
use super::settings::Transfer;
use crate::to_grid::{NodeLookup, Transfers};

/// What the kernels of a step share.
pub(crate) struct StepKernel<'a, S, const D: usize> {
    pub transfers: &'a Transfers<'a, S, D>,
    pub nodes: &'a [NodeMotion<D>],
    pub half_edges: SMatrix<f64, D, D>,
    pub transfer: Transfer,
    /// `D⁻¹` of APIC on splines, 1/m²; without it the affine part is the velocity gradient.
    pub affine_inverse: Option<f64>,
    pub dt: f64,
    /// Whether positions and velocities are moved.
    pub moves: bool,
    /// Whether the deformation gradient follows `straining`.
    pub strains: bool,
}

impl<S: Shape<D>, const D: usize> RunKernel<D> for StepKernel<'_, S, D> {
    fn gather(
        &self,
        run: &Run,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) -> Result<(), KernelFailure> {
        let tiles = &self.transfers.placement.tiles;
        let lookup = NodeLookup::new(tiles, run.tile as usize);
        let coordinates = tiles.coordinates(run.tile as usize);
        for row in 0..old.len() {
            let f = Body::<D>::in_space(&old.deformation_gradient[row]);
            let domain = self.transfers.shape.domain(&self.half_edges, &f);
            let stencil = self
                .transfers
                .shape
                .stencil(
                    self.transfers.grid,
                    coordinates,
                    &old.position[row],
                    &domain,
                )
                .ok_or(KernelFailure { row })?;
            if self.moves {
                self.move_particle(row, &stencil, &lookup, old, new);
                if !self.transfers.grid.contains(&new.position[row]) {
                    return Err(KernelFailure { row });
                }
            }
            if self.strains {
                self.strain_particle(row, &stencil, &lookup, old, new);
            }
        }
        Ok(())
    }
}

impl<S: Shape<D>, const D: usize> StepKernel<'_, S, D> {
    fn move_particle(
        &self,
        row: usize,
        stencil: &S::Stencil,
        lookup: &NodeLookup<D>,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) {
        let (mut end, mut gain, mut filtered) =
            (SVector::zeros(), SVector::zeros(), SVector::zeros());
        stencil.visit_values(|entry, weight| {
            let node = &self.nodes[lookup.node(entry)];
            end += node.end * weight;
            gain += (node.end - node.start) * weight;
            filtered += node.filtered * weight;
        });
        new.position[row] = old.position[row] + end * self.dt;
        new.velocity[row] = match self.transfer {
            Transfer::Flip { pic } => (old.velocity[row] + gain) * (1.0 - pic) + end * pic,
            Transfer::Pic | Transfer::Apic => end,
            Transfer::Xpic { .. } => filtered + gain,
            Transfer::Fmpm { .. } => filtered,
        };
        if self.transfer == Transfer::Apic {
            new.affine[row] = self.affine(row, stencil, lookup, old);
        }
    }

    fn affine(
        &self,
        row: usize,
        stencil: &S::Stencil,
        lookup: &NodeLookup<D>,
        old: &MotionSlices<'_, D>,
    ) -> SMatrix<f64, D, D> {
        let mut affine = SMatrix::zeros();
        match self.affine_inverse {
            Some(inverse) => {
                let grid = self.transfers.grid;
                let lowest = lookup.lowest_node(grid);
                stencil.visit_values(|entry, weight| {
                    let node = &self.nodes[lookup.node(entry)];
                    let arm = lookup.node_position(grid, lowest, entry) - old.position[row];
                    affine += node.end * arm.transpose() * (weight * inverse);
                });
            }
            None => stencil.visit(|entry, _, gradient| {
                affine += self.nodes[lookup.node(entry)].end * gradient.transpose();
            }),
        }
        affine
    }

    fn strain_particle(
        &self,
        row: usize,
        stencil: &S::Stencil,
        lookup: &NodeLookup<D>,
        old: &MotionSlices<'_, D>,
        new: &mut MotionSlicesMut<'_, D>,
    ) {
        let axisymmetric = self.transfers.kinematics == Kinematics::Axisymmetric;
        let mut gradient_sum: SMatrix<f64, D, D> = SMatrix::zeros();
        let mut radial = 0.0;
        stencil.visit(|entry, weight, gradient| {
            let velocity = self.nodes[lookup.node(entry)].straining;
            gradient_sum += velocity * gradient.transpose();
            radial += velocity[0] * weight;
        });
        let f_old = &old.deformation_gradient[row];
        let mut f = *f_old;
        for i in 0..D {
            for j in 0..3 {
                for k in 0..D {
                    f[(i, j)] += self.dt * gradient_sum[(i, k)] * f_old[(k, j)];
                }
            }
        }
        if axisymmetric {
            f.m33 *= 1.0 + self.dt * radial / old.position[row][0];
        }
        new.deformation_gradient[row] = f;
    }
}
