//! What the faces of cracks do to each other in a quasi-static step.
//!
//! At a node with two fields that a crack tells apart, with the displacement `w` of the one on its plus side against the
//! other in the step, the normal `n` to the plus side and the opening `g₀` at the start, the plus field feels
//!
//! ```text
//! p = κ max(−g, 0),   g = g₀ + n·w,                        p n
//! t = −κ (w − (n·w) n), of a length of at most μ p,         t                                        (1)
//! ```
//!
//! and the spring of `release` near a tip and the law between the faces, where there is one (`bonds`); the minus field the
//! opposite. `κ` is a penalty of [`FIRM`] times what a node
//! resists of itself, so faces overlap by that much less than they would. Sticking faces slip by as little in a step, so
//! that no force has to be remembered: what holds them is found anew, by equilibrium. The derivative leaves out how
//! friction follows the pressure, so that the matrix stays symmetric; which faces touch and which slide settles within
//! Newton's iterations. A pair that cannot decide stays closed, even if it is pulled: the fields of a node that a crack
//! grazes may hold a sliver of the material each, with next to no area between them. A crack that is pulled open from
//! one end may come to that too: faces that start in touch part by a few nodes an iteration, with pressure ahead of them that
//! comes and goes, and then balance as if they had healed. Where pairs that cannot decide hold against a pull that is no
//! sliver's when a step has balanced, the whole crack is opened and the step is balanced again from there, in which faces
//! that overlap close as ever. A step in which they come to hold again is none.

use fissure_grid::Shape;
use fissure_scene::Scene;
use nalgebra::{SMatrix, SVector};

use crate::bonds::{Glue, GlueTotals, areas};
use crate::crack_motion::faces;
use crate::equilibrium::links::Links;
use crate::equilibrium::system::Spring;
use crate::nodes::NodeSums;
use crate::release::{Release, Tie};
use crate::transfers::Transfers;

/// Penalty over the modulus of the material times the thickness.
const FIRM: f64 = 1e4;

/// Changes of what a pair does in a step after which it stays closed: it has no part of the crack of its own to decide by.
const UNDECIDED: u8 = 6;

/// Pull on all pairs that stay closed so, over the loads, beyond which they are let go: slivers hold less.
const SLIVERS: f64 = 1e-3;

/// How often they are in a step.
const LETTINGS: u8 = 2;

/// What has to be done about pairs that stay closed though they are pulled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Held {
    /// They hold no more than slivers would.
    Little,
    /// Their cracks were opened: the step is to be balanced again.
    LetGo,
    /// They have been often enough.
    Much,
}

/// Two fields of a node.
#[derive(Clone, Debug)]
struct Pair<const D: usize> {
    /// On the minus and on the plus side.
    nodes: [usize; 2],
    crack: usize,
    /// m.
    place: SVector<f64, D>,
    normal: SVector<f64, D>,
    /// At the start of the step, m.
    gap: f64,
    friction: f64,
    /// N/m.
    penalty: f64,
    tie: Tie<D>,
    glue: Option<Glue<D>>,
    state: State<D>,
    /// Whether particles reach both nodes.
    active: bool,
    /// How often that has changed in the step.
    changes: u8,
    /// Whether it is open the next time it is asked, wherever its faces are.
    let_go: bool,
}

/// What a pair does.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State<const D: usize> {
    Open,
    Stuck,
    /// With the unit vector of the friction on the plus field; zero without friction.
    Sliding(SVector<f64, D>),
}

/// All pairs of a step.
#[derive(Debug, Default)]
pub(super) struct Faces<const D: usize> {
    pairs: Vec<Pair<D>>,
    /// Whether a pair does something else than it did when it was last asked.
    pub changed: bool,
    /// How often pairs were let go in the step.
    lettings: u8,
}

impl<const D: usize> Faces<D> {
    /// Finds the pairs of a step.
    ///
    /// # Errors
    /// Body and index of a particle off the grid.
    pub(super) fn find<S: Shape<D>>(
        &mut self,
        transfers: &Transfers<'_, S, D>,
        scene: &Scene<D>,
        release: &Release<D>,
    ) -> Result<(), (usize, usize)> {
        self.pairs.clear();
        self.lettings = 0;
        if scene.cracks().is_empty() {
            return Ok(());
        }
        let areas = areas(transfers, scene)?;
        let (placement, grid) = (transfers.placement, transfers.grid);
        let splits = &placement.splits;
        for here in splits.nodes() {
            for a in here.clone() {
                for b in a + 1..here.end {
                    let [first, second] = [splits.copies[a], splits.copies[b]];
                    let Some((crack, plus)) = first.label.crack_between(second.label) else {
                        continue;
                    };
                    let mut nodes = [first.node as usize, second.node as usize];
                    if !plus {
                        nodes.swap(0, 1);
                    }
                    let place = placement.node_position(grid, nodes[0]);
                    let line = &scene.cracks()[crack];
                    let (normal, gap) = faces(line, true, &place);
                    self.pairs.push(Pair {
                        nodes,
                        crack,
                        place,
                        normal,
                        gap,
                        friction: line.contact().friction(),
                        penalty: FIRM * release.stiffness(crack),
                        tie: release.tie(scene, grid, crack, &place),
                        glue: Glue::at(scene, crack, &place, nodes, &areas, grid.spacing()),
                        state: State::Open,
                        active: false,
                        changes: 0,
                        let_go: false,
                    });
                }
            }
        }
        Ok(())
    }

    /// The nodes that are joined.
    pub(super) fn joined(&self) -> Vec<[u32; 2]> {
        let pairs = self.pairs.iter();
        pairs
            .map(|pair| pair.nodes.map(|node| node as u32))
            .collect()
    }

    /// Adds the forces that these displacements call for to those at the nodes, and lists their derivatives.
    pub(super) fn add(
        &mut self,
        links: &Links<D>,
        displacement: &[SVector<f64, D>],
        sums: &NodeSums<D>,
        springs: &mut Vec<Spring<D>>,
    ) {
        springs.clear();
        self.changed = false;
        for pair in &mut self.pairs {
            let numbers = pair.nodes.map(|node| links.number(node));
            let [Some(minus), Some(plus)] = numbers else {
                continue;
            };
            pair.active = true;
            let before = pair.state;
            let (mut force, mut stiffness) = pair.answer(displacement);
            if let Some(glue) = &pair.glue {
                let (pull, resists) = glue.force(&pair.way(displacement));
                force += pull;
                stiffness += resists;
            }
            if before != pair.state {
                self.changed = true;
                pair.changes = pair.changes.saturating_add(1);
            }
            sums.add_force(pair.nodes[1], &force);
            sums.add_force(pair.nodes[0], &-force);
            springs.push(Spring {
                numbers: [minus, plus],
                stiffness,
            });
        }
    }

    /// Judges what pairs that stay closed hold against a pull in a state that is balanced under loads of this norm, N.
    pub(super) fn held(&mut self, displacement: &[SVector<f64, D>], loads: f64) -> Held {
        let pulls = self.pairs.iter().map(|pair| pair.pull(displacement));
        let square: f64 = pulls.map(|pull| pull * pull).sum();
        if square.sqrt() <= SLIVERS * loads {
            return Held::Little;
        }
        if self.lettings == LETTINGS {
            return Held::Much;
        }
        self.lettings += 1;
        let pulled = self
            .pairs
            .iter()
            .filter(|pair| pair.pull(displacement) > 0.0);
        let cracks: Vec<usize> = pulled.map(|pair| pair.crack).collect();
        for pair in &mut self.pairs {
            if cracks.contains(&pair.crack) {
                (pair.let_go, pair.changes) = (true, 0);
            }
        }
        Held::LetGo
    }

    /// Work that springs and contact took from the bodies in a step, J: mean of the springs' forces at its start and end, those of contact at its
    /// end, times the way.
    pub(super) fn work(&mut self, displacement: &[SVector<f64, D>]) -> f64 {
        let mut sum = 0.0;
        for pair in self.pairs.iter_mut().filter(|pair| pair.active) {
            let way = pair.way(displacement);
            let (force, _) = pair.answer(displacement);
            sum -= (force - pair.tie.jump * (0.5 * pair.tie.stiffness)
                + (pair.tie.jump + way) * (0.5 * pair.tie.stiffness))
                .dot(&way);
        }
        sum
    }

    /// What the laws between the faces make of a step.
    pub(super) fn glued(&self, displacement: &[SVector<f64, D>]) -> GlueTotals {
        let mut totals = GlueTotals::default();
        for pair in self.pairs.iter().filter(|pair| pair.active) {
            let glue = pair.glue.as_ref();
            if let Some(step) = glue.and_then(|glue| glue.after(&pair.way(displacement))) {
                totals.add(pair.crack, step);
            }
        }
        totals
    }

    /// Jumps of the pairs that are held by springs: crack, place (m), and how far the plus field is from the minus one
    /// after the step (m).
    pub(super) fn tied(
        &self,
        displacement: &[SVector<f64, D>],
    ) -> impl Iterator<Item = (usize, SVector<f64, D>, SVector<f64, D>)> {
        let tied = self
            .pairs
            .iter()
            .filter(|pair| pair.active && pair.tie.stiffness > 0.0);
        tied.map(|pair| {
            (
                pair.crack,
                pair.place,
                pair.tie.jump + pair.way(displacement),
            )
        })
    }
}

impl<const D: usize> Pair<D> {
    /// Of the plus field against the minus one in the step, m.
    fn way(&self, displacement: &[SVector<f64, D>]) -> SVector<f64, D> {
        displacement[self.nodes[1]] - displacement[self.nodes[0]]
    }

    /// What the pair holds against a pull because it cannot decide, N; 0 if it can.
    fn pull(&self, displacement: &[SVector<f64, D>]) -> f64 {
        if !self.active || self.changes < UNDECIDED {
            return 0.0;
        }
        let gap = self.gap + self.normal.dot(&self.way(displacement));
        self.penalty * gap.max(0.0)
    }

    /// Force on the plus field, N, and its derivative with the sign turned, N/m.
    fn answer(
        &mut self,
        displacement: &[SVector<f64, D>],
    ) -> (SVector<f64, D>, SMatrix<f64, D, D>) {
        let (way, n, tie) = (self.way(displacement), self.normal, self.tie);
        let mut force = (tie.jump + way) * -tie.stiffness;
        let mut stiffness = SMatrix::identity() * tie.stiffness;
        let gap = self.gap + n.dot(&way);
        if std::mem::take(&mut self.let_go) || gap > 0.0 && self.changes < UNDECIDED {
            self.state = State::Open;
            return (force, stiffness);
        }
        let kappa = self.penalty;
        let push = -kappa * gap;
        force += n * push;
        stiffness += n * n.transpose() * kappa;
        // Friction without end times no pressure is none. What faces overlap by when they have just met is no pressure yet:
        // as friction it would throw slivers far away.
        let most = if push > 0.0 && self.state != State::Open {
            push * self.friction
        } else {
            0.0
        };
        let along = way - n * n.dot(&way);
        self.state = self.friction_of(&along, most);
        match self.state {
            State::Stuck => {
                force -= along * kappa;
                stiffness += (SMatrix::identity() - n * n.transpose()) * kappa;
            }
            State::Sliding(direction) => force += direction * most,
            State::Open => {}
        }
        (force, stiffness)
    }

    /// Whether faces that touch stick or slide: sticking ones slide when they are held by more than `most` (N), against the
    /// force that held them; sliding ones stick when they have turned.
    fn friction_of(&self, along: &SVector<f64, D>, most: f64) -> State<D> {
        if self.friction == 0.0 {
            return State::Sliding(SVector::zeros());
        }
        match self.state {
            State::Sliding(direction) if direction.dot(along) <= 0.0 => State::Sliding(direction),
            State::Sliding(_) => State::Stuck,
            _ if self.friction.is_infinite() => State::Stuck,
            _ => {
                let held = along * -self.penalty;
                match held.norm() {
                    length if length > most => State::Sliding(held / length),
                    _ => State::Stuck,
                }
            }
        }
    }
}
