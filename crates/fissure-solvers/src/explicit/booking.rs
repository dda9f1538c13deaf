//! The work that strains the particles, and how far velocities are from the time of the stresses.
//!
//! A step strains with velocities `v` that need not be those which its forces act on: with the stress first they are those
//! it starts from, `v_s`, with the stress last those it ends with, `v_e`, with MUSL those which the moved particles have
//! given back. With the internal forces `f⁻` and `f⁺` of the stresses before and after the law, on the nodes of this step,
//!
//! ```text
//! internal    W = −½ Δt Σ (f⁻ + f⁺)·v                                                                (1)
//! staggering  S = −½ Δt Σ f·(v_s + v_e) − W                                                          (2)
//! half step   B = −½ Δt Σ f⁺·v_e  (stress first),   ½ Δt Σ f⁺·v  (last, MUSL)                        (3)
//! ```
//!
//! with the forces `f` that accelerated the nodes: `f⁺` with the stress first, else `f⁻`. `W` is what the laws take up,
//! but for a part of second order in the step and one of first order times the strain. Stresses are at times between those of the velocities; the kinetic energy at theirs is
//! `K + B`, and that is what particles and grid exchange: what they lose is
//! `Σ (K + B)` before less after a transfer. If they lose nothing, `S` is the change of `B` in the step, and `K + B + ψ` of a
//! linear body is constant to round-off (the energy of the leapfrog scheme). A stress that rings at the scale of the grid
//! gives the nodes `½ f² Δt²/m` in every step, which the transfer takes away again: with `K` alone both would be booked.
//!
//! Half of (1) is a sum over the nodes. The other one, of the stresses for which no nodal forces are summed in the step, is
//! one over the particles (`SweepTotals::work`).

use fissure_scene::SweepTotals;
use nalgebra::SVector;
use rayon::prelude::*;

use super::grid_update::{CHUNK, Nodes, each_node};
use super::settings::StressUpdate;
use crate::nodes::{Field, MASSIVE, NodeSums, element, vector};

/// The works (1) and (3) of a step, J.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Booking {
    pub internal: f64,
    pub half_step: f64,
}

impl Booking {
    /// What is known when the nodes have been accelerated; `totals` are those of a sweep before that.
    pub(super) fn accelerated<const D: usize>(
        update: StressUpdate,
        sums: &NodeSums<D>,
        nodes: &mut Nodes,
        totals: &SweepTotals,
        dt: f64,
    ) -> Self {
        let force = |node| sums.internal_force(node);
        match update {
            StressUpdate::First => Self {
                internal: 0.5 * (totals.work + work(force, &nodes.straining, dt, &mut nodes.works)),
                half_step: 0.5 * work(force, &nodes.end, dt, &mut nodes.works),
            },
            StressUpdate::Last => Self {
                internal: 0.5 * work(force, &nodes.end, dt, &mut nodes.works),
                half_step: 0.0,
            },
            // What strains is found with other sums.
            StressUpdate::Musl => {
                nodes.forces.resize(sums.len(), Default::default());
                each_node(&mut nodes.forces, |node, force| {
                    *force = element(&sums.internal_force(node), true);
                });
                Self::default()
            }
        }
    }

    /// Adds what a sweep after that has told.
    pub(super) fn strained<const D: usize>(
        &mut self,
        update: StressUpdate,
        nodes: &mut Nodes,
        totals: &SweepTotals,
        dt: f64,
    ) {
        if update == StressUpdate::Musl {
            let Nodes {
                forces,
                works,
                straining,
                ..
            } = nodes;
            let force = |node: usize| vector::<D>(&forces[node]);
            self.internal = 0.5 * work(force, straining, dt, works);
        }
        self.internal += 0.5 * totals.work;
        self.half_step = -0.5 * totals.work;
    }
}

/// Work of the nodes' internal forces on a displacement of `dt` times these velocities, J; positive when it is stored.
fn work<const D: usize>(
    force: impl Fn(usize) -> SVector<f64, D> + Sync,
    velocities: &Field,
    dt: f64,
    parts: &mut Vec<f64>,
) -> f64 {
    parts.resize(velocities.len().div_ceil(CHUNK), 0.0);
    let chunks = velocities.par_chunks(CHUNK).enumerate();
    chunks
        .zip(parts.par_iter_mut())
        .for_each(|((chunk, velocities), part)| {
            let nodes = (chunk * CHUNK..).zip(velocities);
            let massive = nodes.filter(|(_, v)| v[MASSIVE] > 0.0);
            *part = massive.fold(0.0, |sum, (node, v)| sum - force(node).dot(&vector(v)) * dt);
        });
    // In order, whatever the threads did.
    parts.iter().sum()
}
