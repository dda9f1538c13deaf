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
    /// Whether the velocities are those the particles came here with (stress first): the gradient
    /// is then one at the end of the motion, `F ← (1 − Δt L)⁻¹ F`, else one at its start,
    /// `F ← (1 + Δt L) F`. With the other one a spinning body grows or shrinks.
    pub backward: bool,
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
            None => {
                let mut mean = SVector::zeros();
                stencil.visit_values(|entry, weight| {
                    mean += self.nodes[lookup.node(entry)].end * weight;
                });
                // As in `strain_particle`: a node without mass moves with the particle.
                stencil.visit(|entry, _, gradient| {
                    let node = &self.nodes[lookup.node(entry)];
                    if node.massive {
                        affine += (node.end - mean) * gradient.transpose();
                    }
                });
            }
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
        let mut velocity = SVector::zeros();
        stencil.visit_values(|entry, weight| {
            velocity += self.nodes[lookup.node(entry)].straining * weight;
        });
        let mut gradient_sum: SMatrix<f64, D, D> = SMatrix::zeros();
        stencil.visit(|entry, _, gradient| {
            let node = &self.nodes[lookup.node(entry)];
            // Σ∇N = 0, so the mean may be taken off; a node without mass (N = 0 but ∇N ≠ 0, on the
            // face of a cell) then moves with the particle.
            if node.massive {
                gradient_sum += (node.straining - velocity) * gradient.transpose();
            }
        });
        let change = gradient_sum * self.dt;
        let mut step = SMatrix::<f64, D, D>::identity() + change;
        let mut hoop = 1.0 + self.dt * velocity[0] / old.position[row][0];
        if self.backward {
            step = (SMatrix::<f64, D, D>::identity() - change)
                .try_inverse()
                .unwrap_or(step);
            hoop = 1.0 / (2.0 - hoop);
        }
        let f_old = &old.deformation_gradient[row];
        let mut f = *f_old;
        for i in 0..D {
            for j in 0..3 {
                f[(i, j)] = (0..D).map(|k| step[(i, k)] * f_old[(k, j)]).sum();
            }
        }
        if axisymmetric {
            f.m33 *= hoop;
        }
        new.deformation_gradient[row] = f;
    }
}
