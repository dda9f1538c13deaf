//! Laws between the faces of cracks, at the nodes that the cracks split.
//!
//! The two fields of such a node have the jump `w` of their displacements, the plus field's less the minus one's, and the
//! area
//!
//! ```text
//! A = ½ (a⁻ − a⁺)·n,    a = Σ_p J V ∇N                                                                (1)
//! ```
//!
//! with sums over the particles of each field: the same that give the internal forces, so that a uniform stress `σ_nn` is
//! in equilibrium with the traction `σ_nn` wherever in its cells the crack lies. The plus field feels `−A t(w)`, the minus
//! field `A t(w)`. Nodes without area (A ≤ 0) feel nothing.
//!
//! Jumps and states are kept with the crack, by the place of the node ([`FacePoint`]). A node that is split for the first
//! time takes its jump from the crack's vertices and its state from the nearest place that has one, within
//! [`NEAR`] cells: where material moves over the grid its history follows from node to node.

use fissure_grid::{Shape, Stencil};
use fissure_scene::{Bond, BondAnswer, FacePoint, Scene};
use nalgebra::{Matrix2, SMatrix, SVector, Vector2};

use crate::groups::plane;
use crate::release::Tie;
use crate::transfers::Transfers;

/// How far from a node, in cells, its history may come from.
const NEAR: f64 = 1.5;
/// Two places are one if they are as near as this, in cells.
const SAME: f64 = 1e-6;

/// Most iterations for the way of two fields in an explicit step.
const ROUNDS: usize = 30;
/// What they may leave of that.
const CLOSE: f64 = 1e-13;
/// Least share of a correction.
const LEAST: f64 = 1e-3;

/// Impulses on the plus field of a glued node, kg·m/s.
pub(crate) struct HeldBy<const D: usize> {
    /// Of the spring near a tip.
    pub tie: SVector<f64, D>,
    /// Of the law between the faces.
    pub glue: SVector<f64, D>,
}

/// Sums `a` of (1) at all nodes, m²; empty where no crack is bonded.
///
/// # Errors
/// Body and index of a particle off the grid.
pub(crate) fn areas<S: Shape<D>, const D: usize>(
    transfers: &Transfers<'_, S, D>,
    scene: &Scene<D>,
) -> Result<Vec<SVector<f64, D>>, (usize, usize)> {
    let placement = transfers.placement;
    if !scene.has_bonds() || placement.splits.copies.is_empty() {
        return Ok(Vec::new());
    }
    let mut sums = vec![SVector::zeros(); placement.node_count()];
    for (body_index, body) in scene.bodies().iter().enumerate() {
        let particles = body.particles();
        for run in &placement.runs[body_index] {
            if placement.split_window(run.window).is_none() {
                continue;
            }
            let nodes = placement.nodes(run.window);
            let window = placement.window(run.window);
            for index in run.start as usize..run.end as usize {
                let stencil = transfers.stencil(body, &window, index);
                let stencil = stencil.ok_or((body_index, index))?;
                let f = &particles.motion.deformation_gradient[index];
                let volume = particles.volume[index] * f.determinant();
                stencil.visit(|entry, _, gradient| sums[nodes.node(entry)] += gradient * volume);
            }
        }
    }
    Ok(sums)
}

/// What a law holds the two fields of a node together by.
#[derive(Clone, Debug)]
pub(crate) struct Glue<const D: usize> {
    bond: Bond,
    /// To the plus side.
    normal: Vector2<f64>,
    /// m².
    area: f64,
    /// At the start of the step.
    point: FacePoint,
}

/// What a step did to a node that is glued.
#[derive(Clone, Debug, Default)]
pub(crate) struct GlueStep {
    pub point: FacePoint,
    /// Work on the mean traction of the step, J.
    pub work: f64,
    /// Now, J.
    pub stored: f64,
    /// In the step, J.
    pub dissipated: f64,
}

impl<const D: usize> Glue<D> {
    /// The glue of the fields on the minus and on the plus side at `x`, with the sums of [`areas`].
    pub(crate) fn at(
        scene: &Scene<D>,
        crack: usize,
        x: &SVector<f64, D>,
        [minus, plus]: [usize; 2],
        sums: &[SVector<f64, D>],
        spacing: f64,
    ) -> Option<Self> {
        let bond = scene.bond_of(crack)?;
        let line = &scene.cracks()[crack];
        let place = plane(x);
        let (normal, jump) = line.face_at(&place);
        let area = 0.5 * plane(&(sums.get(minus)? - sums.get(plus)?)).dot(&normal);
        if !(area > 0.0 && bond.acts_at(&line.placed_at(&place))) {
            return None;
        }
        let distance = |point: &FacePoint| (point.place - place).norm() / spacing;
        let nearest = line
            .bonded()
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let mut point = FacePoint {
            place,
            jump,
            ..FacePoint::default()
        };
        match nearest.map(|known| (known, distance(known))) {
            Some((known, way)) if way < SAME => point.clone_from(known),
            Some((known, way)) if way < NEAR => {
                point.dissipated = known.dissipated;
                point.state.clone_from(&known.state);
            }
            _ => {}
        }
        point.area = area;
        Some(Self {
            bond: bond.clone(),
            normal,
            area,
            point,
        })
    }

    /// Force on the plus field, N, and its derivative with the sign turned, N/m, when that has moved by `way` against the
    /// minus field in the step; NaN if the law refuses.
    pub(crate) fn force(&self, way: &SVector<f64, D>) -> (SVector<f64, D>, SMatrix<f64, D, D>) {
        let (traction, tangent) = match self.answer(&plane(way)) {
            Some(found) => (found.traction, found.tangent),
            None => (Vector2::repeat(f64::NAN), Matrix2::repeat(f64::NAN)),
        };
        let (mut force, mut stiffness) = (SVector::zeros(), SMatrix::zeros());
        for i in 0..2 {
            force[i] = -self.area * traction[i];
            for j in 0..2 {
                stiffness[(i, j)] = self.area * tangent[(i, j)];
            }
        }
        (force, stiffness)
    }

    /// Impulses on the plus field in a step of length `dt` in which nothing but the glue and a spring changes its velocity
    /// `free` against the minus one, kg·m/s: those of the forces at the end of the step. With the jump of the spring's first
    /// field against its second taken times `sign`.
    pub(crate) fn impulse(
        &self,
        free: &SVector<f64, D>,
        (tie, sign): (&Tie<D>, f64),
        reduced_mass: f64,
        dt: f64,
    ) -> HeldBy<D> {
        let (k, beta) = (tie.stiffness, dt * dt / reduced_mass);
        let tie_jump = tie.jump * sign;
        // Of the step's way: way − Δt free + β (k (tie_jump + way) + A t(way)) = 0.
        let open = free * dt;
        let left = |way: &SVector<f64, D>| {
            let (force, stiffness) = self.force(way);
            let left = way - open + ((tie_jump + way) * k - force) * beta;
            let slope = SMatrix::identity() * (1.0 + beta * k) + stiffness * beta;
            (left, slope)
        };
        let mut way = open;
        let (mut residual, mut slope) = left(&way);
        for _ in 0..ROUNDS {
            if residual.norm() <= CLOSE * (open.norm() + tie_jump.norm() + plane(&way).norm()) {
                break;
            }
            let Some(inverse) = slope.try_inverse() else {
                break;
            };
            let change = inverse * residual;
            // Halved while it leaves more: the envelope of a law has a corner.
            let mut share = 1.0;
            loop {
                let next = way - change * share;
                let (left, steep) = left(&next);
                if left.norm() < residual.norm() || share < LEAST {
                    (way, residual, slope) = (next, left, steep);
                    break;
                }
                share *= 0.5;
            }
        }
        HeldBy {
            tie: (tie_jump + way) * (-k * dt),
            glue: self.force(&way).0 * dt,
        }
    }

    fn answer(&self, way: &Vector2<f64>) -> Option<BondAnswer> {
        let jump = self.point.jump + way;
        let answer = self.bond.answer(&jump, &self.normal, &self.point.state);
        answer.ok()
    }

    /// What a step in which the plus field moves by `way` against the minus one leaves; `None` if the law refuses.
    pub(crate) fn after(&self, way: &SVector<f64, D>) -> Option<GlueStep> {
        let way = plane(way);
        let (before, now) = (self.answer(&Vector2::zeros())?, self.answer(&way)?);
        Some(GlueStep {
            work: self.area * 0.5 * (before.traction + now.traction).dot(&way),
            stored: self.area * now.stored,
            dissipated: self.area * now.dissipated,
            point: FacePoint {
                jump: self.point.jump + way,
                dissipated: self.point.dissipated + now.dissipated,
                state: now.state,
                ..self.point.clone()
            },
        })
    }
}

/// Sum over the glued nodes of a step, and what each crack has to remember.
#[derive(Clone, Debug, Default)]
pub(crate) struct GlueTotals {
    pub work: f64,
    pub stored: f64,
    pub dissipated: f64,
    points: Vec<(usize, FacePoint)>,
}

impl GlueTotals {
    /// Adds a node of this crack.
    pub(crate) fn add(&mut self, crack: usize, step: GlueStep) {
        self.work += step.work;
        self.stored += step.stored;
        self.dissipated += step.dissipated;
        self.points.push((crack, step.point));
    }

    /// Puts down what the cracks remember.
    pub(crate) fn keep<const D: usize>(&mut self, scene: &mut Scene<D>) {
        if !scene.has_bonds() {
            return;
        }
        let points = std::mem::take(&mut self.points);
        for (index, crack) in scene.cracks_mut().iter_mut().enumerate() {
            let own = points.iter().filter(|(of, _)| *of == index);
            crack.set_bonded(own.map(|(_, point)| point.clone()).collect());
        }
    }
}
