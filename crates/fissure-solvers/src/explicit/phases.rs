//! The passes over particles of an explicit step.

use std::sync::atomic::AtomicBool;

use fissure_grid::Shape;
use fissure_scene::{Body, Report, Scene, SolveError, SweepSettings, SweepTotals, Viscosity};
use nalgebra::SVector;

use super::contact::{Gap, Meetings};
use super::filter::{Held, filter};
use super::grid_update::{NodeForces, Nodes, each_node};
use super::kernels::{Giving, StepKernel};
use super::settings::{ExplicitSettings, StressUpdate, Transfer};
use crate::checks::outside;
use crate::constraints::Constraints;
use crate::loads::Loads;
use crate::nodes::{Field, NodeSums, element, vector};
use crate::transfers::{Given, Transfers};

/// Share of the mean particle mass below which a node holds round-off and feels no force.
const NO_MASS: f64 = 1e-16;

/// What the phases of one step share.
pub(crate) struct Phases<'a, S, const D: usize> {
    pub transfers: Transfers<'a, S, D>,
    pub constraints: &'a Constraints<D>,
    pub settings: &'a ExplicitSettings,
    pub dt: f64,
    /// Number of the step, counted from 1.
    pub step: u64,
    /// Time at its start, s.
    pub time: f64,
    pub strayed: &'a AtomicBool,
    /// kg.
    pub mean_particle_mass: f64,
    /// Where bodies with a contact meet.
    pub meetings: &'a Meetings<D>,
}

/// One pass over all particles.
#[derive(Clone, Copy)]
pub(crate) struct Pass<'f> {
    /// What moves and strains the particles.
    pub field: &'f Field,
    /// What their velocity takes up, if that is another field.
    pub carried: Option<&'f Field>,
    pub moves: bool,
    pub strains: bool,
    pub giving: Giving,
}

/// Mass, momentum and internal force of the particles as they are: what the passes of a step leave
/// at the nodes for the next, made afresh.
pub(crate) fn to_grid<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    settings: &ExplicitSettings,
    scene: &Scene<D>,
    sums: &mut NodeSums<D>,
) -> Result<(), SolveError> {
    let spread = transfers.spread(
        scene,
        sums,
        Given::Momentum {
            // A column that an earlier solver left is not this one's.
            affine: settings.transfer.is_affine(),
            forces: settings.stress_update != StressUpdate::First,
            by_arms: settings.force_factor(transfers.shape, transfers.grid),
        },
    );
    spread.map_err(|(body, index)| outside(scene, body, index))
}

impl<S: Shape<D>, const D: usize> Phases<'_, S, D> {
    /// Held velocities of the sums' momenta: what strains in the schemes with the stress first and
    /// MUSL.
    pub(crate) fn straining(&self, sums: &NodeSums<D>, straining: &mut Field, gap: Gap) {
        straining.resize(sums.len(), Default::default());
        each_node(straining, |node, v| {
            *v = element(&sums.velocity(node), sums.mass(node) > 0.0);
        });
        self.meetings.part(sums, straining, self.dt, gap, false);
        for held in &self.constraints.held {
            let velocity = held.apply(&vector(&straining[held.node]));
            straining[held.node] = element(&velocity, sums.mass(held.node) > 0.0);
        }
    }

    /// Accelerates and holds the nodes.
    pub(crate) fn move_nodes(
        &self,
        scene: &Scene<D>,
        sums: &NodeSums<D>,
        nodes: &mut Nodes,
    ) -> Result<Report<D>, SolveError> {
        let loads = Loads::new(&self.transfers, scene, self.time)
            .map_err(|(body, index)| outside(scene, body, index))?;
        let forces = NodeForces {
            sums,
            loads: &loads,
            constraints: self.constraints,
            meetings: self.meetings,
            lightest: self.settings.mass_cutoff.max(NO_MASS) * self.mean_particle_mass,
            dt: self.dt,
        };
        let gains = matches!(
            self.settings.transfer,
            Transfer::Flip { .. } | Transfer::Xpic { .. }
        );
        Ok(forces.update(nodes, scene, gains))
    }

    /// What the particles' velocities take up, by XPIC or FMPM, in `nodes.carried`; what holding
    /// the terms takes is added to the `reactions` of the conditions, N.
    pub(crate) fn filter(
        &self,
        scene: &Scene<D>,
        sums: &mut NodeSums<D>,
        nodes: &mut Nodes,
        reactions: &mut [SVector<f64, D>],
    ) -> Result<(), SolveError> {
        let transfers = &self.transfers;
        let filtered = match self.settings.transfer {
            Transfer::Xpic { order } => {
                let mut start = Field::new();
                start.resize(sums.len(), Default::default());
                each_node(&mut start, |node, v| {
                    *v = element(&sums.velocity(node), true);
                });
                filter(transfers, scene, sums, start, order, self.meetings, None)
            }
            Transfer::Fmpm { order } => {
                let mut impulses = vec![SVector::zeros(); reactions.len()];
                let held = Held {
                    constraints: self.constraints,
                    impulses: &mut impulses,
                };
                let end = nodes.end.clone();
                let filtered = filter(
                    transfers,
                    scene,
                    sums,
                    end,
                    order,
                    self.meetings,
                    Some(held),
                );
                for (reaction, impulse) in reactions.iter_mut().zip(&impulses) {
                    *reaction += impulse / self.dt;
                }
                filtered
            }
            _ => return Ok(()),
        };
        let filtered = filtered.map_err(|(body, index)| outside(scene, body, index))?;
        if matches!(self.settings.transfer, Transfer::Xpic { .. }) {
            // The change of velocity is carried beside what the filter left of the old one.
            each_node(&mut nodes.carried, |node, carried| {
                for (sum, number) in carried.iter_mut().zip(&filtered[node]) {
                    *sum += number;
                }
            });
        } else {
            nodes.carried = filtered;
        }
        Ok(())
    }

    /// A pass that calls the law on every particle.
    pub(crate) fn sweep(
        &self,
        scene: &mut Scene<D>,
        sums: &mut NodeSums<D>,
        pass: Pass<'_>,
    ) -> Result<SweepTotals, SolveError> {
        sums.clear(self.transfers.placement.node_count());
        let Transfers {
            shape,
            grid,
            placement,
            ..
        } = self.transfers;
        let mut totals = SweepTotals::default();
        for (index, runs) in placement.batches() {
            let body = &mut scene.bodies_mut()[index];
            let kernel = self.kernel(body, sums, pass);
            let sweep = SweepSettings {
                in_place: self.in_place(body),
                dt: self.dt,
                band: self.settings.band.band(shape, grid, body),
                viscosity: self.viscosity(),
                simd: self.transfers.simd,
            };
            let part = body
                .sweep(runs, &kernel, &sweep)
                .map_err(|failure| failure.at(body, self.step, self.time))?;
            totals = totals.merge(part);
        }
        Ok(totals)
    }

    /// Whether a sweep over this body writes over its velocities and stresses.
    pub(crate) fn in_place(&self, body: &Body<D>) -> bool {
        self.settings.in_place::<S, D>() && body.writes_in_place()
    }

    /// Copies what a sweep will write over where no step has gone before that could be made again.
    pub(crate) fn prepare_undo(&self, scene: &mut Scene<D>) {
        for body in scene.bodies_mut() {
            if self.in_place(body) {
                body.copy_for_undo();
            }
        }
    }

    /// Brings back what the sweep of a step that failed has written over; `before` is the field that moved the particles
    /// in the step before, `dt` (s) its length.
    pub(crate) fn undo(
        &self,
        scene: &mut Scene<D>,
        sums: &NodeSums<D>,
        before: &Field,
        dt: f64,
    ) -> Result<(), SolveError> {
        let pass = Pass {
            field: before,
            carried: None,
            moves: true,
            strains: false,
            giving: Giving::Nothing,
        };
        for (index, body) in scene.bodies_mut().iter_mut().enumerate() {
            if self.in_place(body) {
                let batches = self.transfers.placement.batches();
                let runs = batches.filter(|(of, _)| *of == index).map(|(_, runs)| runs);
                let kernel = StepKernel {
                    dt,
                    ..self.kernel(body, sums, pass)
                };
                body.undo_in_place(runs, &kernel)?;
            }
        }
        Ok(())
    }

    /// A pass without the law.
    pub(crate) fn move_particles(
        &self,
        scene: &mut Scene<D>,
        sums: &mut NodeSums<D>,
        pass: Pass<'_>,
    ) -> Result<(), SolveError> {
        let placement = self.transfers.placement;
        sums.clear(placement.node_count());
        for (index, runs) in placement.batches() {
            let body = &mut scene.bodies_mut()[index];
            let kernel = self.kernel(body, sums, pass);
            body.move_runs(runs, &kernel)
                .map_err(|failure| failure.at(body, self.step, self.time))?;
        }
        Ok(())
    }

    fn kernel<'b>(
        &'b self,
        body: &Body<D>,
        sums: &'b NodeSums<D>,
        pass: Pass<'b>,
    ) -> StepKernel<'b, S, D> {
        let Transfers { shape, grid, .. } = self.transfers;
        StepKernel {
            transfers: &self.transfers,
            field: pass.field,
            carried: pass.carried,
            sums,
            half_edges: *body.half_edges(),
            transfer: self.settings.transfer,
            affine_inverse: shape.affine_inverse(grid.spacing()),
            by_arms: self.settings.force_factor(shape, grid),
            dt: self.dt,
            moves: pass.moves,
            strains: pass.strains,
            backward: self.settings.stress_update == StressUpdate::First,
            giving: pass.giving,
            banded: self.settings.band.varies(shape),
            strayed: self.strayed,
        }
    }

    fn viscosity(&self) -> Option<Viscosity> {
        let length = self.transfers.grid.spacing();
        self.settings
            .viscosity
            .map(|(linear, quadratic)| Viscosity {
                linear,
                quadratic,
                length,
            })
    }
}

/// kg.
pub(super) fn mean_particle_mass<const D: usize>(scene: &Scene<D>) -> f64 {
    let bodies = scene.bodies().iter();
    let mass: f64 = bodies
        .map(|body| body.particles().mass.iter().sum::<f64>())
        .sum();
    mass / scene.particle_count() as f64
}
