//! Where the particles are: sorted by tile, cut into runs, and the nodes they reach.

mod memory;

use std::sync::Arc;

use fissure_grid::{Grid, Patches, Shape, TileSize, Tiles, Window, tile_of};
use fissure_particles::sort_permutation;
use fissure_scene::{Run, Scene, Selection, SolveError};
use nalgebra::SVector;
#[cfg(feature = "implicit")]
use rayon::prelude::*;

use crate::checks::outside;
use crate::crack_motion::vertices;
use crate::groups::{Between, Groups, Pattern};
use crate::splits::{SplitWindow, Splits};
use crate::window::WindowNodes;

/// How far cracks may move, in cells, before particles are sorted by them anew.
pub(crate) const CRACKS_MOVE: f64 = 0.05;

/// Consecutive runs of a body in tiles of one colour and of one group: windows that do not overlap.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Batch {
    pub body: usize,
    pub runs: std::ops::Range<usize>,
}

/// Particles of a scene sorted by tile, and the runs they make.
///
/// Tiles have 2^D colours, like a chessboard's two: the windows of tiles of one colour do not
/// overlap. Particles are sorted by colour first, so that a pass can take one colour after another.
/// Within a colour they are sorted by group (see `splits.rs`): windows of one tile but of two groups
/// overlap too.
///
/// On a mesh its patches stand for tiles, with colours of their own and a list of nodes each; all
/// nodes of the mesh are held.
///
/// Sorting is stable, and particles keep their order until one leaves the window of the tile it
/// was sorted by (explicit solver) or that tile (quasi-static solver).
#[derive(Debug)]
pub struct Placement<const D: usize> {
    /// Tiles that hold nodes; none on a mesh.
    pub tiles: Tiles<D>,
    /// The mesh, if that is what holds the nodes.
    patches: Option<Arc<Patches<D>>>,
    /// Runs of each body.
    pub runs: Vec<Vec<Run>>,
    /// All runs in the order in which a pass takes them.
    batches: Vec<Batch>,
    /// Nodes with more than one field.
    pub(crate) splits: Splits,
    /// Present indices of the particles that each condition selects.
    selected: Vec<Vec<u32>>,
    edits: Option<u64>,
    /// Of each crack of the scene last seen how many vertices it had.
    crack_vertices: Vec<usize>,
    /// Whether a particle has left the tile of its run.
    moved: bool,
    /// Tile of each particle, while they are sorted and once recalled.
    homes: Vec<[i32; D]>,
    /// Of each particle the cracks between it and its window's nodes, while groups are formed.
    patterns: Vec<Pattern>,
    groups: Groups,
    /// Tile and group of every run.
    occupied: Vec<(u32, u32)>,
    /// How far the cracks have moved since the patterns were found, m.
    crack_motion: f64,
    /// Cells along an axis of the tiles in `homes` that were recalled from a checkpoint.
    recalled: Option<i32>,
}

impl<const D: usize> Default for Placement<D> {
    fn default() -> Self {
        Self {
            tiles: Tiles::new(),
            patches: None,
            runs: Vec::new(),
            batches: Vec::new(),
            splits: Splits::default(),
            selected: Vec::new(),
            edits: None,
            crack_vertices: Vec::new(),
            moved: false,
            homes: Vec::new(),
            patterns: Vec::new(),
            groups: Groups::default(),
            occupied: Vec::new(),
            crack_motion: 0.0,
            recalled: None,
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
    pub(crate) fn note_moves<S: Shape<D>>(&mut self, grid: &Grid<D>, shape: &S, scene: &Scene<D>) {
        self.moved = scene.bodies().iter().zip(&self.runs).any(|(body, runs)| {
            let position = body.motion().position;
            let cells = self.tiles.cells();
            runs.par_iter().with_min_len(16).any(|run| {
                let home = Some(self.coordinates(run.window));
                let particles = &position[run.start as usize..run.end as usize];
                particles.iter().any(|x| shape.home(grid, x, cells) != home)
            })
        });
    }

    /// Sorts every body's particles by tile and cuts them into runs.
    ///
    /// # Errors
    /// A particle outside the grid, or columns that do not fit one another.
    pub fn update<S: Shape<D>>(
        &mut self,
        grid: &Grid<D>,
        shape: &S,
        scene: &mut Scene<D>,
    ) -> Result<(), SolveError> {
        let size = tile_size(scene);
        self.find_homes(grid, shape, scene, size)?;
        self.patches = shape.patches().cloned();
        match self.patches {
            Some(_) => self.tiles.rebuild(size, std::iter::empty()),
            None => self.tiles.rebuild(size, self.homes.iter().copied()),
        }
        self.runs.clear();
        let fields: Vec<u32> = (0..scene.bodies().len())
            .map(|body| scene.velocity_field(body) as u32)
            .collect();
        self.form_groups(scene, &fields);
        let mut batches: Vec<(u64, Batch)> = Vec::new();
        let mut occupied = std::mem::take(&mut self.occupied);
        occupied.clear();
        let mut first = 0;
        let (mut keys, mut order) = (Vec::new(), Vec::new());
        for (index, body) in scene.bodies_mut().iter_mut().enumerate() {
            let count = body.particles().len();
            let homes = &self.homes[first..first + count];
            keys.clear();
            let tile_index = |home: [i32; D]| match self.patches {
                Some(_) => home[0] as u64,
                None => self.tiles.find(home).unwrap_or(0) as u64,
            };
            let colour = |home: [i32; D]| match &self.patches {
                Some(patches) => u64::from(patches.colour_of(home[0] as usize)),
                None => colour(home),
            };
            let plain = u64::from(self.groups.find(fields[index], &None));
            let patterns = self.patterns.get(first..first + count);
            let group = |row: usize| match patterns {
                Some(patterns) => u64::from(self.groups.find(fields[index], &patterns[row])),
                None => plain,
            };
            let key = |(row, &home)| colour(home) << 56 | group(row) << 32 | tile_index(home);
            keys.extend(homes.iter().enumerate().map(key));
            first += count;
            if !keys.is_sorted() {
                sort_permutation(&keys, &mut order);
                body.reorder(&order)?;
                keys.sort_unstable();
            }
            let runs = cut_into_runs(&keys);
            let key_of = |run: &Run| keys[run.start as usize];
            let mut start = 0;
            for batch in runs.chunk_by(|a, b| key_of(a) >> 32 == key_of(b) >> 32) {
                let end = start + batch.len();
                let runs = start..end;
                batches.push((key_of(&batch[0]) >> 56, Batch { body: index, runs }));
                start = end;
            }
            occupied.extend(runs.iter().map(|run| (run.window, group_of(key_of(run)))));
            self.runs.push(runs);
        }
        // Stable: bodies in their order, and their groups.
        batches.sort_by_key(|(colour, _)| *colour);
        self.batches.clear();
        self.batches
            .extend(batches.into_iter().map(|(_, batch)| batch));
        self.occupied = occupied;
        // The groups hold each once, the runs the tiles.
        self.patterns = Vec::new();
        self.homes = Vec::new();
        self.split();
        self.crack_vertices = vertices(scene).collect();
        self.index_selected(scene);
        self.edits = Some(scene.edits());
        self.moved = false;
        Ok(())
    }

    /// Of each crack how many vertices it had when this scene was last seen; none of another scene.
    pub(crate) fn crack_vertices(&self, scene: &Scene<D>) -> &[usize] {
        let same = self.edits.map(|edits| edits >> 32) == Some(scene.edits() >> 32);
        if same { &self.crack_vertices } else { &[] }
    }

    fn form_groups(&mut self, scene: &Scene<D>, fields: &[u32]) {
        let mut all: Vec<(u32, &Pattern)> = fields.iter().map(|&field| (field, &None)).collect();
        if !self.patterns.is_empty() {
            let bodies = scene.bodies().iter().zip(fields);
            let of_particles = bodies
                .flat_map(|(body, &field)| std::iter::repeat_n(field, body.particles().len()));
            let split = of_particles
                .zip(&self.patterns)
                .filter(|(_, pattern)| pattern.is_some());
            all.extend(split);
        }
        self.groups = Groups::of(all);
    }

    /// Notes that the cracks have moved, by at most `way`, m.
    pub(crate) fn note_crack_motion(&mut self, way: f64) {
        self.crack_motion += way;
    }

    /// Whether cracks have moved so far that particles are to be sorted by them anew.
    pub(crate) fn cracks_have_moved(&self, grid: &Grid<D>) -> bool {
        !(self.crack_motion <= CRACKS_MOVE * grid.spacing())
    }

    /// The tile of this size that every particle is sorted by: the one it is in, or the recalled one.
    fn find_homes<S: Shape<D>>(
        &mut self,
        grid: &Grid<D>,
        shape: &S,
        scene: &Scene<D>,
        size: TileSize,
    ) -> Result<(), SolveError> {
        let cells = size.cells::<D>();
        let known = |home: &[i32; D]| {
            let patches = shape.patches();
            patches.is_none_or(|patches| (0..patches.len()).contains(&(home[0] as usize)))
        };
        let recalled = self.recalled.take() == Some(cells)
            && !self.cracks_have_moved(grid)
            && self.homes.iter().all(known);
        if recalled && self.homes.len() == scene.particle_count() {
            return Ok(());
        }
        self.homes.clear();
        self.patterns.clear();
        self.crack_motion = 0.0;
        let mut between = Between::new(grid, scene)?;
        for (body, owner) in scene.bodies().iter().enumerate() {
            for (index, x) in owner.motion().position.iter().enumerate() {
                let home = shape.home(grid, x, cells);
                let home = home.ok_or_else(|| outside(scene, body, index))?;
                self.homes.push(home);
                if !scene.cracks().is_empty() {
                    let window = Window::of_tile(home, cells);
                    self.patterns.push(between.pattern(&window, x));
                }
            }
        }
        Ok(())
    }

    /// Splits nodes where groups meet, and turns the runs' tiles into windows.
    fn split(&mut self) {
        let same = |pair: &[(u32, u32)]| pair[0].1 == pair[1].1;
        if self.occupied.windows(2).all(same) {
            self.splits = Splits::default();
            return;
        }
        let mut occupied = self.occupied.clone();
        occupied.sort_unstable();
        occupied.dedup();
        self.splits.rebuild(&self.tiles, &self.groups, &occupied);
        let plain = self.tiles.len();
        for (run, &(tile, group)) in self.runs.iter_mut().flatten().zip(&self.occupied) {
            if let Some(split) = self.splits.find(tile, group) {
                run.window = (plain + split) as u32;
            }
        }
    }

    /// Sets of runs whose windows do not overlap, one after another, with the body they are of.
    pub(crate) fn batches(&self) -> impl Iterator<Item = (usize, &[Run])> {
        let batches = self.batches.iter();
        batches.map(|batch| (batch.body, &self.runs[batch.body][batch.runs.clone()]))
    }

    /// The window whose runs hold a particle, by its present index.
    pub(crate) fn window_of_row(&self, body: usize, row: u32) -> Option<u32> {
        let runs = &self.runs[body];
        let run = runs.partition_point(|run| run.end <= row);
        runs.get(run).map(|run| run.window)
    }

    /// A window with split nodes.
    pub(crate) fn split_window(&self, window: u32) -> Option<&SplitWindow> {
        let split = (window as usize).checked_sub(self.tiles.len())?;
        self.splits.windows.get(split)
    }

    /// Coordinates of the tile of a window; on a mesh the number of its patch is the first.
    fn coordinates(&self, window: u32) -> [i32; D] {
        if self.patches.is_some() {
            return Window::of_patch(window).first;
        }
        let tile = self.split_window(window).map_or(window, |split| split.tile);
        self.tiles.coordinates(tile as usize)
    }

    /// What stencils of the particles of a window are made for.
    pub(crate) fn window(&self, number: u32) -> Window<D> {
        self.window_of_home(self.coordinates(number))
    }

    /// The window of the tile with these coordinates, or of the patch with this number.
    fn window_of_home(&self, home: [i32; D]) -> Window<D> {
        match self.patches {
            Some(_) => Window::of_patch(home[0] as u32),
            None => Window::of_tile(home, self.tiles.cells()),
        }
    }

    /// The window for a point at `x`, m, that is on the grid or mesh.
    pub(crate) fn window_around<S: Shape<D>>(
        &self,
        grid: &Grid<D>,
        shape: &S,
        x: &SVector<f64, D>,
    ) -> Option<Window<D>> {
        let home = shape.home(grid, x, self.tiles.cells())?;
        Some(self.window_of_home(home))
    }

    /// The nodes of a window.
    pub(crate) fn nodes(&self, window: u32) -> WindowNodes<'_, D> {
        if let Some(patches) = &self.patches {
            return WindowNodes::listed(&self.tiles, patches.window(window as usize));
        }
        match self.split_window(window) {
            Some(split) => WindowNodes::listed(&self.tiles, &split.nodes),
            None => WindowNodes::of_tile(&self.tiles, window as usize),
        }
    }

    /// Number of nodes, those of further fields included.
    pub(crate) fn node_count(&self) -> usize {
        match &self.patches {
            Some(patches) => patches.nodes().len(),
            None => self.tiles.node_count() + self.splits.origins.len(),
        }
    }

    /// Position of a node, m.
    pub(crate) fn node_position(&self, grid: &Grid<D>, node: usize) -> SVector<f64, D> {
        if let Some(patches) = &self.patches {
            return patches.nodes()[node];
        }
        let further = node.checked_sub(self.tiles.node_count());
        let origin = further.map_or(node, |extra| self.splits.origins[extra] as usize);
        self.tiles.node_position(grid, origin)
    }

    /// Takes the scene as it is after a step for known.
    pub(crate) fn accept(&mut self, scene: &Scene<D>) {
        self.edits = Some(scene.edits());
    }

    /// Present indices of the particles that a condition selects in its body.
    pub(crate) fn selected(&self, condition: usize) -> &[u32] {
        &self.selected[condition]
    }

    /// The node of a grid index, if its tile is held; of several fields the first.
    pub(crate) fn node(&self, index: [i32; D]) -> Option<usize> {
        let cells = self.tiles.cells();
        let tile = self.tiles.find(tile_of(index, cells))?;
        let local = (0..D)
            .rev()
            .fold(0, |sum, axis| sum * cells + index[axis].rem_euclid(cells));
        Some(tile * self.tiles.nodes_each() + local as usize)
    }

    /// Calls `visit` with the node of a window's entry, if that is held, and those of its further fields.
    pub(crate) fn each_field(
        &self,
        window: &Window<D>,
        entry: usize,
        mut visit: impl FnMut(usize),
    ) {
        if let Some(patches) = &self.patches {
            return visit(patches.window(window.first[0] as usize)[entry] as usize);
        }
        let Some(node) = self.node(window.node(entry)) else {
            return;
        };
        visit(node);
        for copy in self.splits.copies_of(node).skip(1) {
            visit(self.splits.copies[copy].node as usize);
        }
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

/// Cracks split windows near their tips into many, which are to be small.
fn tile_size<const D: usize>(scene: &Scene<D>) -> TileSize {
    if scene.cracks().is_empty() {
        TileSize::Wide
    } else {
        TileSize::Narrow
    }
}

/// Colour of a tile: whether each of its coordinates is odd.
fn colour<const D: usize>(tile: [i32; D]) -> u64 {
    let odd = |axis: usize| ((tile[axis] & 1) as u64) << axis;
    (0..D).map(odd).sum()
}

/// The group in a key.
fn group_of(key: u64) -> u32 {
    (key >> 32) as u32 & 0xff_ffff
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
                window: (group[0] & u64::from(u32::MAX)) as u32,
            });
            start += piece.len();
        }
    }
    runs
}
