//! A body force that belongs to the particles, as the field on the nodes that a scene takes.

use std::sync::atomic::{AtomicU64, Ordering};

use fissure::prelude::*;

/// Body force per mass at the nodes of a grid, m/s²: the mean of the particles about each, weighed by
/// mass and linear functions; linear in time between the start of a step and its end.
pub(super) struct NodalForce {
    origin: Vector2<f64>,
    spacing: f64,
    /// Nodes along each axis.
    counts: [usize; 2],
    /// Start and end of the step, s. As bits, like the values: threads read while no one writes.
    times: [AtomicU64; 2],
    /// Both components by node, at either time.
    values: [Vec<[AtomicU64; 2]>; 2],
}

fn read(bits: &AtomicU64) -> f64 {
    f64::from_bits(bits.load(Ordering::Relaxed))
}

fn write(bits: &AtomicU64, value: f64) {
    bits.store(value.to_bits(), Ordering::Relaxed);
}

impl NodalForce {
    /// None anywhere.
    pub(super) fn new(grid: &Grid<2>) -> Self {
        let counts = grid.cells().map(|cells| cells as usize + 1);
        let none = || {
            let mut values = Vec::new();
            values.resize_with(counts[0] * counts[1], Default::default);
            values
        };
        Self {
            origin: grid.origin(),
            spacing: grid.spacing(),
            counts,
            times: Default::default(),
            values: [none(), none()],
        }
    }

    /// The force at a node and a time of the step; none off the grid.
    pub(super) fn at(&self, node: &Vector2<f64>, time: f64) -> Vector2<f64> {
        let place = (node - self.origin) / self.spacing;
        let [i, j] = [place.x.round(), place.y.round()];
        let on_grid =
            (0.0..self.counts[0] as f64).contains(&i) && (0.0..self.counts[1] as f64).contains(&j);
        if !on_grid {
            return Vector2::zeros();
        }
        let [start, end] = self.times.each_ref().map(read);
        let ends = self.values.each_ref().map(|values| {
            let bits = &values[i as usize + self.counts[0] * j as usize];
            Vector2::from_fn(|axis, _| read(&bits[axis]))
        });
        if time <= start {
            return ends[0];
        }
        ends[0].lerp(&ends[1], (time - start) / (end - start))
    }

    /// Takes the forces per mass of the first body's particles, by id, for a step between two times.
    pub(super) fn update(
        &self,
        scene: &Scene<2>,
        times: [f64; 2],
        force: impl Fn(usize, f64) -> Vector2<f64>,
    ) {
        for (at, time) in times.into_iter().enumerate() {
            write(&self.times[at], time);
            self.take(at, scene, |id| force(id, time));
        }
    }

    fn take(&self, at: usize, scene: &Scene<2>, force: impl Fn(usize) -> Vector2<f64>) {
        let body = &scene.bodies()[0];
        let particles = body.particles();
        let mut sums = vec![(0.0, Vector2::zeros()); self.values[at].len()];
        for (row, id) in particles.id.iter().enumerate() {
            let place = (body.motion().position[row] - self.origin) / self.spacing;
            let force = force(id.0 as usize);
            let cell = place.map(f64::floor);
            for corner in [[0, 0], [1, 0], [0, 1], [1, 1]] {
                let node = cell + Vector2::from_fn(|axis, _| f64::from(corner[axis]));
                let away = place - node;
                let weight = particles.mass[row] * (1.0 - away.x.abs()) * (1.0 - away.y.abs());
                let index = node.x as usize + self.counts[0] * node.y as usize;
                if let Some(sum) = sums.get_mut(index) {
                    sum.0 += weight;
                    sum.1 += force * weight;
                }
            }
        }
        // Wider functions reach nodes beyond: those take the mean of their neighbours, twice.
        let first = self.spread(&sums);
        for (value, (weight, sum)) in self.values[at].iter().zip(self.spread(&first)) {
            let mean: Vector2<f64> = if weight > 0.0 {
                sum / weight
            } else {
                Vector2::zeros()
            };
            for axis in 0..2 {
                write(&value[axis], mean[axis]);
            }
        }
    }

    /// Gives nodes without a sum the mean of those about them that have one.
    fn spread(&self, sums: &[(f64, Vector2<f64>)]) -> Vec<(f64, Vector2<f64>)> {
        let [width, height] = self.counts;
        let at = |index: usize| {
            let (i, j) = (index % width, index / width);
            let rows = j.saturating_sub(1)..(j + 2).min(height);
            let cells = rows.flat_map(move |j| {
                let columns = i.saturating_sub(1)..(i + 2).min(width);
                columns.map(move |i| i + width * j)
            });
            cells
                .filter(|&near| sums[near].0 > 0.0)
                .fold((0.0, Vector2::zeros()), |(count, sum), near| {
                    (count + 1.0, sum + sums[near].1 / sums[near].0)
                })
        };
        let filled = sums
            .iter()
            .enumerate()
            .map(|(index, sum)| match sum.0 > 0.0 {
                true => *sum,
                false => at(index),
            });
        filled.collect()
    }
}
