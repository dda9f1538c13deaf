//! Nodes are accelerated and held.

use fissure_grid::FIELD;
use fissure_scene::{Report, Scene, StepEnergy};
use nalgebra::SVector;
use rayon::prelude::*;

use super::contact::{Gap, Meetings};
use crate::constraints::Constraints;
use crate::loads::Loads;
use crate::nodes::{Field, NodeSums, element, vector};

/// Nodal velocities of a step, m/s.
#[derive(Debug, Default)]
pub(crate) struct Nodes {
    /// At its end.
    pub end: Field,
    /// At the end of the step before, for steps in place.
    pub before: Field,
    /// What the particles' velocities take up, where that is not `end`.
    pub carried: Field,
    /// What strains the particles, where that is not `end`.
    pub straining: Field,
    /// Internal forces that accelerated the nodes, N, where they are asked for after the sums are made anew.
    pub forces: Field,
    /// Energies of some nodes each, kept for their allocation.
    energies: Vec<StepEnergy>,
    /// Works of the internal forces of some nodes each, likewise.
    pub works: Vec<f64>,
}

/// What the nodes are given to move by.
pub(crate) struct NodeForces<'a, const D: usize> {
    pub sums: &'a NodeSums<D>,
    pub loads: &'a Loads<'a, D>,
    pub constraints: &'a Constraints<D>,
    pub meetings: &'a Meetings<D>,
    /// Mass below which a node feels no force, kg.
    pub lightest: f64,
    pub dt: f64,
}

impl<const D: usize> NodeForces<'_, D> {
    /// Accelerates the nodes over `dt`, applies the held velocities and books forces and
    /// energies. With `gains` the change of velocity is kept in `carried`.
    pub(crate) fn update(&self, nodes: &mut Nodes, scene: &Scene<D>, gains: bool) -> Report<D> {
        let (sums, dt) = (self.sums, self.dt);
        nodes.end.resize(sums.len(), Default::default());
        each_node(&mut nodes.end, |node, end| {
            let mass = sums.mass(node);
            let mut velocity = sums.velocity(node);
            if mass > self.lightest {
                let force = sums.internal_force(node) + self.loads.at(node, mass);
                velocity += force * (dt / mass);
            }
            *end = element(&velocity, mass > 0.0);
        });
        let impulses = self
            .meetings
            .part(sums, &mut nodes.end, dt, Gap::Start, true);
        let mut energy = StepEnergy::default();
        let mut reactions = vec![SVector::zeros(); scene.conditions().len()];
        for held in &self.constraints.held {
            let end = &mut nodes.end[held.node];
            let mass = sums.mass(held.node);
            let free = vector(end);
            let velocity = held.apply(&free);
            *end = element(&velocity, mass > 0.0);
            let mean = (sums.velocity(held.node) + velocity) * 0.5;
            let force = (velocity - free) * (mass / dt);
            energy.external += force.dot(&mean) * dt;
            for (condition, reaction) in held.reactions(&force) {
                reactions[condition] += reaction;
            }
        }
        self.book_energy(&nodes.end, &mut nodes.energies, &mut energy);
        let [contact, glued] = self.meetings.energy(sums, &nodes.end, &impulses);
        energy.contact = contact;
        energy.internal += glued;
        if gains {
            nodes.carried.resize(sums.len(), Default::default());
            let end = &nodes.end;
            each_node(&mut nodes.carried, |node, carried| {
                let gain = vector(&end[node]) - sums.velocity(node);
                *carried = element(&gain, true);
            });
        }
        Report {
            step: scene.step() + 1,
            time: scene.time() + dt,
            dt,
            energy,
            reactions,
            contact_forces: self.meetings.forces(scene, &impulses, dt),
            ..Report::default()
        }
    }

    fn book_energy(&self, end: &Field, parts: &mut Vec<StepEnergy>, energy: &mut StepEnergy) {
        parts.resize(end.len().div_ceil(CHUNK), StepEnergy::default());
        let chunks = end.par_chunks(CHUNK).enumerate();
        chunks
            .zip(parts.par_iter_mut())
            .for_each(|((chunk, end), part)| {
                *part = self.chunk_energy(chunk * CHUNK, end);
            });
        // In order, whatever the threads did.
        for part in parts {
            energy.external += part.external;
            energy.internal += part.internal;
            energy.kinetic_grid_start += part.kinetic_grid_start;
            energy.kinetic_grid_end += part.kinetic_grid_end;
        }
    }

    fn chunk_energy(&self, first: usize, end: &[[f64; FIELD]]) -> StepEnergy {
        let mut energy = StepEnergy::default();
        for (node, end) in (first..).zip(end) {
            let mass = self.sums.mass(node);
            if mass > 0.0 {
                let end: SVector<f64, D> = vector(end);
                let start = self.sums.velocity(node);
                energy.kinetic_grid_start += 0.5 * mass * start.norm_squared();
                energy.kinetic_grid_end += 0.5 * mass * end.norm_squared();
                if mass > self.lightest {
                    let way = (start + end) * (0.5 * self.dt);
                    energy.external += self.loads.at(node, mass).dot(&way);
                    energy.internal -= self.sums.internal_force(node).dot(&way);
                }
            }
        }
        energy
    }
}

/// Nodes that a thread works on at a time.
pub(super) const CHUNK: usize = 2048;

/// Calls `work` with the number and the element of every node.
pub(crate) fn each_node<T: Send>(elements: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
    elements
        .par_chunks_mut(CHUNK)
        .enumerate()
        .for_each(|(chunk, elements)| {
            for (node, element) in (chunk * CHUNK..).zip(elements) {
                work(node, element);
            }
        });
}
