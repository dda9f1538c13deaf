//! Where the particles are: sorted by tile, cut into runs.

use fissure_grid::{Grid, Tiles, tile_of};
use fissure_particles::sort_permutation;
use fissure_scene::{Run, Scene, Selection, SolveError};
use nalgebra::SVector;
use rayon::prelude::*;

/// Marks a tile without particles in [`Placement::slots`].
pub(crate) const EMPTY: u32 = u32::MAX;

/// Particles of a scene sorted by tile, and the runs they make.
///
/// Particles keep their order while none leaves its tile, so sorting is stable in both senses and
/// a restarted run, which sorts anew, finds the order it was saved in.
#[derive(Debug)]
pub struct Placement<const D: usize> {
    /// Tiles that hold nodes.
    pub tiles: Tiles<D>,
    /// Runs of each body.
    pub runs: Vec<Vec<Run>>,
    /// For each tile its place among the occupied ones, or [`EMPTY`].
    slots: Vec<u32>,
    /// `(body, run)` pairs, grouped by occupied tile.
    members: Vec<(u32, u32)>,
    /// First member of each occupied tile, and the end.
    offsets: Vec<u32>,
    /// Present indices of the particles that each condition selects.
    selected: Vec<Vec<u32>>,
    edits: Option<u64>,
    /// Whether a particle has left the tile of its run.
    moved: bool,
    keys: Vec<u64>,
    order: Vec<u32>,
    homes: Vec<[i32; D]>,
}

impl<const D: usize> Default for Placement<D> {
    fn default() -> Self {
        Self {
            tiles: Tiles::new(),
            runs: Vec::new(),
            slots: Vec::new(),
            members: Vec::new(),
            offsets: Vec::new(),
            selected: Vec::new(),
            edits: None,
            moved: false,
            keys: Vec::new(),
            order: Vec::new(),
            homes: Vec::new(),
        }
    }
}

impl<const D: usize> Placement<D> {
    /// Whether every particle is in the tile of its run and the scene is the one last seen.
    pub fn is_current(&self, scene: &Scene<D>) -> bool {
        !self.moved && !self.is_edited(scene)
    }

    /// Whether the scene was changed by its user since the last [`update`](Self::update).
    pub fn is_edited(&self, scene: &Scene<D>) -> bool {
        self.edits != Some(scene.edits())
    }

    /// Notes whether a particle has left the tile of its run, after a step.
    pub(crate) fn note_moves(&mut self, grid: &Grid<D>, scene: &Scene<D>) {
        let tiles = &self.tiles;
        self.moved = scene.bodies().iter().zip(&self.runs).any(|(body, runs)| {
            let position = body.motion().position;
            runs.par_iter().with_min_len(16).any(|run| {
                let home = Some(tiles.coordinates(run.tile as usize));
                let particles = &position[run.start as usize..run.end as usize];
                particles.iter().any(|x| grid.cell(x).map(tile_of) != home)
            })
        });
    }

    /// Sorts every body's particles by tile and cuts them into runs.
    ///
    /// # Errors
    /// A particle outside the grid, or columns that do not fit one another.
    pub fn update(&mut self, grid: &Grid<D>, scene: &mut Scene<D>) -> Result<(), SolveError> {
        self.homes.clear();
        for (body, owner) in scene.bodies().iter().enumerate() {
            for (index, x) in owner.motion().position.iter().enumerate() {
                let cell = grid.cell(x).ok_or_else(|| outside(scene, body, index))?;
                self.homes.push(tile_of(cell));
            }
        }
        self.tiles.rebuild(self.homes.iter().copied());
        self.runs.clear();
        let mut first = 0;
        for body in scene.bodies_mut() {
            let count = body.particles().len();
            let homes = &self.homes[first..first + count];
            first += count;
            self.keys.clear();
            let tile_index = |home| self.tiles.find(home).unwrap_or(0) as u64;
            self.keys.extend(homes.iter().map(|&home| tile_index(home)));
            if !self.keys.is_sorted() {
                sort_permutation(&self.keys, &mut self.order);
                body.reorder(&self.order)?;
                self.keys.sort_unstable();
            }
            self.runs.push(cut_into_runs(&self.keys));
        }
        self.index_members();
        self.index_selected(scene);
        self.edits = Some(scene.edits());
        self.moved = false;
        Ok(())
    }

    /// Runs of an occupied tile (by slot) as `(body, run)`.
    pub(crate) fn members(&self, slot: usize) -> impl Iterator<Item = (usize, &Run)> {
        let range = self.offsets[slot] as usize..self.offsets[slot + 1] as usize;
        self.members[range]
            .iter()
            .map(|&(body, run)| (body as usize, &self.runs[body as usize][run as usize]))
    }

    /// The slot of a tile among the occupied ones, or [`EMPTY`].
    pub(crate) fn slot(&self, tile: usize) -> u32 {
        self.slots[tile]
    }

    /// Present indices of the particles that a condition selects in its body.
    pub(crate) fn selected(&self, condition: usize) -> &[u32] {
        &self.selected[condition]
    }

    /// The node of a grid index, if its tile is held.
    pub(crate) fn node(&self, index: [i32; D]) -> Option<usize> {
        let tile = self.tiles.find(tile_of(index))?;
        let local = (0..D)
            .rev()
            .fold(0, |sum, axis| sum * 4 + index[axis].rem_euclid(4) as usize);
        Some(tile * Tiles::<D>::NODES + local)
    }

    fn index_members(&mut self) {
        self.slots.clear();
        self.slots.resize(self.tiles.len(), EMPTY);
        for (slot, &tile) in self.tiles.occupied().iter().enumerate() {
            self.slots[tile as usize] = slot as u32;
        }
        let mut members: Vec<(u32, u32, u32)> = Vec::new();
        for (body, runs) in self.runs.iter().enumerate() {
            let slot = |run: &Run| self.slots[run.tile as usize];
            let entries = runs.iter().enumerate();
            members.extend(entries.map(|(i, run)| (slot(run), body as u32, i as u32)));
        }
        members.sort_unstable();
        self.offsets.clear();
        self.offsets.resize(self.tiles.occupied().len() + 1, 0);
        for &(slot, ..) in &members {
            self.offsets[slot as usize + 1] += 1;
        }
        for slot in 1..self.offsets.len() {
            self.offsets[slot] += self.offsets[slot - 1];
        }
        self.members.clear();
        self.members
            .extend(members.iter().map(|&(_, body, run)| (body, run)));
    }

    fn index_selected(&mut self, scene: &Scene<D>) {
        self.selected.clear();
        for condition in scene.conditions() {
            let Selection::Body { body, ids } = condition.selection() else {
                self.selected.push(Vec::new());
                continue;
            };
            let present = scene.bodies()[*body].particles().id.iter().enumerate();
            let chosen = present.filter(|(_, id)| ids.binary_search(id).is_ok());
            self.selected
                .push(chosen.map(|(index, _)| index as u32).collect());
        }
    }
}

/// The error of a step that a particle outside the grid stops.
pub(crate) fn outside<const D: usize>(scene: &Scene<D>, body: usize, index: usize) -> SolveError {
    let body = &scene.bodies()[body];
    SolveError::Outside {
        body: body.name().to_owned(),
        id: body.particles().id[index],
        position: body.motion().position[index].iter().copied().collect(),
        step: scene.step() + 1,
        time: scene.time(),
    }
}

/// Refuses to step to a time that is not after the present.
pub(crate) fn check_until<const D: usize>(scene: &Scene<D>, until: f64) -> Result<(), SolveError> {
    if until > scene.time() {
        return Ok(());
    }
    Err(SolveError::Setting {
        setting: "until",
        value: until,
        permitted: "after the scene's time",
    })
}

/// Refuses numbers that are not finite, once, before the first step.
pub(crate) fn check_columns<const D: usize>(scene: &Scene<D>) -> Result<(), SolveError> {
    if scene.particle_count() == 0 {
        return Err(SolveError::Empty);
    }
    for body in scene.bodies() {
        let particles = body.particles();
        let motion = &particles.motion;
        for (i, &id) in particles.id.iter().enumerate() {
            let finite = |v: &SVector<f64, D>| v.iter().all(|c| c.is_finite());
            let field = if !finite(&motion.position[i]) {
                "position"
            } else if !finite(&motion.velocity[i]) {
                "velocity"
            } else if !motion.deformation_gradient[i].iter().all(|c| c.is_finite()) {
                "deformation_gradient"
            } else if !motion.stress[i].is_finite() {
                "stress"
            } else if !particles.mass[i].is_finite() {
                "mass"
            } else if !particles.volume[i].is_finite() {
                "volume"
            } else {
                continue;
            };
            return Err(SolveError::NotFinite {
                body: body.name().to_owned(),
                id,
                field,
            });
        }
    }
    Ok(())
}

/// Consecutive equal keys in pieces of at most [`Run::MAX`].
fn cut_into_runs(keys: &[u64]) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut start = 0;
    for group in keys.chunk_by(|a, b| a == b) {
        for piece in group.chunks(Run::MAX) {
            runs.push(Run {
                start: start as u32,
                end: (start + piece.len()) as u32,
                tile: group[0] as u32,
            });
            start += piece.len();
        }
    }
    runs
}
