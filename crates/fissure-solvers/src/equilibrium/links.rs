//! Which nodes the particles reach.
//!
//! Particles that reach the same nodes form a **patch** (with linear functions, those of a cell),
//! like the integration points of an element. The patches give the pattern of the stiffness.

use std::collections::HashSet;
use std::ops::Range;

use fissure_grid::{Shape, Stencil};
use fissure_scene::Scene;
use nalgebra::{SMatrix, SVector};

use super::averages::Averages;
use super::divided::{Cut, Divide};
use super::one_strain::Firm;
use super::stiffness::relative;
use crate::linear::BlockPattern;
use crate::transfers::Transfers;

/// A weight, or a gradient times the spacing, below this is round-off of a node that is not reached.
const REACHED: f64 = 1e-14;
/// Marks a node that no particle reaches.
pub(super) const NONE: u32 = u32::MAX;

/// What a particle's shape function is at a node it reaches, at the start of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link<const D: usize> {
    pub weight: f64,
    pub gradient: SVector<f64, D>,
}

/// A particle of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Member {
    pub body: u32,
    /// Its row among the particles of the body.
    pub index: u32,
    /// Its first link; one for each node of the patch, in their order.
    first: u32,
}

impl Member {
    /// Places of its links, one for each of the `count` nodes of its patch.
    pub(super) fn links(&self, count: usize) -> Range<usize> {
        self.first as usize..self.first as usize + count
    }
}

/// What nodes displace a particle by, where that is not what its shape functions say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Increment<const D: usize> {
    /// Of the displacement in the step.
    pub gradient: SMatrix<f64, D, D>,
    /// Further way, m.
    pub way: SVector<f64, D>,
}

/// The nodes that any particle reaches ("active" ones, with numbers of their own), and the patches.
#[derive(Debug, Default)]
pub(crate) struct Links<const D: usize> {
    /// Active nodes, ascending.
    pub active: Vec<u32>,
    /// Number of every node among the active ones.
    numbers: Vec<u32>,
    /// Pairs of nodes that something else than particles joins.
    pub joined: Vec<[u32; 2]>,
    /// Nodes of the patches by their numbers, and where each patch's begin.
    pub(super) nodes: Vec<u32>,
    pub(super) node_starts: Vec<u32>,
    /// Particles of the patches, and where each patch's begin.
    pub(super) members: Vec<Member>,
    pub(super) member_starts: Vec<u32>,
    pub(super) links: Vec<Link<D>>,
    /// Means over the patches, where wanted.
    pub averages: Option<Averages<D>>,
    /// `a` of every link and `k` of every patch, where all particles of a patch have one strain; else nothing.
    pub(super) arms: Vec<SVector<f64, D>>,
    pub(super) firmness: Vec<f64>,
    /// A discontinuity within cells, and the cells that it cuts, in their order along it.
    pub divide: Option<Divide<D>>,
    pub cuts: Vec<Cut>,
    /// How many jumps they have.
    pub(super) jumps: usize,
    /// Of every particle of every body, where particles are not displaced as their shape functions say; else nothing.
    pub increments: Vec<Vec<Increment<D>>>,
}

/// A patch.
pub(crate) struct Patch<'a, const D: usize> {
    /// Numbers of its nodes.
    pub nodes: &'a [u32],
    /// Its particles.
    pub members: &'a [Member],
    links: &'a [Link<D>],
    /// Mean gradients of its nodes, or nothing.
    pub means: &'a [SVector<f64, D>],
    factors: &'a [Vec<f64>],
    pub firm: Firm<'a, D>,
}

impl<const D: usize> Patch<'_, D> {
    /// Links of a particle to the nodes of the patch.
    pub(crate) fn links(&self, member: &Member) -> &[Link<D>] {
        &self.links[member.links(self.nodes.len())]
    }

    /// What joins a particle's deviation from the patch's mean to the nodes; nothing where particles have strains of their own.
    pub(crate) fn arms(&self, member: &Member) -> &[SVector<f64, D>] {
        let arms = self.firm.arms.get(member.links(self.nodes.len()));
        arms.unwrap_or(&[])
    }

    /// `f⁻ᵀ` of a particle's own deformation in the step: takes gradients to its end.
    pub(crate) fn relative(&self, member: &Member, scene: &Scene<D>) -> SMatrix<f64, D, D> {
        let (body, row) = (member.body as usize, member.index as usize);
        let particles = scene.bodies()[body].particles();
        let f_old = &particles.motion.deformation_gradient[row];
        let averaged = relative(&particles.trial.deformation_gradient[row], f_old);
        match self.factors.get(body) {
            Some(factors) => averaged * factors[row],
            None => averaged,
        }
    }
}

impl<const D: usize> Links<D> {
    /// Lists the nodes that every particle reaches.
    ///
    /// # Errors
    /// Body and index of a particle off the grid.
    pub(crate) fn find<S: Shape<D>>(
        &mut self,
        transfers: &Transfers<'_, S, D>,
        scene: &Scene<D>,
    ) -> Result<(), (usize, usize)> {
        self.nodes.clear();
        self.node_starts.clear();
        self.node_starts.push(0);
        self.links.clear();
        // Particles with the patch of each.
        let mut found: Vec<(u32, Member)> = Vec::with_capacity(scene.particle_count());
        let placement = transfers.placement;
        let spacing = transfers.grid.spacing();
        let mut reached = Vec::new();
        for (body_index, body) in scene.bodies().iter().enumerate() {
            let mut last_window = None;
            let mut first_patch = 0;
            for run in &placement.runs[body_index] {
                let nodes = placement.nodes(run.window);
                let window = placement.window(run.window);
                // Patches are sought among those of the window.
                if last_window.replace(run.window) != Some(run.window) {
                    first_patch = self.patches();
                }
                for index in run.start as usize..run.end as usize {
                    let stencil = transfers.stencil(body, &window, index);
                    let stencil = stencil.ok_or((body_index, index))?;
                    let first = self.links.len();
                    reached.clear();
                    stencil.visit(|entry, weight, gradient| {
                        if weight > REACHED || gradient.amax() * spacing > REACHED {
                            let node = nodes.node(entry) as u32;
                            let link = Link { weight, gradient };
                            add_link(&mut reached, &mut self.links, first, node, link);
                        }
                    });
                    let patch = self.patch_of(first_patch, &reached);
                    let member = Member {
                        body: body_index as u32,
                        index: index as u32,
                        first: first as u32,
                    };
                    found.push((patch as u32, member));
                }
            }
        }
        self.join();
        self.cut(placement.node_count(), scene, &found);
        self.sort_members(&found);
        self.number_active(placement.node_count() + self.jumps);
        self.arms.clear();
        self.firmness.clear();
        Ok(())
    }

    /// Finds [`increments`](Self::increments) for displacements of the nodes.
    pub(crate) fn increase(&mut self, scene: &Scene<D>, displacement: &[SVector<f64, D>]) {
        let mut increments = std::mem::take(&mut self.increments);
        if self.arms.is_empty() && self.cuts.is_empty() {
            increments.clear();
            self.increments = increments;
            return;
        }
        let none = Increment {
            gradient: SMatrix::zeros(),
            way: SVector::zeros(),
        };
        increments.resize(scene.bodies().len(), Vec::new());
        for (increments, body) in increments.iter_mut().zip(scene.bodies()) {
            increments.clear();
            increments.resize(body.particles().len(), none);
        }
        let mut cut_of = vec![None; self.patches()];
        for cut in &self.cuts {
            cut_of[cut.patch] = Some(cut);
        }
        for (number, patch) in (0..self.patches()).map(|number| (number, self.patch(number))) {
            let cut = cut_of[number];
            for member in patch.members {
                let increment = &mut increments[member.body as usize][member.index as usize];
                for (place, (link, &node)) in
                    patch.links(member).iter().zip(patch.nodes).enumerate()
                {
                    let mut u = displacement[self.active[node as usize] as usize];
                    if let Some(cut) = cut
                        && cut.nodes[place].1
                    {
                        let jump = displacement[cut.node as usize];
                        u -= jump;
                        increment.way -= jump * link.weight;
                    }
                    increment.gradient += u * link.gradient.transpose();
                }
            }
        }
        self.increments = increments;
    }

    /// Whether particles are displaced as their shape functions say.
    pub(crate) fn are_plain(&self) -> bool {
        self.averages.is_none() && self.arms.is_empty() && self.cuts.is_empty()
    }

    /// How many nodes there are, those of jumps included.
    pub(crate) fn node_count<S>(&self, transfers: &Transfers<'_, S, D>) -> usize {
        transfers.placement.node_count() + self.jumps
    }

    /// The patch of these nodes among those from `first` on, a new one if there is none.
    fn patch_of(&mut self, first: usize, reached: &[u32]) -> usize {
        for patch in (first..self.patches()).rev() {
            let nodes = self.node_starts[patch] as usize..self.node_starts[patch + 1] as usize;
            if self.nodes[nodes] == *reached {
                return patch;
            }
        }
        self.nodes.extend_from_slice(reached);
        self.node_starts.push(self.nodes.len() as u32);
        self.patches() - 1
    }

    /// Makes patches without particles of the pairs that are joined, where both nodes are reached.
    fn join(&mut self) {
        if self.joined.is_empty() {
            return;
        }
        let reached: HashSet<u32> = self.nodes.iter().copied().collect();
        let joined = std::mem::take(&mut self.joined);
        for pair in joined
            .iter()
            .filter(|pair| pair.iter().all(|node| reached.contains(node)))
        {
            self.nodes.extend_from_slice(pair);
            self.node_starts.push(self.nodes.len() as u32);
        }
        self.joined = joined;
    }

    fn sort_members(&mut self, found: &[(u32, Member)]) {
        let mut starts = vec![0_u32; self.patches() + 1];
        for (patch, _) in found {
            starts[*patch as usize + 1] += 1;
        }
        for patch in 1..starts.len() {
            starts[patch] += starts[patch - 1];
        }
        let mut next = starts.clone();
        let nobody = Member {
            body: 0,
            index: 0,
            first: 0,
        };
        self.members.clear();
        self.members.resize(found.len(), nobody);
        for (patch, member) in found {
            let place = &mut next[*patch as usize];
            self.members[*place as usize] = *member;
            *place += 1;
        }
        self.member_starts = starts;
    }

    fn number_active(&mut self, node_count: usize) {
        self.numbers.clear();
        self.numbers.resize(node_count, NONE);
        for &node in &self.nodes {
            self.numbers[node as usize] = 0;
        }
        self.active.clear();
        for (node, number) in self.numbers.iter_mut().enumerate() {
            if *number != NONE {
                *number = self.active.len() as u32;
                self.active.push(node as u32);
            }
        }
        for node in &mut self.nodes {
            *node = self.numbers[*node as usize];
        }
        for cut in &mut self.cuts {
            cut.number = self.numbers[cut.node as usize];
        }
    }

    /// Number of a node among the active ones.
    pub(crate) fn number(&self, node: usize) -> Option<usize> {
        let number = *self.numbers.get(node)?;
        (number != NONE).then_some(number as usize)
    }

    /// Adds `share` times a vector of the active nodes to one of all nodes.
    pub(crate) fn add(&self, vector: &[f64], share: f64, field: &mut [SVector<f64, D>]) {
        for (&node, part) in self.active.iter().zip(vector.chunks_exact(D)) {
            field[node as usize] += SVector::from_column_slice(part) * share;
        }
    }

    /// Where the active nodes are, m.
    pub(crate) fn positions<S>(&self, transfers: &Transfers<'_, S, D>) -> Vec<[f64; D]> {
        let (grid, placement) = (transfers.grid, transfers.placement);
        let of_grid = |node: u32| placement.node_position(grid, node as usize);
        let position = |&node: &u32| {
            let cut = (node as usize).checked_sub(placement.node_count());
            let found = cut.and_then(|_| self.cuts.iter().find(|cut| cut.node == node));
            let Some(cut) = found else {
                return of_grid(node).into();
            };
            let sum: SVector<f64, D> = cut.nodes.iter().map(|node| of_grid(node.0)).sum();
            (sum / cut.nodes.len() as f64).into()
        };
        self.active.iter().map(position).collect()
    }

    /// Number of patches.
    pub(crate) fn patches(&self) -> usize {
        self.node_starts.len().saturating_sub(1)
    }

    /// A patch.
    pub(crate) fn patch(&self, patch: usize) -> Patch<'_, D> {
        let range = |starts: &[u32]| starts[patch] as usize..starts[patch + 1] as usize;
        Patch {
            nodes: &self.nodes[range(&self.node_starts)],
            members: &self.members[range(&self.member_starts)],
            links: &self.links,
            means: match &self.averages {
                Some(averages) => averages.means.get(range(&self.node_starts)).unwrap_or(&[]),
                None => &[],
            },
            factors: match &self.averages {
                Some(averages) => &averages.factors,
                None => &[],
            },
            firm: Firm {
                stiffness: self.firmness.get(patch).copied().unwrap_or(0.0),
                arms: &self.arms,
            },
        }
    }

    /// Nodes of every patch, patch by patch.
    fn patch_nodes(&self) -> impl Iterator<Item = &[u32]> + Clone {
        let starts = self.node_starts.windows(2);
        starts.map(|ends| &self.nodes[ends[0] as usize..ends[1] as usize])
    }

    /// The blocks of the stiffness.
    pub(crate) fn pattern(&self) -> BlockPattern {
        BlockPattern::of_elements(self.active.len(), self.patch_nodes())
    }

    /// Whether `nodes` and `starts` are those of the patches.
    pub(crate) fn are_of(&self, nodes: &[u32], starts: &[u32]) -> bool {
        self.nodes == nodes && self.node_starts == starts
    }

    /// Nodes of the patches by their numbers, and where each patch's begin.
    pub(crate) fn lists(&self) -> (&[u32], &[u32]) {
        (&self.nodes, &self.node_starts)
    }
}

/// Adds a node to a particle's links; one that it reaches twice (CPDI) is summed.
fn add_link<const D: usize>(
    reached: &mut Vec<u32>,
    links: &mut Vec<Link<D>>,
    first: usize,
    node: u32,
    link: Link<D>,
) {
    if let Some(known) = reached.iter().position(|&known| known == node) {
        links[first + known].weight += link.weight;
        links[first + known].gradient += link.gradient;
    } else {
        reached.push(node);
        links.push(link);
    }
}
