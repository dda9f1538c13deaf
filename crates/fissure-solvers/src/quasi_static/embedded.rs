//! A crack as a discontinuity embedded in cells [Sanchez 2010, sec. 5.5.4; Jirasek 2000].
//!
//! The crack is a straight line with the normal `n`, given from the start. A cell whose nodes lie on both sides of it has a
//! jump `w` of its own, constant in the cell, and its particles are displaced by
//!
//! ```text
//! u(x) = Σ_i u_i N_i(x) + (H(x) − φ(x)) w,   φ = Σ_{i on the side of n} N_i                 [eqs 5.5.60-5.5.62]
//! ∇u = Σ_i u_i ⊗ ∇N_i − w ⊗ ∇φ                                                             [eq. 5.5.70]
//! ```
//!
//! so that nodes beyond the crack count as `u_i − w`: halves that move apart without a strain strain no particle, wherever
//! the line runs. That holds because which nodes lie beyond is told from the one line and not cell by cell. Nodes feel the
//! particles' stresses by `∇N`, as ever. What is left is the traction on the crack, `t(w)` by a cohesive law:
//!
//! - *Optimal* (statically and kinematically optimal, not symmetric): `t(w) = Σ V σ·n/Σ V`, the mean over the cell's
//!   particles. The tangent is not symmetric, since `w` acts by `∇φ` and answers to `n`. Where these are far apart, as in a cell
//!   of which the crack or the side of the body leaves a corner, they hold no jump [Jirasek 2000]: cells with less than half
//!   of the greatest `A` share the jump of a neighbour, and the mean is over both.
//! - *Local*, as the document has it: `t` is the traction of an elastic-decohesive point in the middle `X_e` of the crack's
//!   piece `ℓ_e` in the cell, that smears its opening over `L_c = Ω_e/ℓ_e` [eq. 5.5.68]. Its elastic strain is
//!   `(Σ u_i ⊗ ∇N_i(X_e) − w ⊗ n/L_c)^S`, small, while particles have the one above. The opening is along `n`. Where
//!   the line cuts off a corner `ℓ_e` is small and `L_c` beyond the limit of eq. 4.5.17.
//!
//! Energies of the crack are those of the law times `A = n·Σ V ∇φ`, which sums to the section of the body.

use std::collections::BTreeMap;

use fissure_grid::{Grid, SUMS};
use fissure_materials::{Cohesive, Tangent, TractionSeparationState};
use fissure_scene::{Scene, SolveError, SweepTotals};
use nalgebra::{SMatrix, SVector, Vector2};

use super::embedded_crack::{EmbeddedCrack, EmbeddedForm, EmbeddedJump, answer, traction};
use crate::equilibrium::divided::{Cut, Divide};
use crate::equilibrium::links::Links;
use crate::equilibrium::stiffness::{PatchRates, patch_rates};
use crate::equilibrium::system::Block;
use crate::nodes::NodeSums;
use crate::placement::Placement;

/// Share of the greatest area of a cell below which it has its neighbour's jump.
const LEAST_AREA: f64 = 0.5;

/// What a cell's crack has been through.
#[derive(Clone, Copy, Debug)]
struct History<const D: usize> {
    jump: SVector<f64, D>,
    /// Gradient of the nodes' displacements at the middle of the crack's piece (local form).
    gradient: SMatrix<f64, D, D>,
    law: TractionSeparationState,
    area: f64,
}

impl<const D: usize> Default for History<D> {
    fn default() -> Self {
        Self {
            jump: SVector::zeros(),
            gradient: SMatrix::zeros(),
            law: TractionSeparationState::default(),
            area: 0.0,
        }
    }
}

/// The embedded crack of a solver.
pub(super) struct Embedded<const D: usize> {
    crack: EmbeddedCrack,
    normal: SVector<f64, D>,
    /// By the corner of the cell.
    histories: BTreeMap<[i32; D], History<D>>,
    /// One for each cut, in the step; those of one jump stand together.
    cells: Vec<Cell<D>>,
}

/// A cut in a step. Those of one jump have one history.
struct Cell<const D: usize> {
    corner: [i32; D],
    before: History<D>,
    after: History<D>,
    /// `Σ V` of all cells with its jump, m³.
    volume: f64,
    /// `A` of all cells with its jump, m².
    whole: f64,
    /// Gradients of the nodes at the middle of the crack's piece, and `L_c`, m (local form).
    middle: Vec<SVector<f64, D>>,
    width: f64,
    /// Derivative of the traction of the law with the jump, Pa/m.
    tangent: SMatrix<f64, D, D>,
}

impl<const D: usize> Embedded<D> {
    pub(super) fn new(crack: EmbeddedCrack) -> Result<Self, SolveError> {
        let length = Vector2::from(crack.normal).norm();
        if !(length > 0.0 && length.is_finite() && D == 2) {
            return Err(SolveError::Setting {
                setting: "normal of the embedded crack",
                value: length,
                permitted: "finite, not zero",
            });
        }
        crack.law.check().map_err(|_| SolveError::Unsupported {
            what: "an embedded crack with a law outside its range",
        })?;
        Ok(Self {
            crack,
            normal: SVector::from_fn(|axis, _| crack.normal[axis.min(1)] / length),
            histories: BTreeMap::new(),
            cells: Vec::new(),
        })
    }

    /// On which side nodes are.
    pub(super) fn divide(&self, grid: &Grid<D>, placement: &Placement<D>) -> Divide<D> {
        let point = SVector::<f64, D>::from_fn(|axis, _| self.crack.point[axis.min(1)]);
        let side = |node| (placement.node_position(grid, node) - point).dot(&self.normal) >= 0.0;
        Divide {
            normal: self.normal,
            sides: (0..placement.node_count()).map(side).collect(),
            least_area: match self.crack.form {
                EmbeddedForm::Optimal => LEAST_AREA,
                EmbeddedForm::Local(_) => f64::NEG_INFINITY,
            },
        }
    }

    /// Begins a step.
    pub(super) fn begin(
        &mut self,
        links: &Links<D>,
        scene: &Scene<D>,
        grid: &Grid<D>,
        placement: &Placement<D>,
    ) {
        self.cells.clear();
        for cut in &links.cuts {
            let corners = cut.nodes.iter();
            let places = corners.map(|&(node, _)| placement.node_position(grid, node as usize));
            let places: Vec<SVector<f64, D>> = places.collect();
            let low = places.iter().fold(places[0], |low, x| low.inf(x));
            let corner = std::array::from_fn(|axis| {
                ((low[axis] - grid.origin()[axis]) / grid.spacing()).round() as i32
            });
            let mut before = self.histories.get(&corner).copied().unwrap_or_default();
            let patch = links.patch(cut.patch);
            let volumes = patch.members.iter().map(|member| {
                let particles = scene.bodies()[member.body as usize].particles();
                let f_old = &particles.motion.deformation_gradient[member.index as usize];
                particles.volume[member.index as usize] * f_old.determinant()
            });
            let volume = volumes.sum();
            before.area = cut.area;
            let (middle, width) = self.middle(&low, &places, grid.spacing());
            self.cells.push(Cell {
                corner,
                before,
                after: before,
                volume,
                whole: cut.area,
                middle,
                width,
                tangent: SMatrix::zeros(),
            });
        }
        // What cells of one jump have been through is what the one with the most area has.
        for group in groups(links) {
            let volume = self.cells[group.clone()]
                .iter()
                .map(|cell| cell.volume)
                .sum();
            let area = |cell: &&Cell<D>| cell.before.area;
            let cells = self.cells[group.clone()].iter();
            let Some(most) = cells.max_by(|a, b| area(a).total_cmp(&area(b))) else {
                continue;
            };
            let most = most.before;
            let whole = links.cuts[group.clone()].iter().map(|cut| cut.area).sum();
            for cell in &mut self.cells[group] {
                (cell.volume, cell.whole) = (volume, whole);
                cell.before = History {
                    area: cell.before.area,
                    ..most
                };
                cell.after = cell.before;
            }
        }
    }

    /// Gradients of a cell's nodes at the middle of the crack's piece in it, and the width `L_c`, m.
    fn middle(
        &self,
        low: &SVector<f64, D>,
        places: &[SVector<f64, D>],
        h: f64,
    ) -> (Vec<SVector<f64, D>>, f64) {
        let point = Vector2::from(self.crack.point);
        let along = Vector2::new(-self.normal[1], self.normal[0]);
        let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..2 {
            if along[axis] != 0.0 {
                let a = (low[axis] - point[axis]) / along[axis];
                let b = (low[axis] + h - point[axis]) / along[axis];
                (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
            }
        }
        let middle = point + along * (0.5 * (from + to));
        let local: [f64; 2] = std::array::from_fn(|axis| (middle[axis] - low[axis]) / h);
        let gradients = places.iter().map(|place| {
            let upper: [bool; 2] = std::array::from_fn(|axis| place[axis] > low[axis] + 0.5 * h);
            let weight = |axis: usize| {
                if upper[axis] {
                    local[axis]
                } else {
                    1.0 - local[axis]
                }
            };
            let slope = |axis: usize| if upper[axis] { 1.0 / h } else { -1.0 / h };
            SVector::from_fn(|axis, _| match axis {
                0 => slope(0) * weight(1),
                1 => slope(1) * weight(0),
                _ => 0.0,
            })
        });
        (
            gradients.collect(),
            h * h / (to - from).max(f64::MIN_POSITIVE),
        )
    }

    /// Adds what drives the jumps to the forces, and the energies of the crack.
    pub(super) fn add(
        &mut self,
        links: &Links<D>,
        scene: &Scene<D>,
        displacement: &[SVector<f64, D>],
        sums: &NodeSums<D>,
    ) -> Result<(), SolveError> {
        let normal = self.normal;
        let refused = |_| SolveError::Unsupported {
            what: "a jump that is not finite",
        };
        for (cut, cell) in links.cuts.iter().zip(&mut self.cells) {
            let change = displacement[cut.node as usize];
            cell.after = cell.before;
            cell.after.jump += change;
            let answer = answer(&self.crack.law, &cell.after.jump, &normal, &cell.before.law)
                .map_err(refused)?;
            cell.after.law = answer.state;
            cell.tangent = SMatrix::from_fn(|i, j| answer.tangent[(i, j)]);
            let resisting = SVector::<f64, D>::from_fn(|axis, _| answer.traction[axis]);
            let pull = match self.crack.form {
                EmbeddedForm::Optimal => {
                    // This cell's part of the mean; the area of the whole jump is at its other factor.
                    pull_of(links, cut, scene, &normal) / cell.volume
                }
                EmbeddedForm::Local(elastic) => {
                    let nodes = cut.nodes.iter().zip(&cell.middle);
                    for (&(node, _), gradient) in nodes {
                        cell.after.gradient += displacement[node as usize] * gradient.transpose();
                    }
                    let opening = normal * (normal.dot(&cell.after.jump) / cell.width);
                    let elastic_part = cell.after.gradient - opening * normal.transpose();
                    let traction = traction(&elastic, &elastic_part, &normal);
                    // Sliding meets the stiffness of the law alone.
                    normal * normal.dot(&traction)
                }
            };
            let force = pull * cell.whole - resisting * cell.before.area;
            let mut numbers = [0.0; SUMS];
            numbers[NodeSums::<D>::FORCE..NodeSums::<D>::FORCE + D]
                .copy_from_slice(force.as_slice());
            sums.add(cut.node as usize, &numbers);
        }
        Ok(())
    }

    /// Energy that the crack has dissipated since the start of the step, and what it stores, J.
    pub(super) fn energies(&self, totals: &mut SweepTotals) {
        let law = &self.crack.law;
        for cell in &self.cells {
            let area = cell.before.area;
            let spent = cell.after.law.dissipated_fraction - cell.before.law.dissipated_fraction;
            totals.dissipated += area * law.toughness * spent;
            // The old state is the new one: nothing is dissipated twice.
            if let Ok(now) = answer(law, &cell.after.jump, &self.normal, &cell.after.law) {
                totals.stored += area * now.stored;
            }
        }
    }

    /// Rows and columns of the jumps in the stiffness.
    pub(super) fn blocks(
        &self,
        links: &Links<D>,
        scene: &Scene<D>,
        tangents: &[Vec<Tangent>],
    ) -> Vec<Block<D>> {
        let mut blocks = Vec::new();
        let normal = self.normal;
        for (cut, cell) in links.cuts.iter().zip(&self.cells) {
            let patch = links.patch(cut.patch);
            let PatchRates { forces, tractions } = patch_rates(&patch, scene, tangents, &normal);
            let count = patch.nodes.len();
            let own = cut.number as usize;
            let area = cell.before.area;
            let mut of_jump = cell.tangent * area;
            for (place, &node) in patch.nodes.iter().enumerate() {
                let node = node as usize;
                // Nodes beyond count as u − w.
                let mut by_jump = SMatrix::zeros();
                for (other, &(_, beyond)) in cut.nodes.iter().enumerate() {
                    if beyond {
                        by_jump -= forces[place * count + other];
                    }
                }
                blocks.push(Block {
                    row: node,
                    column: own,
                    block: by_jump,
                });
                let by_node = match self.crack.form {
                    EmbeddedForm::Optimal => {
                        let rate = tractions[place] * (cell.whole / cell.volume);
                        if cut.nodes[place].1 {
                            of_jump += rate;
                        }
                        -rate
                    }
                    EmbeddedForm::Local(elastic) => {
                        let rate: [SVector<f64, D>; D] = std::array::from_fn(|axis| {
                            let mut unit = SVector::<f64, D>::zeros();
                            unit[axis] = 1.0;
                            let gradient = unit * cell.middle[place].transpose();
                            traction(&elastic, &gradient, &normal)
                        });
                        normal * normal.transpose() * SMatrix::from_columns(&rate) * -area
                    }
                };
                blocks.push(Block {
                    row: own,
                    column: node,
                    block: by_node,
                });
            }
            if let EmbeddedForm::Local(elastic) = self.crack.form {
                let across = normal * normal.transpose();
                of_jump += across * (area * elastic.p_wave_modulus() / cell.width);
            }
            blocks.push(Block {
                row: own,
                column: own,
                block: of_jump,
            });
        }
        blocks
    }

    /// Takes up an accepted step.
    pub(super) fn keep(&mut self) {
        for cell in &self.cells {
            self.histories.insert(cell.corner, cell.after);
        }
    }

    /// The crack cell by cell.
    pub(super) fn jumps(&self, grid: &Grid<D>) -> Vec<EmbeddedJump> {
        let corner = |cell: &[i32; D]| {
            std::array::from_fn(|axis| {
                let axis = axis.min(D - 1);
                grid.origin()[axis] + grid.spacing() * f64::from(cell[axis])
            })
        };
        let histories = self.histories.iter();
        histories
            .map(|(cell, history)| EmbeddedJump {
                corner: corner(cell),
                jump: std::array::from_fn(|axis| history.jump[axis.min(D - 1)]),
                dissipated_fraction: history.law.dissipated_fraction,
                area: history.area,
            })
            .collect()
    }

    /// What a restarted run needs.
    pub(super) fn memory(&self) -> Vec<f64> {
        let mut memory = vec![self.histories.len() as f64];
        for (corner, history) in &self.histories {
            memory.extend(corner.iter().map(|&i| f64::from(i)));
            memory.extend(history.jump.iter());
            memory.extend(history.gradient.iter());
            let law = &history.law;
            memory.extend([law.largest, law.dissipated_fraction]);
            memory.push(f64::from(u8::from(law.failed)));
            memory.push(history.area);
        }
        memory
    }

    /// Takes back what [`memory`](Self::memory) gave.
    pub(super) fn recall(&mut self, memory: &[f64]) {
        self.histories.clear();
        let rest = memory.get(1..).unwrap_or(&[]);
        for entry in rest.chunks_exact(2 * D + D * D + 4) {
            let (corner, entry) = entry.split_at(D);
            let (jump, entry) = entry.split_at(D);
            let (gradient, entry) = entry.split_at(D * D);
            let history = History {
                jump: SVector::from_column_slice(jump),
                gradient: SMatrix::from_column_slice(gradient),
                law: TractionSeparationState {
                    largest: entry[0],
                    dissipated_fraction: entry[1],
                    failed: entry[2] != 0.0,
                },
                area: entry[3],
            };
            let corner = std::array::from_fn(|axis| corner[axis] as i32);
            self.histories.insert(corner, history);
        }
    }
}

/// Runs of cuts with one jump.
fn groups<const D: usize>(links: &Links<D>) -> Vec<std::ops::Range<usize>> {
    let mut start = 0;
    let chunks = links.cuts.chunk_by(|a, b| a.node == b.node);
    chunks
        .map(|chunk| {
            let range = start..start + chunk.len();
            start = range.end;
            range
        })
        .collect()
}

/// Tractions of the particles of a cell times their volumes, N·m.
fn pull_of<const D: usize>(
    links: &Links<D>,
    cut: &Cut,
    scene: &Scene<D>,
    normal: &SVector<f64, D>,
) -> SVector<f64, D> {
    let mut sum = SVector::zeros();
    for member in links.patch(cut.patch).members {
        let particles = scene.bodies()[member.body as usize].particles();
        let row = member.index as usize;
        let volume =
            particles.volume[row] * particles.trial.deformation_gradient[row].determinant();
        let stress = particles.trial.stress[row].to_matrix();
        sum += SMatrix::<f64, D, D>::from_fn(|i, j| stress[(i, j)]) * normal * volume;
    }
    sum
}
