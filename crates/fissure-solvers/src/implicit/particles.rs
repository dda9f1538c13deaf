//! What a balanced step does to the velocities of particles, and the accelerations that they carry.

use fissure_grid::Shape;
use fissure_particles::ParticleId;
use fissure_scene::Scene;
use nalgebra::SVector;

use super::newton::Attempt;
use crate::equilibrium::links::{Links, Member, Patch};

/// Accelerations that particles carry from step to step with Newmark's scheme and generalised α, m/s²,
/// body by body in the particles' order; none before the first step.
#[derive(Debug, Default)]
pub(super) struct Carried<const D: usize> {
    ids: Vec<Vec<ParticleId>>,
    accelerations: Vec<Vec<SVector<f64, D>>>,
}

impl<const D: usize> Carried<D> {
    pub(super) fn clear(&mut self) {
        self.ids.clear();
        self.accelerations.clear();
    }

    /// Puts them into the particles' present order; forgets them if the particles are others.
    pub(super) fn align(&mut self, scene: &Scene<D>) {
        let bodies = scene.bodies();
        let known = self.accelerations.len() == bodies.len();
        // Recalled ones are in the order of the scene that was restored with them.
        if known && self.ids.is_empty() {
            self.ids = bodies
                .iter()
                .map(|body| body.particles().id.clone())
                .collect();
        }
        let counts = || bodies.iter().zip(&self.accelerations);
        if !known || counts().any(|(body, own)| body.particles().len() != own.len()) {
            self.clear();
            return;
        }
        for (index, body) in bodies.iter().enumerate() {
            let (present, ids) = (&body.particles().id, &mut self.ids[index]);
            if present == ids {
                continue;
            }
            let mut rows: Vec<(ParticleId, usize)> = ids.iter().copied().zip(0..).collect();
            rows.sort_unstable_by_key(|(id, _)| id.0);
            let own = std::mem::take(&mut self.accelerations[index]);
            let found = present.iter().map(|id| {
                let place = rows.binary_search_by_key(&id.0, |(id, _)| id.0).ok()?;
                Some(own[rows[place].1])
            });
            let Some(found) = found.collect() else {
                self.clear();
                return;
            };
            self.accelerations[index] = found;
            ids.clone_from(present);
        }
    }

    /// Their means around every node, by the particles' masses; `None` if they carry none.
    pub(super) fn at_nodes(
        &self,
        links: &Links<D>,
        scene: &Scene<D>,
        masses: &[f64],
    ) -> Option<Vec<SVector<f64, D>>> {
        if self.accelerations.is_empty() {
            return None;
        }
        let mut sums = vec![SVector::zeros(); masses.len()];
        for patch in (0..links.patches()).map(|patch| links.patch(patch)) {
            for member in patch.members {
                let (body, row) = (member.body as usize, member.index as usize);
                let mass = scene.bodies()[body].particles().mass[row];
                let part = self.accelerations[body][row] * mass;
                for (link, &node) in patch.links(member).iter().zip(patch.nodes) {
                    sums[links.active[node as usize] as usize] += part * link.weight;
                }
            }
        }
        for (sum, mass) in sums.iter_mut().zip(masses) {
            if *mass > 0.0 {
                *sum /= *mass;
            }
        }
        Some(sums)
    }

    /// Of every body the number of its particles, then their accelerations.
    pub(super) fn memory(&self) -> impl Iterator<Item = f64> + '_ {
        self.accelerations.iter().flat_map(|own| {
            let numbers = own.iter().flat_map(|a| a.iter().copied());
            std::iter::once(own.len() as f64).chain(numbers)
        })
    }

    /// Takes back what [`memory`](Self::memory) gave.
    pub(super) fn recall(&mut self, mut memory: &[f64]) {
        self.clear();
        while let Some((&count, rest)) = memory.split_first() {
            let length = (count as usize).saturating_mul(D);
            if length > rest.len() {
                self.clear();
                return;
            }
            let (own, rest) = rest.split_at(length);
            let vectors = own.chunks_exact(D).map(SVector::from_column_slice);
            self.accelerations.push(vectors.collect());
            memory = rest;
        }
    }
}

/// What a node's field gained over the step, and what it is at the end.
type Gained<const D: usize> = (SVector<f64, D>, SVector<f64, D>);

impl<S: Shape<D>, const D: usize> Attempt<'_, S, D> {
    /// Gives the particles their trial velocities, and new accelerations if they carry any: their own plus
    /// the nodes' change (FLIP), with the wished share of what the nodes have.
    pub(super) fn move_particles(
        &self,
        scene: &mut Scene<D>,
        links: &Links<D>,
        displacement: &[SVector<f64, D>],
        carried: &mut Carried<D>,
    ) {
        let mut velocities: Vec<Gained<D>> = Vec::with_capacity(links.active.len());
        let mut accelerations: Vec<Gained<D>> = Vec::with_capacity(links.active.len());
        for &node in &links.active {
            let node = node as usize;
            let (start, end) = (&self.starts[node], self.end(node, &displacement[node]));
            velocities.push((end.velocity - start.velocity, end.velocity));
            accelerations.push((end.acceleration - start.acceleration, end.acceleration));
        }
        let carries = self.scheme.carries();
        // Particles that carry nothing yet take what the nodes have.
        let first = carried.accelerations.is_empty();
        for (index, body) in scene.bodies_mut().iter_mut().enumerate() {
            let particles = body.particles_with_trial();
            if carries && first {
                carried.ids.push(particles.id.clone());
                carried
                    .accelerations
                    .push(vec![SVector::zeros(); particles.len()]);
            }
            for patch in (0..links.patches()).map(|patch| links.patch(patch)) {
                for member in patch.members.iter().filter(|m| m.body as usize == index) {
                    let row = member.index as usize;
                    let own = particles.motion.velocity[row];
                    let pic = self.settings.pic;
                    particles.trial.velocity[row] = taken_up(&velocities, own, &patch, member, pic);
                    if carries {
                        let own = &mut carried.accelerations[index][row];
                        let pic = if first { 1.0 } else { pic };
                        *own = taken_up(&accelerations, *own, &patch, member, pic);
                    }
                }
            }
        }
    }
}

/// What a particle makes of its `own` vector and a field of the nodes.
fn taken_up<const D: usize>(
    field: &[Gained<D>],
    own: SVector<f64, D>,
    patch: &Patch<'_, D>,
    member: &Member,
    pic: f64,
) -> SVector<f64, D> {
    let (mut gain, mut mean) = (SVector::zeros(), SVector::zeros());
    for (link, &node) in patch.links(member).iter().zip(patch.nodes) {
        gain += field[node as usize].0 * link.weight;
        mean += field[node as usize].1 * link.weight;
    }
    (own + gain) * (1.0 - pic) + mean * pic
}
