//! The tangent stiffness: what the internal forces do when nodes are displaced.
//!
//! `K_ij = Σ_p J V (∇_x N_i·c·∇_x N_j + (∇_x N_i·σ·∇_x N_j) 1)` with `∇_x N = f⁻ᵀ ∇N` the gradients at
//! the end of the step, `c` the law's Truesdell tangent and `σ` its stress.

use fissure_materials::Tangent;
use fissure_scene::{Kinematics, Scene};
use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;
use std::f64::consts::FRAC_1_SQRT_2;

use super::averages::volumetric;
use super::links::{Link, Links, Member, Patch};
use crate::linear::{BlockMatrix, BlockPattern};

/// Blocks of patches that are computed before they are added, in one order, to the matrix.
const BATCH: usize = 1 << 17;

/// The stiffness of a scene's trial state.
#[derive(Default)]
pub(crate) struct Stiffness<const D: usize> {
    /// Without conditions, in the axes of space; a row of blocks per active node.
    pub matrix: BlockMatrix<D>,
    /// Places of each patch's blocks in the matrix, row by row.
    places: Vec<u32>,
    place_starts: Vec<usize>,
    /// What the pattern was made for.
    nodes: Vec<u32>,
    node_starts: Vec<u32>,
}

impl<const D: usize> Stiffness<D> {
    /// Finds the pattern unless the last one still fits; whether it did.
    pub(crate) fn prepare(&mut self, links: &Links<D>) -> bool {
        if links.are_of(&self.nodes, &self.node_starts) {
            return true;
        }
        let (nodes, starts) = links.lists();
        nodes.clone_into(&mut self.nodes);
        starts.clone_into(&mut self.node_starts);
        self.matrix = BlockMatrix::zeros(links.pattern());
        self.places.clear();
        self.place_starts.clear();
        self.place_starts.push(0);
        let pattern = self.matrix.pattern();
        for ends in starts.windows(2) {
            let nodes = &nodes[ends[0] as usize..ends[1] as usize];
            for &row in nodes {
                let first = pattern.row(row as usize).start;
                let neighbours = pattern.neighbours(row as usize);
                for column in nodes {
                    // The pattern was made of these pairs.
                    let found = neighbours.partition_point(|other| other < column);
                    self.places.push((first + found) as u32);
                }
            }
            self.place_starts.push(self.places.len());
        }
        false
    }

    /// Sums the matrix of the trial state.
    pub(crate) fn assemble(
        &mut self,
        links: &Links<D>,
        scene: &Scene<D>,
        tangents: &[Vec<Tangent>],
    ) {
        match D {
            2 => self.assemble_with::<4>(links, scene, tangents),
            _ => self.assemble_with::<6>(links, scene, tangents),
        }
    }

    fn assemble_with<const V: usize>(
        &mut self,
        links: &Links<D>,
        scene: &Scene<D>,
        tangents: &[Vec<Tangent>],
    ) {
        self.matrix.clear();
        let mut start = 0;
        while start < links.patches() {
            let last = self.place_starts[start] + BATCH;
            let end = self.place_starts.partition_point(|&place| place <= last) - 1;
            let end = end.clamp(start + 1, links.patches());
            let chunks: Vec<usize> = (start..end).step_by(CHUNK).collect();
            let parts: Vec<Vec<SMatrix<f64, D, D>>> = chunks
                .par_iter()
                .map(|&first| {
                    let last = (first + CHUNK).min(end);
                    let count = self.place_starts[last] - self.place_starts[first];
                    let mut blocks = vec![SMatrix::zeros(); count];
                    let mut nodes = Vec::new();
                    for patch in first..last {
                        let offset = self.place_starts[patch] - self.place_starts[first];
                        let of_patch = links.patch(patch);
                        for member in of_patch.members {
                            let point = Strained::<D, V>::new(&of_patch, member, scene, tangents);
                            point.add(&mut blocks[offset..], &mut nodes);
                        }
                    }
                    blocks
                })
                .collect();
            for (first, part) in chunks.iter().zip(&parts) {
                let places = &self.places[self.place_starts[*first]..];
                for (place, block) in places.iter().zip(part) {
                    self.matrix.blocks[*place as usize] += block;
                }
            }
            start = end;
        }
    }
}

/// The stiffness of the trial state times a vector of the active nodes, without a matrix.
pub(crate) fn times<const D: usize>(
    links: &Links<D>,
    scene: &Scene<D>,
    tangents: &[Vec<Tangent>],
    x: &[f64],
) -> Vec<f64> {
    match D {
        2 => times_with::<D, 4>(links, scene, tangents, x),
        _ => times_with::<D, 6>(links, scene, tangents, x),
    }
}

fn times_with<const D: usize, const V: usize>(
    links: &Links<D>,
    scene: &Scene<D>,
    tangents: &[Vec<Tangent>],
    x: &[f64],
) -> Vec<f64> {
    let mut y = vec![0.0; x.len()];
    let work = |patch: &Patch<'_, D>, forces: &mut [SVector<f64, D>]| {
        for member in patch.members {
            let point = Strained::<D, V>::new(patch, member, scene, tangents);
            point.add_forces(patch.nodes, x, forces);
        }
    };
    each_patch(links, SVector::zeros(), work, |node, force| {
        let y = &mut y[D * node..D * (node + 1)];
        y.iter_mut().zip(force.iter()).for_each(|(y, f)| *y += f);
    });
    y
}

/// The diagonal blocks of the stiffness of the trial state.
pub(crate) fn diagonal_blocks<const D: usize>(
    links: &Links<D>,
    scene: &Scene<D>,
    tangents: &[Vec<Tangent>],
) -> BlockMatrix<D> {
    match D {
        2 => diagonal_blocks_with::<D, 4>(links, scene, tangents),
        _ => diagonal_blocks_with::<D, 6>(links, scene, tangents),
    }
}

fn diagonal_blocks_with<const D: usize, const V: usize>(
    links: &Links<D>,
    scene: &Scene<D>,
    tangents: &[Vec<Tangent>],
) -> BlockMatrix<D> {
    let count = links.active.len();
    let mut diagonal = BlockMatrix::zeros(BlockPattern::of_elements(count, std::iter::empty()));
    let work = |patch: &Patch<'_, D>, blocks: &mut [SMatrix<f64, D, D>]| {
        for member in patch.members {
            Strained::<D, V>::new(patch, member, scene, tangents).add_diagonal(blocks);
        }
    };
    each_patch(
        links,
        SMatrix::zeros(),
        work,
        |node, block: &SMatrix<f64, D, D>| {
            diagonal.blocks[node] += block;
        },
    );
    diagonal
}

/// Calls `work` on every patch with `zero` for each of its nodes, and `add` on what it made of them, in
/// one order.
fn each_patch<const D: usize, T: Clone + Send + Sync>(
    links: &Links<D>,
    zero: T,
    work: impl Fn(&Patch<'_, D>, &mut [T]) + Sync,
    mut add: impl FnMut(usize, &T),
) {
    let chunks: Vec<usize> = (0..links.patches()).step_by(CHUNK).collect();
    for batch in chunks.chunks(CHUNK) {
        let parts: Vec<Vec<T>> = batch
            .par_iter()
            .map(|&first| {
                let mut numbers = Vec::new();
                for patch in first..(first + CHUNK).min(links.patches()) {
                    let patch = links.patch(patch);
                    let start = numbers.len();
                    numbers.resize(start + patch.nodes.len(), zero.clone());
                    work(&patch, &mut numbers[start..]);
                }
                numbers
            })
            .collect();
        for (&first, part) in batch.iter().zip(&parts) {
            let patches = first..(first + CHUNK).min(links.patches());
            let nodes = patches.flat_map(|patch| links.patch(patch).nodes);
            for (&node, number) in nodes.zip(part) {
                add(node as usize, number);
            }
        }
    }
}

/// What displacements of the nodes of one patch do to it.
pub(crate) struct PatchRates<const D: usize> {
    /// The patch's part of the stiffness, row by row.
    pub forces: Vec<SMatrix<f64, D, D>>,
    /// Rates of `Σ V σ·n` with each node's displacement.
    pub tractions: Vec<SMatrix<f64, D, D>>,
}

/// The derivatives of a patch of the plane; those of its tractions without what turning does to the stress.
pub(crate) fn patch_rates<const D: usize>(
    patch: &Patch<'_, D>,
    scene: &Scene<D>,
    tangents: &[Vec<Tangent>],
    normal: &SVector<f64, D>,
) -> PatchRates<D> {
    let count = patch.nodes.len();
    let mut rates = PatchRates {
        forces: vec![SMatrix::zeros(); count * count],
        tractions: vec![SMatrix::zeros(); count],
    };
    let mut nodes = Vec::new();
    for member in patch.members {
        let point = Strained::<D, 4>::new(patch, member, scene, tangents);
        point.add(&mut rates.forces, &mut nodes);
        for (rate, (_, strain)) in rates.tractions.iter_mut().zip(&nodes) {
            let stress = point.tangent * strain;
            for column in 0..D {
                let shear = FRAC_1_SQRT_2 * stress[(3, column)];
                rate[(0, column)] += stress[(0, column)] * normal[0] + shear * normal[1];
                rate[(1, column)] += shear * normal[0] + stress[(1, column)] * normal[1];
            }
        }
    }
    rates
}

/// Patches that a thread works on at a time.
const CHUNK: usize = 64;

/// Strain rates per unit nodal displacement of one particle, in `V` Mandel components, and the
/// stresses that answer them.
struct Strained<'a, const D: usize, const V: usize> {
    links: &'a [Link<D>],
    /// Mean gradients of the links' nodes over the patch, or nothing.
    means: &'a [SVector<f64, D>],
    /// `f⁻ᵀ`: takes gradients to the end of the step.
    relative: SMatrix<f64, D, D>,
    /// The tangent times the volume.
    tangent: SMatrix<f64, V, V>,
    /// The stress times the volume.
    stress: SMatrix<f64, D, D>,
    hoop_stress: f64,
    /// `1/r` of an axisymmetric scene, else 0.
    inverse_radius: f64,
    /// `k V` and `a` of what holds the particle to the mean of its patch (see `one_strain`), or nothing.
    firm: f64,
    arms: &'a [SVector<f64, D>],
}

impl<'a, const D: usize, const V: usize> Strained<'a, D, V> {
    fn new(
        patch: &'a Patch<'_, D>,
        member: &Member,
        scene: &Scene<D>,
        tangents: &[Vec<Tangent>],
    ) -> Self {
        let (body, index) = (member.body as usize, member.index as usize);
        let particles = scene.bodies()[body].particles();
        let f_new = &particles.trial.deformation_gradient[index];
        let volume = particles.volume[index] * f_new.determinant();
        let stress = &particles.trial.stress[index];
        let tangent = &tangents[body][index].0;
        let component = |row: usize| if V == 4 && row == 3 { 5 } else { row };
        let full = stress.to_matrix();
        Self {
            links: patch.links(member),
            means: patch.means,
            relative: patch.relative(member, scene),
            tangent: SMatrix::from_fn(|i, j| tangent[(component(i), component(j))] * volume),
            stress: SMatrix::from_fn(|i, j| full[(i, j)] * volume),
            hoop_stress: stress.zz() * volume,
            inverse_radius: inverse_radius(scene, &particles.trial.position[index]),
            firm: patch.firm.stiffness * particles.volume[index],
            arms: patch.arms(member),
        }
    }

    /// Gradient of a link's node at the end of the step, and the strains of unit displacements of the node along
    /// the axes.
    #[inline]
    fn of_link(&self, link: usize) -> (SVector<f64, D>, SMatrix<f64, V, D>) {
        let gradient = self.relative * self.links[link].gradient;
        let mut strain = self.strain(&gradient, self.links[link].weight);
        if let Some(mean) = self.means.get(link) {
            let own = volumetric(gradient, self.links[link].weight, self.inverse_radius);
            // The hoop strain is the third.
            let rows = if self.inverse_radius > 0.0 { 3 } else { D };
            let further = (mean - own) / rows as f64;
            for column in 0..D {
                for row in 0..rows {
                    strain[(row, column)] += further[column];
                }
            }
        }
        (gradient, strain)
    }

    /// The strains without what the patch's mean adds.
    #[inline]
    fn strain(&self, gradient: &SVector<f64, D>, weight: f64) -> SMatrix<f64, V, D> {
        let mut strain = SMatrix::<f64, V, D>::zeros();
        for axis in 0..D {
            strain[(axis, axis)] = gradient[axis];
        }
        if V == 4 {
            strain[(2, 0)] += weight * self.inverse_radius;
            strain[(3, 0)] = FRAC_1_SQRT_2 * gradient[1];
            strain[(3, 1)] = FRAC_1_SQRT_2 * gradient[0];
        } else {
            for (row, a, b) in [(3, 1, 2), (4, 0, 2), (5, 0, 1)] {
                strain[(row, a)] = FRAC_1_SQRT_2 * gradient[b];
                strain[(row, b)] = FRAC_1_SQRT_2 * gradient[a];
            }
        }
        strain
    }

    /// Adds the forces that answer the displacements `x` of the active nodes.
    fn add_forces(&self, nodes: &[u32], x: &[f64], forces: &mut [SVector<f64, D>]) {
        let mut strain = SMatrix::<f64, V, 1>::zeros();
        let mut gradient_sum = SMatrix::<f64, D, D>::zeros();
        let mut radial = 0.0;
        for (place, &node) in nodes.iter().enumerate() {
            let first = D * node as usize;
            let u = SVector::<f64, D>::from_column_slice(&x[first..first + D]);
            let (gradient, of_unit) = self.of_link(place);
            strain += of_unit * u;
            gradient_sum += u * gradient.transpose();
            radial += self.links[place].weight * u[0];
        }
        let stress = self.tangent * strain;
        let turning = gradient_sum * self.stress;
        let hoop = self.inverse_radius * self.inverse_radius * self.hoop_stress * radial;
        for (place, force) in forces.iter_mut().enumerate() {
            let (gradient, of_unit) = self.of_link(place);
            *force += of_unit.tr_mul(&stress) + turning * gradient;
            force[0] += hoop * self.links[place].weight;
        }
        let mut deviation = SMatrix::<f64, D, D>::zeros();
        for (arm, &node) in self.arms.iter().zip(nodes) {
            let first = D * node as usize;
            let u = SVector::<f64, D>::from_column_slice(&x[first..first + D]);
            deviation += u * arm.transpose() * self.firm;
        }
        for (arm, force) in self.arms.iter().zip(forces) {
            *force += deviation * arm;
        }
    }

    /// Adds the blocks of every node with itself.
    fn add_diagonal(&self, blocks: &mut [SMatrix<f64, D, D>]) {
        let hoop = self.inverse_radius * self.inverse_radius * self.hoop_stress;
        for (place, block) in blocks.iter_mut().enumerate() {
            let (gradient, strain) = self.of_link(place);
            *block += strain.tr_mul(&(self.tangent * strain));
            let turning = gradient.dot(&(self.stress * gradient));
            let held = self.arms.get(place).map_or(0.0, SVector::norm_squared);
            for axis in 0..D {
                block[(axis, axis)] += turning + self.firm * held;
            }
            block[(0, 0)] += hoop * self.links[place].weight.powi(2);
        }
    }

    /// Adds the blocks of every pair of nodes; `nodes` is kept for its memory.
    fn add(
        &self,
        blocks: &mut [SMatrix<f64, D, D>],
        nodes: &mut Vec<(SVector<f64, D>, SMatrix<f64, V, D>)>,
    ) {
        nodes.clear();
        nodes.extend((0..self.links.len()).map(|place| self.of_link(place)));
        let count = nodes.len();
        let hoop = self.inverse_radius * self.inverse_radius * self.hoop_stress;
        // The law's tangent need not be symmetric: rows test, columns answer.
        for (column, (gradient, strain)) in nodes.iter().enumerate() {
            let stress = self.tangent * strain;
            let traction = self.stress * gradient;
            for (row, (gradient, strain)) in nodes.iter().enumerate() {
                let block = &mut blocks[row * count + column];
                *block += strain.tr_mul(&stress);
                let mut turning = gradient.dot(&traction);
                if let (Some(a), Some(b)) = (self.arms.get(row), self.arms.get(column)) {
                    turning += self.firm * a.dot(b);
                }
                for axis in 0..D {
                    block[(axis, axis)] += turning;
                }
                block[(0, 0)] += hoop * self.links[row].weight * self.links[column].weight;
            }
        }
    }
}

/// `f⁻ᵀ` of the step's own deformation `f = F_new F_old⁻¹`, in the scene's dimensions.
pub(crate) fn relative<const D: usize>(
    f_new: &nalgebra::Matrix3<f64>,
    f_old: &nalgebra::Matrix3<f64>,
) -> SMatrix<f64, D, D> {
    // f⁻ᵀ = F_new⁻ᵀ F_oldᵀ; both determinants are positive, since the law has accepted them.
    let inverse = f_new
        .try_inverse()
        .unwrap_or_else(nalgebra::Matrix3::identity);
    let transposed = inverse.transpose() * f_old.transpose();
    SMatrix::from_fn(|i, j| transposed[(i, j)])
}

/// `1/r` in axisymmetry, else 0.
pub(super) fn inverse_radius<const D: usize>(scene: &Scene<D>, position: &SVector<f64, D>) -> f64 {
    match scene.kinematics() {
        Kinematics::Axisymmetric => position[0].recip(),
        _ => 0.0,
    }
}
