//! Nodes are accelerated and held.

use fissure_grid::Tiles;
use fissure_scene::{Report, Scene, StepEnergy};
use nalgebra::SVector;
use rayon::prelude::*;

use crate::constraints::Constraints;
use crate::to_grid::NodeSum;

/// Velocities of a node in a step, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NodeMotion<const D: usize> {
    /// Whether any particle gives it mass; else it has no velocity of its own.
    pub massive: bool,
    /// At the start of the step, from the particles.
    pub start: SVector<f64, D>,
    /// At its end.
    pub end: SVector<f64, D>,
    /// What strains the particles: `end`, or the velocity mapped back (MUSL).
    pub straining: SVector<f64, D>,
    /// Filtered velocity of XPIC and FMPM.
    pub filtered: SVector<f64, D>,
}

impl<const D: usize> Default for NodeMotion<D> {
    fn default() -> Self {
        Self {
            massive: false,
            start: SVector::zeros(),
            end: SVector::zeros(),
            straining: SVector::zeros(),
            filtered: SVector::zeros(),
        }
    }
}

/// Momentum over mass; a node without mass does not move.
#[inline]
pub(crate) fn velocity<const D: usize>(sum: &NodeSum<D>) -> SVector<f64, D> {
    if sum.mass > 0.0 {
        sum.momentum / sum.mass
    } else {
        SVector::zeros()
    }
}

/// Accelerates the nodes over `dt`, applies the held velocities and books forces and energies.
pub(crate) fn update<const D: usize>(
    sums: &[NodeSum<D>],
    motion: &mut Vec<NodeMotion<D>>,
    constraints: &Constraints<D>,
    scene: &Scene<D>,
    lightest: f64,
    dt: f64,
) -> Report<D> {
    motion.resize(sums.len(), NodeMotion::default());
    motion
        .par_iter_mut()
        .with_min_len(Tiles::<D>::NODES)
        .zip(sums)
        .for_each(|(node, sum)| {
            node.massive = sum.mass > 0.0;
            node.start = velocity(sum);
            node.end = node.start;
            if sum.mass > lightest {
                node.end += (sum.internal_force + sum.external_force) * (dt / sum.mass);
            }
        });
    let mut energy = StepEnergy::default();
    let mut reactions = vec![SVector::zeros(); scene.conditions().len()];
    for held in &constraints.held {
        let (sum, node) = (&sums[held.node], &mut motion[held.node]);
        let free = node.end;
        node.end = held.apply(&free);
        let mean = (node.start + node.end) * 0.5;
        let force = (node.end - free) * (sum.mass / dt);
        energy.external += force.dot(&mean) * dt;
        for (condition, reaction) in held.reactions(&force) {
            reactions[condition] += reaction;
        }
    }
    let partial: Vec<StepEnergy> = motion
        .par_chunks(Tiles::<D>::NODES)
        .zip(sums.par_chunks(Tiles::<D>::NODES))
        .map(|(motion, sums)| tile_energy(motion, sums, lightest, dt))
        .collect();
    for tile in partial {
        energy.external += tile.external;
        energy.internal += tile.internal;
        energy.kinetic_grid_start += tile.kinetic_grid_start;
        energy.kinetic_grid_end += tile.kinetic_grid_end;
    }
    Report {
        step: scene.step() + 1,
        time: scene.time() + dt,
        dt,
        energy,
        reactions,
        iterations: 0,
    }
}

fn tile_energy<const D: usize>(
    motion: &[NodeMotion<D>],
    sums: &[NodeSum<D>],
    lightest: f64,
    dt: f64,
) -> StepEnergy {
    let mut energy = StepEnergy::default();
    for (node, sum) in motion.iter().zip(sums) {
        energy.kinetic_grid_start += 0.5 * sum.mass * node.start.norm_squared();
        energy.kinetic_grid_end += 0.5 * sum.mass * node.end.norm_squared();
        if sum.mass > lightest {
            let way = (node.start + node.end) * (0.5 * dt);
            energy.external += sum.external_force.dot(&way);
            energy.internal -= sum.internal_force.dot(&way);
        }
    }
    energy
}
