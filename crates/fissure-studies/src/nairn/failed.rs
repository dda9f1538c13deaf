//! Failed particles at their places of rest, and the groups they form.

use std::collections::HashMap;

use fissure::prelude::*;

/// Places of rest of a body's particles, by id.
#[derive(Clone, Debug)]
pub(super) struct Places<const D: usize> {
    position: HashMap<ParticleId, SVector<f64, D>>,
    spacing: f64,
}

impl<const D: usize> Places<D> {
    /// Of a body that has not moved yet.
    pub(super) fn of(body: &Body<D>) -> Self {
        let particles = body.particles();
        let pairs = particles.id.iter().zip(&particles.motion.position);
        Self {
            position: pairs.map(|(id, x)| (*id, *x)).collect(),
            spacing: 2.0 * body.half_edges().column(0).norm(),
        }
    }

    /// Where a particle rested.
    pub(super) fn at(&self, id: ParticleId) -> Option<SVector<f64, D>> {
        self.position.get(&id).copied()
    }

    /// Places of rest of the failed particles, in the order of their ids.
    pub(super) fn failed(&self, body: &Body<D>) -> Vec<SVector<f64, D>> {
        let failed = body.value("failed").unwrap_or_default();
        let pairs = body.particles().id.iter().zip(failed);
        let mut ids: Vec<ParticleId> = pairs
            .filter(|(_, failed)| *failed > 0.5)
            .map(|(id, _)| *id)
            .collect();
        ids.sort_unstable();
        ids.into_iter().filter_map(|id| self.at(id)).collect()
    }

    /// The connected groups among `points`: particles that touch at rest, corners included.
    pub(super) fn groups(&self, points: &[SVector<f64, D>]) -> Vec<Vec<SVector<f64, D>>> {
        let cell = |x: &SVector<f64, D>| -> SVector<i64, D> {
            x.map(|x| (x / self.spacing).floor() as i64)
        };
        let mut left: HashMap<Vec<i64>, Vec<usize>> = HashMap::new();
        for (i, x) in points.iter().enumerate() {
            let key = cell(x).iter().copied().collect();
            left.entry(key).or_default().push(i);
        }
        let mut seen = vec![false; points.len()];
        let mut groups = Vec::new();
        for start in 0..points.len() {
            if seen[start] {
                continue;
            }
            seen[start] = true;
            let (mut group, mut queue) = (Vec::new(), vec![start]);
            while let Some(i) = queue.pop() {
                group.push(points[i]);
                let here = cell(&points[i]);
                for offset in 0..3_i64.pow(D as u32) {
                    let key: Vec<i64> = (0..D)
                        .map(|axis| here[axis] + offset / 3_i64.pow(axis as u32) % 3 - 1)
                        .collect();
                    for &j in left.get(&key).into_iter().flatten() {
                        if !seen[j] {
                            seen[j] = true;
                            queue.push(j);
                        }
                    }
                }
            }
            groups.push(group);
        }
        groups
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    #[test]
    fn groups_are_joined_at_corners_and_told_apart_by_a_row() {
        let places = Places::<2> {
            position: HashMap::new(),
            spacing: 0.5,
        };
        let points: Vec<Vector2<f64>> = [[0.25, 0.25], [0.75, 0.75], [1.75, 0.75], [1.75, 1.25]]
            .map(Vector2::from)
            .to_vec();
        let groups = places.groups(&points);
        let sizes: Vec<usize> = groups.iter().map(Vec::len).collect();
        assert_eq!(sizes, [2, 2]);
    }
}
