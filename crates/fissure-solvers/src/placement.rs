//! Where the particles are: sorted by tile, cut into runs.

use fissure_grid::{Grid, Tiles, tile_of};
use fissure_particles::sort_permutation;
use fissure_scene::{Run, Scene, Selection, SolveError};
use nalgebra::SVector;
use rayon::prelude::*;

/// Most colours of tiles, those of space.
const COLOURS: usize = 8;

/// Particles of a scene sorted by tile, and the runs they make.
///
/// Tiles have 2^D colours, like a chessboard's two: the windows of tiles of one colour do not
/// overlap. Particles are sorted by colour first, so that a pass can take one colour after another.
///
/// Sorting is stable, and particles keep their order until one leaves the window of the tile it
/// was sorted by (explicit solver) or that tile (quasi-static solver).
#[derive(Debug)]
pub struct Placement<const D: usize> {
    /// Tiles that hold nodes.
    pub tiles: Tiles<D>,
    /// Runs of each body.
    pub runs: Vec<Vec<Run>>,
    /// Of each body, where the runs of each colour begin, and the end.
    colours: Vec<[usize; COLOURS + 1]>,
    /// Present indices of the particles that each condition selects.
    selected: Vec<Vec<u32>>,
    edits: Option<u64>,
    /// Whether a particle has left the tile of its run.
    moved: bool,
    keys: Vec<u64>,
    order: Vec<u32>,
    homes: Vec<[i32; D]>,
    /// Whether `homes` were recalled from a checkpoint.
    recalled: bool,
}

impl<const D: usize> Default for Placement<D> {
    fn default() -> Self {
        Self {
            tiles: Tiles::new(),
            runs: Vec::new(),
            colours: Vec::new(),
            selected: Vec::new(),
            edits: None,
            moved: false,
            keys: Vec::new(),
            order: Vec::new(),
            homes: Vec::new(),
            recalled: false,
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
    #[cfg(feature = "implicit")]
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
        self.find_homes(grid, scene)?;
        self.tiles.rebuild(self.homes.iter().copied());
        self.runs.clear();
        self.colours.clear();
        let mut first = 0;
        for body in scene.bodies_mut() {
            let count = body.particles().len();
            let homes = &self.homes[first..first + count];
            first += count;
            self.keys.clear();
            let tile_index = |home| self.tiles.find(home).unwrap_or(0) as u64;
            let key = |&home| colour(home) << 32 | tile_index(home);
            self.keys.extend(homes.iter().map(key));
            if !self.keys.is_sorted() {
                sort_permutation(&self.keys, &mut self.order);
                body.reorder(&self.order)?;
                self.keys.sort_unstable();
            }
            self.runs.push(cut_into_runs(&self.keys));
            let first_key = |colour: usize| (colour as u64) << 32;
            let run_key = |run: &Run| self.keys[run.start as usize];
            let runs = self.runs.last().map_or(&[][..], |runs| runs);
            self.colours.push(std::array::from_fn(|colour| {
                runs.partition_point(|run| run_key(run) < first_key(colour))
            }));
        }
        self.index_selected(scene);
        self.edits = Some(scene.edits());
        self.moved = false;
        Ok(())
    }

    /// The tile that every particle is sorted by: the one it is in, or the recalled one.
    fn find_homes(&mut self, grid: &Grid<D>, scene: &Scene<D>) -> Result<(), SolveError> {
        if std::mem::take(&mut self.recalled) && self.homes.len() == scene.particle_count() {
            return Ok(());
        }
        self.homes.clear();
        for (body, owner) in scene.bodies().iter().enumerate() {
            for (index, x) in owner.motion().position.iter().enumerate() {
                let cell = grid.cell(x).ok_or_else(|| outside(scene, body, index))?;
                self.homes.push(tile_of(cell));
            }
        }
        Ok(())
    }

    /// The tiles that the particles are sorted by, as `(particles, coordinates)` of each run: they
    /// may have moved on since, and a restarted run is to sum in the same order.
    pub(crate) fn memory(&self) -> Vec<f64> {
        let mut memory = Vec::new();
        for run in self.runs.iter().flatten() {
            memory.push(run.len() as f64);
            let coordinates = self.tiles.coordinates(run.tile as usize);
            memory.extend(coordinates.map(f64::from));
        }
        memory
    }

    /// Takes back what [`memory`](Self::memory) gave, for the next [`update`](Self::update).
    pub(crate) fn recall(&mut self, memory: &[f64]) {
        self.homes.clear();
        for run in memory.chunks_exact(1 + D) {
            let home = std::array::from_fn(|axis| run[1 + axis] as i32);
            let count = self.homes.len() + (run[0] as usize).min(Run::MAX);
            self.homes.resize(count, home);
        }
        self.recalled = !self.homes.is_empty();
        self.edits = None;
    }

    /// Runs of a body in the tiles of one colour: tiles whose windows do not overlap.
    pub(crate) fn runs_of_colour(&self, body: usize, colour: usize) -> &[Run] {
        let bounds = &self.colours[body];
        &self.runs[body][bounds[colour]..bounds[colour + 1]]
    }

    /// The tile whose runs hold a particle, by its present index.
    pub(crate) fn tile_of_row(&self, body: usize, row: u32) -> Option<usize> {
        let runs = &self.runs[body];
        let run = runs.partition_point(|run| run.end <= row);
        runs.get(run).map(|run| run.tile as usize)
    }

    /// Takes the scene as it is after a step for known.
    pub(crate) fn accept(&mut self, scene: &Scene<D>) {
        self.edits = Some(scene.edits());
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

/// Colour of a tile: whether each of its coordinates is odd.
fn colour<const D: usize>(tile: [i32; D]) -> u64 {
    let odd = |axis: usize| ((tile[axis] & 1) as u64) << axis;
    (0..D).map(odd).sum()
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
                tile: (group[0] & u64::from(u32::MAX)) as u32,
            });
            start += piece.len();
        }
    }
    runs
}
