//! The phases of an explicit step that touch particles.

use fissure_grid::Shape;
use fissure_particles::{MotionSlices, MotionSlicesMut, ParticleId, Particles};
use fissure_scene::{
    Body, KernelFailure, Run, RunKernel, Scene, SolveError, SweepSettings, SweepTotals, Viscosity,
};
use nalgebra::SVector;

use super::filter::{Held, filter};
use super::grid_update::{NodeMotion, velocity};
use super::kernels::StepKernel;
use super::settings::{ExplicitSettings, StressUpdate, Transfer};
use crate::constraints::Constraints;
use crate::loads::add_loads;
use crate::placement::outside;
use crate::to_grid::{Gift, StressForce, Sums, Transfers};

/// What the phases of one step share.
pub(crate) struct Phases<'a, S, const D: usize> {
    pub transfers: Transfers<'a, S, D>,
    pub constraints: &'a Constraints<D>,
    pub settings: &'a ExplicitSettings,
    pub viscosity: Option<Viscosity>,
    pub dt: f64,
    /// Number of the step, counted from 1.
    pub step: u64,
    /// Time at its start, s.
    pub time: f64,
}

impl<S: Shape<D>, const D: usize> Phases<'_, S, D> {
    /// Mass, momentum and forces to the nodes; the stress is the present or (`trial`) the new one.
    pub(crate) fn to_grid(
        &self,
        scene: &Scene<D>,
        sums: &mut Sums<D>,
        trial: bool,
    ) -> Result<(), SolveError> {
        let (time, kinematics) = (self.time, self.transfers.kinematics);
        self.transfers
            .to_grid(scene, sums, |body, i, _, _| {
                let particles = body.particles();
                let stressed = if trial {
                    &particles.trial
                } else {
                    &particles.motion
                };
                let jacobian = stressed.deformation_gradient[i].determinant();
                let x = &particles.motion.position[i];
                let acceleration = scene.body_acceleration(x, time);
                let volume = particles.volume[i] * jacobian;
                let force = StressForce::new(kinematics, &stressed.stress[i], volume, x);
                Gift {
                    stress: Some(force),
                    acceleration: acceleration.unwrap_or_else(SVector::zeros),
                    ..self.momentum(particles, i, false)
                }
            })
            .and_then(|()| add_loads(&self.transfers, scene, sums, time))
            .map_err(|(body, index)| outside(scene, body, index))
    }

    /// Maps the particles' present (or, `trial`, moved) velocities to the nodes: what strains.
    pub(crate) fn strain_by_particle_velocities(
        &self,
        scene: &Scene<D>,
        scratch: &mut Sums<D>,
        nodes: &mut Vec<NodeMotion<D>>,
        trial: bool,
    ) -> Result<(), SolveError> {
        self.transfers
            .to_grid(scene, scratch, |body, i, _, _| {
                self.momentum(body.particles(), i, trial)
            })
            .map_err(|(body, index)| outside(scene, body, index))?;
        nodes.resize(scratch.nodes.len(), NodeMotion::default());
        for (node, sum) in nodes.iter_mut().zip(&scratch.nodes) {
            node.massive = sum.mass > 0.0;
            node.straining = velocity(sum);
        }
        for held in &self.constraints.held {
            let node = &mut nodes[held.node];
            node.straining = held.apply(&node.straining);
        }
        Ok(())
    }

    /// Filtered nodal velocities, if the transfer wants them; what holding them takes is added to
    /// the `reactions` of the conditions, N.
    pub(crate) fn filter(
        &self,
        scene: &Scene<D>,
        scratch: &mut Sums<D>,
        nodes: &mut [NodeMotion<D>],
        reactions: &mut [SVector<f64, D>],
    ) -> Result<(), SolveError> {
        let transfers = &self.transfers;
        let start = |node: &NodeMotion<D>| node.start;
        let end = |node: &NodeMotion<D>| node.end;
        match self.settings.transfer {
            Transfer::Xpic { order } => {
                filter(transfers, scene, scratch, nodes, order, start, None)
            }
            Transfer::Fmpm { order } => {
                let mut impulses = vec![SVector::zeros(); reactions.len()];
                let held = Held {
                    constraints: self.constraints,
                    impulses: &mut impulses,
                };
                let done = filter(transfers, scene, scratch, nodes, order, end, Some(held));
                for (reaction, impulse) in reactions.iter_mut().zip(&impulses) {
                    *reaction += impulse / self.dt;
                }
                done
            }
            _ => Ok(()),
        }
        .map_err(|(body, index)| outside(scene, body, index))
    }

    /// New deformation gradients from the nodes (and the motion, if `moves`), then the law.
    pub(crate) fn sweep(
        &self,
        scene: &mut Scene<D>,
        nodes: &[NodeMotion<D>],
        moves: bool,
    ) -> Result<SweepTotals, SolveError> {
        let mut totals = SweepTotals::default();
        for (index, body) in scene.bodies_mut().iter_mut().enumerate() {
            let kernel = self.kernel(body, nodes, moves, true);
            let Transfers { shape, grid, .. } = self.transfers;
            let sweep = SweepSettings {
                dt: self.dt,
                band: self.settings.band.band(shape, grid, body),
                viscosity: self.viscosity,
            };
            let part = body
                .sweep(&self.transfers.placement.runs[index], &kernel, &sweep)
                .map_err(|failure| failure.at(body, self.step, self.time))?;
            totals = totals.merge(part);
        }
        Ok(totals)
    }

    /// Moves the particles without calling the law.
    pub(crate) fn move_particles(
        &self,
        scene: &mut Scene<D>,
        nodes: &[NodeMotion<D>],
    ) -> Result<(), SolveError> {
        let mut failed = None;
        for (index, body) in scene.bodies_mut().iter_mut().enumerate() {
            let kernel = self.kernel(body, nodes, true, false);
            let Particles {
                id, motion, trial, ..
            } = body.particles_with_trial();
            let runs = &self.transfers.placement.runs[index];
            if let Err((_, row)) = move_runs(runs, &kernel, id, motion.slices(), trial.slices_mut())
            {
                failed = Some((index, row));
                break;
            }
        }
        failed.map_or(Ok(()), |(body, index)| Err(outside(scene, body, index)))
    }

    fn kernel<'b>(
        &'b self,
        body: &Body<D>,
        nodes: &'b [NodeMotion<D>],
        moves: bool,
        strains: bool,
    ) -> StepKernel<'b, S, D> {
        let Transfers { shape, grid, .. } = self.transfers;
        StepKernel {
            transfers: &self.transfers,
            nodes,
            half_edges: *body.half_edges(),
            transfer: self.settings.transfer,
            affine_inverse: shape.affine_inverse(grid.spacing()),
            dt: self.dt,
            moves,
            strains,
            backward: self.settings.stress_update == StressUpdate::First,
        }
    }

    /// Mass and momentum of a particle, with its present or its trial velocity.
    fn momentum(&self, particles: &Particles<D>, i: usize, trial: bool) -> Gift<D> {
        let motion = if trial {
            &particles.trial
        } else {
            &particles.motion
        };
        let affine = match self.settings.transfer {
            Transfer::Apic => motion.affine.get(i).copied(),
            // A column that an earlier solver left is not this one's.
            _ => None,
        };
        Gift {
            mass: particles.mass[i],
            velocity: motion.velocity[i],
            affine,
            stress: None,
            acceleration: SVector::zeros(),
        }
    }
}

/// Halves the runs until one is left; the error is the failing particle with the lowest id.
fn move_runs<const D: usize>(
    runs: &[Run],
    kernel: &dyn RunKernel<D>,
    ids: &[ParticleId],
    old: MotionSlices<'_, D>,
    mut new: MotionSlicesMut<'_, D>,
) -> Result<(), (ParticleId, usize)> {
    match runs {
        [] => Ok(()),
        [run] => kernel
            .gather(run, &old, &mut new)
            .map_err(|failure: KernelFailure| {
                let KernelFailure { row } = failure.lowest(kernel, run, ids, &old, &mut new);
                let index = run.start as usize + row;
                (ids[index], index)
            }),
        _ => {
            let (left, right) = runs.split_at(runs.len() / 2);
            let row = (right[0].start - left[0].start) as usize;
            let ((old_a, old_b), (new_a, new_b)) = (old.split_at(row), new.split_at(row));
            let (a, b) = rayon::join(
                || move_runs(left, kernel, ids, old_a, new_a),
                || move_runs(right, kernel, ids, old_b, new_b),
            );
            match (a, b) {
                (Err(a), Err(b)) => Err(a.min(b)),
                (a, b) => a.and(b),
            }
        }
    }
}
