//! Nodes that the tip of a crack is passing are released little by little.
//!
//! A node holds one field or two: taken alone, that lets a crack end only where nodes are, up to a cell from its tip. So
//! of a node at which particles are told apart by a crack near one of its tips the two fields are joined by a spring of
//!
//! ```text
//! k = K M t (1/s − 1),   s = a/h + A                                                                 (1)
//! ```
//!
//! with the way `a` along the crack from the node's foot on it to the tip (negative for a node ahead of the tip), the
//! modulus `M = ρ c²` of fast waves near the tip, the thickness `t`, and the cell `h`. With s ≤ 0 the node is not split,
//! with s ≥ 1 its fields are free. In a linear body a node's opening is `w₀ s` if `k = (F₀/w₀)(1/s − 1)` with the force
//! `F₀` that keeps it closed and the opening `w₀` that it has when free: by superposition everything else then goes
//! straight from the one state to the other while the tip crosses a cell, as if nodes were released by a force that
//! falls with the opening (Kobayashi, Emery and Mall 1976). `½ F₀ w₀` is the energy released on a cell, so
//! `F₀/w₀ = (π/16) E′ t` by Irwin's closure integral. `A` is how far behind the first closed node the tip is that its
//! stress intensity speaks of.
//!
//! The spring is elastic. What it holds when a tip moves on is what the crack has cost: grown in steps well below a cell,
//! a crack takes its energy from the grid in the ledger's column of contact, not by waves.

use std::collections::BTreeMap;

use fissure_grid::Grid;
use fissure_scene::{Body, CrackLine, End, EndState, Kinematics, Polyline, Scene, Side};
use nalgebra::{SVector, Vector2};

use crate::groups::plane;

/// `A` of (1).
const AHEAD: f64 = 0.22;
/// `K` of (1): π/16 of E′, which is 0.8 M for Poisson's ratios about 0.3.
const SPRING: f64 = 0.16;

/// The share in [0, 1] to which a crack has released a node at `x`, `s` of (1).
pub(crate) fn released(crack: &CrackLine, x: &Vector2<f64>, spacing: f64) -> f64 {
    if crack.tips().next().is_none() {
        return 1.0;
    }
    let (foot, length) = (crack.line().foot(x), crack.line().length());
    let share = |end: End| {
        let from_end = match end {
            End::First => foot.arc,
            End::Last => length - foot.arc,
        };
        // Past the end the foot is the tip.
        let (tip, ahead) = crack.tip(end);
        let beyond = (x - tip).dot(&ahead).max(0.0);
        let behind = if from_end > 0.0 { from_end } else { -beyond };
        (behind / spacing + AHEAD).clamp(0.0, 1.0)
    };
    crack.tips().map(share).fold(1.0, f64::min)
}

/// A crack as nodes see it: its tips reach `A` of (1) further, so that nodes it has begun to release are told from others.
pub(crate) struct SplittingCrack<'a> {
    crack: &'a CrackLine,
    pub line: Polyline,
    spacing: f64,
}

impl<'a> SplittingCrack<'a> {
    /// All cracks of a scene on a grid of this spacing, m.
    pub(crate) fn all(cracks: &'a [CrackLine], spacing: f64) -> Vec<Self> {
        let lengthened = |crack: &'a CrackLine| {
            let last = crack.line().points().len() - 1;
            let is_tip = |end| crack.end(end) == EndState::Tip;
            let line = crack.line().carried(|(i, x)| match i {
                0 if is_tip(End::First) => x + crack.tip(End::First).1 * (AHEAD * spacing),
                i if i == last && is_tip(End::Last) => {
                    x + crack.tip(End::Last).1 * (AHEAD * spacing)
                }
                _ => *x,
            });
            Self {
                crack,
                line: line.unwrap_or_else(|_| crack.line().clone()),
                spacing,
            }
        };
        cracks.iter().map(lengthened).collect()
    }

    /// The side of a node if the crack separates it from a particle and has begun to release it.
    pub(crate) fn crossing(&self, particle: &Vector2<f64>, node: &Vector2<f64>) -> Option<Side> {
        let side = self.line.crossing(particle, node)?;
        (released(self.crack, node, self.spacing) > 0.0).then_some(side)
    }
}

/// A node by its place in the grid, and the crack that has split it.
type Place<const D: usize> = ([i32; D], usize);

/// The springs of a solver's steps.
#[derive(Debug, Default)]
pub(crate) struct Release<const D: usize> {
    /// Displacement of the plus field less that of the minus one since the node was split, m.
    jumps: BTreeMap<Place<D>, SVector<f64, D>>,
    /// `M t` at each crack, N/m.
    stiffness: Vec<f64>,
    edits: Option<u64>,
}

/// A spring between the fields of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tie<const D: usize> {
    /// N/m; 0 where the node is free.
    pub stiffness: f64,
    /// Of the plus field against the minus one at the start of the step, m.
    pub jump: SVector<f64, D>,
}

impl<const D: usize> Tie<D> {
    /// None.
    pub(crate) fn free() -> Self {
        Self {
            stiffness: 0.0,
            jump: SVector::zeros(),
        }
    }

    /// Impulse on the plus field in a step of length `dt` in which nothing else changes its velocity `free` against the
    /// minus one: that of the force at the end of the step, kg·m/s.
    pub(crate) fn impulse(
        &self,
        free: &SVector<f64, D>,
        reduced_mass: f64,
        dt: f64,
    ) -> SVector<f64, D> {
        let k = self.stiffness;
        (self.jump + free * dt) * (-k * dt / (1.0 + k * dt * dt / reduced_mass))
    }
}

impl<const D: usize> Release<D> {
    /// Takes up what the scene's user has changed.
    pub(crate) fn look(&mut self, scene: &Scene<D>) {
        if self.edits == Some(scene.edits()) {
            return;
        }
        self.edits = Some(scene.edits());
        self.stiffness = scene
            .cracks()
            .iter()
            .map(|crack| thickness(scene, crack) * modulus(scene, crack))
            .collect();
    }

    /// `M t` at a crack, N/m.
    pub(crate) fn stiffness(&self, crack: usize) -> f64 {
        self.stiffness.get(crack).copied().unwrap_or(0.0)
    }

    /// The spring that a crack leaves at a node.
    pub(crate) fn tie(
        &self,
        scene: &Scene<D>,
        grid: &Grid<D>,
        crack: usize,
        x: &SVector<f64, D>,
    ) -> Tie<D> {
        let line = &scene.cracks()[crack];
        let share = released(line, &plane(x), grid.spacing());
        if !(share < 1.0) {
            return Tie::free();
        }
        let place = (index(grid, x), crack);
        let known = self.jumps.get(&place).copied();
        let stiffness = self.stiffness(crack);
        Tie {
            // A node that is all but closed is held as firmly as needed, not more.
            stiffness: SPRING * stiffness * (1.0 / share.max(1e-6) - 1.0),
            jump: known.unwrap_or_else(|| {
                let jump = line.face_at(&plane(x)).1;
                SVector::from_fn(|axis, _| if axis < 2 { jump[axis] } else { 0.0 })
            }),
        }
    }

    /// Keeps these jumps and no others: crack, place of the node (m), jump after the step (m).
    pub(crate) fn keep(
        &mut self,
        grid: &Grid<D>,
        jumps: impl Iterator<Item = (usize, SVector<f64, D>, SVector<f64, D>)>,
    ) {
        self.jumps = jumps
            .map(|(crack, x, jump)| ((index(grid, &x), crack), jump))
            .collect();
    }

    /// What a restarted run needs: how many jumps, and each with its place.
    pub(crate) fn memory(&self) -> Vec<f64> {
        let mut memory = vec![self.jumps.len() as f64];
        for ((index, crack), jump) in &self.jumps {
            memory.extend(index.iter().map(|&i| f64::from(i)));
            memory.push(*crack as f64);
            memory.extend(jump.iter());
        }
        memory
    }

    /// Takes back what [`memory`](Self::memory) gave, and leaves what follows it.
    pub(crate) fn recall<'m>(&mut self, memory: &'m [f64]) -> &'m [f64] {
        self.jumps.clear();
        self.edits = None;
        let Some((&count, rest)) = memory.split_first() else {
            return memory;
        };
        let size = 2 * D + 1;
        let (jumps, rest) = rest.split_at(rest.len().min(count as usize * size));
        for entry in jumps.chunks_exact(size) {
            let index = std::array::from_fn(|axis| entry[axis] as i32);
            let jump = SVector::from_column_slice(&entry[D + 1..]);
            self.jumps.insert((index, entry[D] as usize), jump);
        }
        rest
    }
}

fn index<const D: usize>(grid: &Grid<D>, x: &SVector<f64, D>) -> [i32; D] {
    let origin = grid.origin();
    std::array::from_fn(|axis| ((x[axis] - origin[axis]) / grid.spacing()).round() as i32)
}

/// A tip of a crack, or an end if it has none, m.
fn looked_at(crack: &CrackLine) -> Vector2<f64> {
    let end = crack.tips().next().unwrap_or(End::First);
    crack.tip(end).0
}

/// Length across the plane at a crack, m.
fn thickness<const D: usize>(scene: &Scene<D>, crack: &CrackLine) -> f64 {
    match scene.kinematics() {
        Kinematics::PlaneStrain { thickness } | Kinematics::PlaneStress { thickness } => thickness,
        Kinematics::Axisymmetric => std::f64::consts::TAU * looked_at(crack).x,
        Kinematics::Solid => 0.0,
    }
}

/// ρ c² of the body that is nearest to a crack's tip, Pa.
fn modulus<const D: usize>(scene: &Scene<D>, crack: &CrackLine) -> f64 {
    let tip = looked_at(crack);
    let deforms = |body: &&Body<D>| !body.particles().is_empty() && body.wave_speed() > 0.0;
    let distance = |body: &Body<D>| {
        let places = body.motion().position.iter();
        places
            .map(|x| (plane(x) - tip).norm_squared())
            .fold(f64::INFINITY, f64::min)
    };
    let bodies: Vec<&Body<D>> = scene.bodies().iter().filter(deforms).collect();
    let nearest = match bodies[..] {
        [only] => Some(only),
        _ => bodies
            .into_iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b))),
    };
    nearest.map_or(0.0, |body| {
        let particles = body.particles();
        let (mass, volume) = (particles.mass.iter(), particles.volume.iter());
        mass.sum::<f64>() / volume.sum::<f64>() * body.wave_speed().powi(2)
    })
}
