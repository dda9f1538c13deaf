//! From particles to nodes.
//!
//! Every occupied tile sums its particles into a window of its own; every tile of nodes then
//! gathers from the windows around it. Both passes run in parallel and each sum has one order, so
//! the result has the same bits on any number of threads.

use fissure_grid::{Grid, Shape, Stencil, Tiles, window_map};
use fissure_particles::Particles;
use fissure_scene::{Body, Kinematics, Scene};
use fissure_tensor::Sym;
use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use crate::placement::{EMPTY, Placement};

/// What is summed at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeSum<const D: usize> {
    /// Mass, kg.
    pub mass: f64,
    /// Momentum, kg·m/s.
    pub momentum: SVector<f64, D>,
    /// Internal force, N.
    pub internal_force: SVector<f64, D>,
    /// External force, N.
    pub external_force: SVector<f64, D>,
}

impl<const D: usize> Default for NodeSum<D> {
    fn default() -> Self {
        Self {
            mass: 0.0,
            momentum: SVector::zeros(),
            internal_force: SVector::zeros(),
            external_force: SVector::zeros(),
        }
    }
}

impl<const D: usize> NodeSum<D> {
    fn add(&mut self, other: &Self) {
        self.mass += other.mass;
        self.momentum += other.momentum;
        self.internal_force += other.internal_force;
        self.external_force += other.external_force;
    }
}

/// What one particle gives; the stencil spreads it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gift<const D: usize> {
    pub mass: f64,
    pub velocity: SVector<f64, D>,
    /// Velocity gradient of an affine transfer, 1/s.
    pub affine: Option<SMatrix<f64, D, D>>,
    /// What its stress does to the nodes.
    pub stress: Option<StressForce<D>>,
    /// Acceleration by the body force, m/s².
    pub acceleration: SVector<f64, D>,
}

/// The discretisation of a scene: everything a transfer needs besides the particles' numbers.
pub(crate) struct Transfers<'a, S, const D: usize> {
    pub grid: &'a Grid<D>,
    pub shape: &'a S,
    pub placement: &'a Placement<D>,
    pub kinematics: Kinematics,
}

impl<S: Shape<D>, const D: usize> Transfers<'_, S, D> {
    /// Stencil of a particle at the start of the step.
    #[inline]
    pub(crate) fn stencil(
        &self,
        body: &Body<D>,
        tile: [i32; D],
        index: usize,
    ) -> Option<S::Stencil> {
        let motion = &body.particles().motion;
        let f = Body::<D>::in_space(&motion.deformation_gradient[index]);
        let domain = self.shape.domain(body.half_edges(), &f);
        self.shape
            .stencil(self.grid, tile, &motion.position[index], &domain)
    }

    /// Sums what `give` says of every particle to the nodes.
    ///
    /// # Errors
    /// Body and index of the first particle, in the order of tiles, that reaches off the grid.
    pub(crate) fn to_grid(
        &self,
        scene: &Scene<D>,
        sums: &mut Sums<D>,
        give: impl Fn(&Body<D>, usize, &S::Stencil, &NodeLookup<D>) -> Gift<D> + Sync,
    ) -> Result<(), (usize, usize)> {
        let window = window_map::<D>().len();
        let occupied = self.placement.tiles.occupied();
        sums.windows
            .resize(occupied.len() * window, NodeSum::default());
        let failures: Vec<Option<(usize, usize)>> = sums
            .windows
            .par_chunks_mut(window)
            .enumerate()
            .map(|(slot, window)| {
                window.fill(NodeSum::default());
                self.fill_window(scene, slot, window, &give).err()
            })
            .collect();
        if let Some(failure) = failures.into_iter().flatten().next() {
            return Err(failure);
        }
        self.gather_windows(sums);
        Ok(())
    }

    fn fill_window(
        &self,
        scene: &Scene<D>,
        slot: usize,
        window: &mut [NodeSum<D>],
        give: &(impl Fn(&Body<D>, usize, &S::Stencil, &NodeLookup<D>) -> Gift<D> + Sync),
    ) -> Result<(), (usize, usize)> {
        let tile = self.placement.tiles.occupied()[slot] as usize;
        let coordinates = self.placement.tiles.coordinates(tile);
        let lookup = NodeLookup::new(&self.placement.tiles, tile);
        for (body_index, run) in self.placement.members(slot) {
            let body = &scene.bodies()[body_index];
            let particles: &Particles<D> = body.particles();
            for index in run.start as usize..run.end as usize {
                let stencil = self
                    .stencil(body, coordinates, index)
                    .ok_or((body_index, index))?;
                let x = particles.motion.position[index];
                let gift = give(body, index, &stencil, &lookup);
                let momentum = gift.velocity * gift.mass;
                let external = gift.acceleration * gift.mass;
                let lowest = lookup.lowest_node(self.grid);
                let affine = gift.affine.map(|a| a * gift.mass);
                stencil.visit(|entry, weight, gradient| {
                    let node = &mut window[entry];
                    node.mass += weight * gift.mass;
                    node.momentum += momentum * weight;
                    if let Some(affine) = affine {
                        let arm = lookup.node_position(self.grid, lowest, entry) - x;
                        node.momentum += affine * arm * weight;
                    }
                    if let Some(stress) = &gift.stress {
                        node.internal_force -= stress.on_gradient * gradient;
                        node.internal_force[0] -= stress.on_weight * weight;
                    }
                    node.external_force += external * weight;
                });
            }
        }
        Ok(())
    }

    /// Every tile gathers its nodes from the windows of the tiles around it, in their order.
    fn gather_windows(&self, sums: &mut Sums<D>) {
        let tiles = &self.placement.tiles;
        let window = window_map::<D>().len();
        sums.exchange
            .get_or_insert_with(|| exchange_lists(Tiles::<D>::AROUND, window_map::<D>()));
        let (windows, exchange) = (&sums.windows, sums.exchange.as_deref().unwrap_or(&[]));
        sums.nodes.resize(tiles.node_count(), NodeSum::default());
        sums.nodes
            .par_chunks_mut(Tiles::<D>::NODES)
            .enumerate()
            .for_each(|(tile, nodes)| {
                nodes.fill(NodeSum::default());
                for (neighbour, &other) in tiles.around(tile).iter().enumerate() {
                    let Some(slot) = slot_of(self.placement, other) else {
                        continue;
                    };
                    let source = &windows[slot * window..(slot + 1) * window];
                    for &(entry, local) in &exchange[neighbour] {
                        nodes[local as usize].add(&source[entry as usize]);
                    }
                }
            });
    }
}

fn slot_of<const D: usize>(placement: &Placement<D>, tile: u32) -> Option<usize> {
    if tile == fissure_grid::ABSENT {
        return None;
    }
    match placement.slot(tile as usize) {
        EMPTY => None,
        slot => Some(slot as usize),
    }
}

/// For each of the tiles around: which entries of its window are nodes of the tile in the middle.
fn exchange_lists(around: usize, map: &[(u8, u8)]) -> Vec<Vec<(u16, u8)>> {
    let mut lists = vec![Vec::new(); around];
    for (entry, &(neighbour, local)) in map.iter().enumerate() {
        // Seen from the neighbour, the middle lies in the opposite direction.
        lists[around - 1 - neighbour as usize].push((entry as u16, local));
    }
    lists
}

/// Sums at the nodes and the windows they came from; kept for their allocations.
#[derive(Debug, Default)]
pub struct Sums<const D: usize> {
    /// One entry per node.
    pub nodes: Vec<NodeSum<D>>,
    windows: Vec<NodeSum<D>>,
    exchange: Option<Vec<Vec<(u16, u8)>>>,
}

/// The internal force of a particle's stress on a node of weight `N`: `−(on_gradient·∇N +
/// on_weight N e_r)`, J.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StressForce<const D: usize> {
    /// `V σ` in the scene's dimensions.
    pub on_gradient: SMatrix<f64, D, D>,
    /// `V σ_θθ / r` of an axisymmetric scene, else 0.
    pub on_weight: f64,
}

impl<const D: usize> StressForce<D> {
    /// From the Cauchy stress and the current volume of a particle at `x`.
    #[inline]
    pub(crate) fn new(
        kinematics: Kinematics,
        stress: &Sym,
        volume: f64,
        x: &SVector<f64, D>,
    ) -> Self {
        let full = stress.to_matrix();
        Self {
            on_gradient: SMatrix::from_fn(|i, j| volume * full[(i, j)]),
            on_weight: match kinematics {
                Kinematics::Axisymmetric => volume * stress.zz() / x[0],
                _ => 0.0,
            },
        }
    }
}

/// From entries of one tile's window to nodes.
pub(crate) struct NodeLookup<const D: usize> {
    bases: [usize; 27],
    map: &'static [(u8, u8)],
    coordinates: [i32; D],
}

impl<const D: usize> NodeLookup<D> {
    pub(crate) fn new(tiles: &Tiles<D>, tile: usize) -> Self {
        let mut bases = [0; 27];
        for (base, &around) in bases.iter_mut().zip(tiles.around(tile)) {
            *base = around as usize * Tiles::<D>::NODES;
        }
        Self {
            bases,
            map: window_map::<D>(),
            coordinates: tiles.coordinates(tile),
        }
    }

    /// Node of a window entry.
    #[inline]
    pub(crate) fn node(&self, entry: usize) -> usize {
        let (neighbour, local) = self.map[entry];
        self.bases[neighbour as usize] + local as usize
    }

    /// Position of the window's first node.
    #[inline]
    pub(crate) fn lowest_node(&self, grid: &Grid<D>) -> SVector<f64, D> {
        let first = self
            .coordinates
            .map(|t| t * fissure_grid::TILE + fissure_grid::WINDOW_START);
        grid.node(first)
    }

    /// Position of the node of a window entry.
    #[inline]
    pub(crate) fn node_position(
        &self,
        grid: &Grid<D>,
        lowest: SVector<f64, D>,
        entry: usize,
    ) -> SVector<f64, D> {
        let h = grid.spacing();
        SVector::from_fn(|axis, _| lowest[axis] + h * ((entry >> (3 * axis)) & 7) as f64)
    }
}
