//! Cells that a discontinuity divides: each has a node more, whose displacement is the jump in it.

use std::ops::Range;

use fissure_scene::Scene;
use nalgebra::SVector;

use super::links::{Links, Member, NONE};

/// A straight discontinuity in the plane.
#[derive(Clone, Debug)]
pub(crate) struct Divide<const D: usize> {
    pub normal: SVector<f64, D>,
    /// Whether each node of the grid is on the side to which the normal points.
    pub sides: Vec<bool>,
    /// A cell with a smaller share of the greatest area of a cut has the jump of its neighbour.
    pub least_area: f64,
}

/// A cell whose nodes a discontinuity separates: the jump is the displacement of a further node.
#[derive(Clone, Debug)]
pub(crate) struct Cut {
    pub patch: usize,
    /// The node of the jump, behind all nodes of the grid, and its number among the active ones.
    pub node: u32,
    pub number: u32,
    /// Nodes of the patch, by place in it: itself, and whether it lies on the side to which the normal points.
    pub nodes: Vec<(u32, bool)>,
    /// `n·Σ V ∇φ` over its particles, with `φ` the sum of the functions of the nodes on that side, m².
    pub area: f64,
    /// Place of its particles along the discontinuity, m.
    place: f64,
}

impl<const D: usize> Links<D> {
    /// Gives cells whose nodes lie on both sides of a discontinuity a node more for their jump. `φ` has a slope along the
    /// discontinuity where only a corner of a cell is cut off or filled, and a jump would not be held by the traction that it
    /// meets: such cells share the jump of their neighbour.
    pub(super) fn cut(&mut self, node_count: usize, scene: &Scene<D>, found: &[(u32, Member)]) {
        self.cuts.clear();
        self.jumps = 0;
        let Some(divide) = &self.divide else {
            return;
        };
        let mut cut_of = vec![None; self.patches()];
        let mut volumes = Vec::new();
        for (patch, cut_of) in cut_of.iter_mut().enumerate() {
            let nodes = self.node_starts[patch] as usize..self.node_starts[patch + 1] as usize;
            let sided = self.nodes[nodes].iter();
            let nodes: Vec<(u32, bool)> = sided
                .map(|&node| (node, divide.sides[node as usize]))
                .collect();
            if nodes.iter().any(|node| node.1) && nodes.iter().any(|node| !node.1) {
                *cut_of = Some(self.cuts.len());
                volumes.push(0.0);
                self.cuts.push(Cut {
                    patch,
                    node: NONE,
                    number: NONE,
                    nodes,
                    area: 0.0,
                    place: 0.0,
                });
            }
        }
        for (patch, member) in found {
            let Some(number) = cut_of[*patch as usize] else {
                continue;
            };
            let cut = &mut self.cuts[number];
            let particles = scene.bodies()[member.body as usize].particles();
            let (row, motion) = (member.index as usize, &particles.motion);
            let volume = particles.volume[row] * motion.deformation_gradient[row].determinant();
            let links = self.links[member.links(cut.nodes.len())].iter();
            let beyond = links.zip(&cut.nodes).filter(|(_, node)| node.1);
            let slope: f64 = beyond
                .map(|(link, _)| link.gradient.dot(&divide.normal))
                .sum();
            let x = &motion.position[row];
            cut.area += volume * slope;
            cut.place += volume * (divide.normal[0] * x[1] - divide.normal[1] * x[0]);
            volumes[number] += volume;
        }
        for (cut, volume) in self.cuts.iter_mut().zip(volumes) {
            cut.place /= volume;
        }
        self.cuts.sort_by(|a, b| a.place.total_cmp(&b.place));
        let greatest = self.cuts.iter().map(|cut| cut.area).fold(0.0, f64::max);
        let groups = grouped(&self.cuts, divide.least_area * greatest);
        self.jumps = groups.len();
        for (jump, group) in groups.into_iter().enumerate() {
            let node = (node_count + jump) as u32;
            let mut nodes = Vec::new();
            for cut in &mut self.cuts[group] {
                cut.node = node;
                for (node, _) in &cut.nodes {
                    if !nodes.contains(node) {
                        nodes.push(*node);
                    }
                }
            }
            self.nodes.extend(nodes);
            self.nodes.push(node);
            self.node_starts.push(self.nodes.len() as u32);
        }
    }
}

/// Runs of cuts with at least this area each, if there is as much.
fn grouped(cuts: &[Cut], least: f64) -> Vec<Range<usize>> {
    let mut groups: Vec<Range<usize>> = (0..cuts.len()).map(|cut| cut..cut + 1).collect();
    let area = |group: &Range<usize>| cuts[group.clone()].iter().map(|cut| cut.area).sum::<f64>();
    while groups.len() > 1 {
        let Some(small) = groups.iter().position(|group| !(area(group) >= least)) else {
            break;
        };
        // To the smaller of its neighbours.
        let before = small.checked_sub(1);
        let after = (small + 1 < groups.len()).then_some(small + 1);
        let first = match (before, after) {
            (Some(before), Some(after)) if area(&groups[after]) < area(&groups[before]) => small,
            (Some(before), _) => before,
            _ => small,
        };
        groups[first].end = groups[first + 1].end;
        groups.remove(first + 1);
    }
    groups
}
