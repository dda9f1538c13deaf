//! What a checkpoint holds of a placement.

use fissure_scene::Run;

use super::Placement;
use crate::groups::Pattern;

/// The lower half of the bits of a label.
const HALF: u64 = 0xffff_ffff;

impl<const D: usize> Placement<D> {
    /// The tiles that the particles are sorted by, as `(particles, coordinates)` of each run, and the
    /// cracks between them and their nodes: they may have moved on since, and a restarted run is to
    /// sum in the same order.
    pub(crate) fn memory(&self) -> Vec<f64> {
        // Below zero, unlike what older checkpoints have in its place.
        let mut memory = vec![self.crack_motion, -f64::from(self.tiles.cells())];
        for (run, &(_, group)) in self.runs.iter().flatten().zip(&self.occupied) {
            let pattern = self.groups.pattern(group).as_deref();
            memory.push(run.len() as f64);
            memory.extend(self.coordinates(run.window).map(f64::from));
            memory.push(pattern.map_or(0, <[u64]>::len) as f64);
            let halves = |&cracks: &u64| [cracks >> 32, cracks & HALF].map(|half| half as f64);
            memory.extend(pattern.into_iter().flatten().flat_map(halves));
        }
        memory
    }

    /// Takes back what [`memory`](Self::memory) gave, for the next [`update`](Self::update).
    pub(crate) fn recall(&mut self, memory: &[f64]) {
        self.homes.clear();
        self.patterns.clear();
        let mut numbers = memory.iter().copied();
        self.crack_motion = numbers.next().unwrap_or(0.0);
        let cells = -numbers.next().unwrap_or(0.0) as i32;
        self.recalled = (cells > 0).then_some(cells);
        self.edits = None;
        if self.recalled.is_none() {
            return;
        }
        while let Some(particles) = numbers.next() {
            let mut next = || numbers.next().unwrap_or(0.0);
            let home = std::array::from_fn(|_| next() as i32);
            let numbers_of_pattern = next() as usize;
            let cracks: Box<[u64]> = (0..numbers_of_pattern)
                .map(|_| (next() as u64) << 32 | next() as u64)
                .collect();
            let pattern: Pattern = (!cracks.is_empty()).then_some(cracks);
            let count = self.homes.len() + (particles as usize).min(Run::MAX);
            self.homes.resize(count, home);
            self.patterns.resize(count, pattern);
        }
        if self.patterns.iter().all(Option::is_none) {
            self.patterns.clear();
        }
    }
}
