//! Prescribed velocities, from particles to the nodes they reach.

use fissure_grid::{Grid, Shape, Stencil};
use fissure_particles::ParticleId;
use fissure_scene::{Body, Condition, ConditionKind, Hold, Scene, Selection, SolveError};
use nalgebra::{SMatrix, SVector};

use crate::placement::Placement;

/// A weight below this is round-off: the node is not reached.
const REACHED: f64 = 1e-10;
/// Half the edge of the domain of a point, in cells: from a node no other is reached.
const POINT: f64 = 1e-11;
/// A direction within this (sine) of the held ones adds nothing.
const INDEPENDENT: f64 = 1e-6;

/// A node some of whose velocity components are prescribed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeldNode<const D: usize> {
    pub node: usize,
    pub count: usize,
    /// Orthonormal directions, the first `count` of them held.
    pub directions: [SVector<f64, D>; D],
    /// Prescribed velocity along each, m/s.
    pub speeds: [f64; D],
    /// Condition that prescribes each.
    pub conditions: [usize; D],
    /// The direction along which each condition pushes, a unit vector in the span of `directions`
    /// up to its own: skew to the ones before where two rollers are.
    pushes: [SVector<f64, D>; D],
}

impl<const D: usize> HeldNode<D> {
    fn new(node: usize) -> Self {
        Self {
            node,
            count: 0,
            directions: [SVector::zeros(); D],
            speeds: [0.0; D],
            conditions: [0; D],
            pushes: [SVector::zeros(); D],
        }
    }

    /// Adds `v·direction = speed` unless the held directions already decide it. A roller pushes
    /// along its own `direction`; a clamp (`clamped`), which has no direction of its own, along
    /// what it adds to the held ones.
    fn prescribe(
        &mut self,
        direction: SVector<f64, D>,
        speed: f64,
        condition: usize,
        clamped: bool,
    ) {
        let (mut rest, mut known) = (direction, 0.0);
        for k in 0..self.count {
            let part = self.directions[k].dot(&direction);
            rest -= self.directions[k] * part;
            known += self.speeds[k] * part;
        }
        let length = rest.norm();
        if self.count == D || length <= INDEPENDENT {
            return;
        }
        self.directions[self.count] = rest / length;
        self.pushes[self.count] = if clamped { rest / length } else { direction };
        self.speeds[self.count] = (speed - known) / length;
        self.conditions[self.count] = condition;
        self.count += 1;
    }

    /// The velocity with the held components replaced.
    pub(crate) fn apply(&self, velocity: &SVector<f64, D>) -> SVector<f64, D> {
        let mut v = *velocity;
        for k in 0..self.count {
            v += self.directions[k] * (self.speeds[k] - self.directions[k].dot(velocity));
        }
        v
    }

    /// Force (or impulse) of each held condition, the sum of which is the part of `force` along
    /// the held directions.
    ///
    /// Every condition pushes along its own `n_j` alone: `Σ_j λ_j n_j = Σ_k q_k (q_k·force)` with
    /// `n_j` in the span of `q_1 … q_j`, so the multipliers follow from the last to the first,
    /// `λ_k = (q_k·force − Σ_{j>k} λ_j q_k·n_j) / q_k·n_k`.
    pub(crate) fn reactions(
        &self,
        force: &SVector<f64, D>,
    ) -> impl Iterator<Item = (usize, SVector<f64, D>)> {
        let mut multipliers = [0.0; D];
        for k in (0..self.count).rev() {
            let direction = &self.directions[k];
            let others: f64 = (k + 1..self.count)
                .map(|j| multipliers[j] * direction.dot(&self.pushes[j]))
                .sum();
            multipliers[k] = (direction.dot(force) - others) / direction.dot(&self.pushes[k]);
        }
        (0..self.count).map(move |k| (self.conditions[k], self.pushes[k] * multipliers[k]))
    }
}

/// The held nodes of a step, in ascending order of nodes.
#[derive(Debug, Default)]
pub(crate) struct Constraints<const D: usize> {
    pub held: Vec<HeldNode<D>>,
    /// `(node, condition)` pairs before they are merged; kept for its allocation.
    reached: Vec<(usize, usize)>,
}

impl<const D: usize> Constraints<D> {
    /// Collects the nodes that the conditions of the scene reach now; speeds are those at `time`.
    ///
    /// # Errors
    /// A rigid particle outside the grid.
    pub(crate) fn collect<S: Shape<D>>(
        &mut self,
        scene: &Scene<D>,
        grid: &Grid<D>,
        shape: &S,
        placement: &Placement<D>,
        time: f64,
    ) -> Result<(), SolveError> {
        self.reached.clear();
        for (index, condition) in scene.conditions().iter().enumerate() {
            if let ConditionKind::Velocity { .. } = condition.kind() {
                self.reach(scene, grid, shape, placement, index, condition)?;
            }
        }
        self.reached.sort_unstable();
        self.reached.dedup();
        self.held.clear();
        for group in self.reached.chunk_by(|a, b| a.0 == b.0) {
            let mut node = HeldNode::new(group[0].0);
            for &(_, index) in group {
                let condition = &scene.conditions()[index];
                let ConditionKind::Velocity { hold, speed } = condition.kind() else {
                    continue;
                };
                let direction = hold.direction();
                let clamped = matches!(hold, Hold::All(_));
                node.prescribe(direction, speed.at(time), index, clamped);
                if clamped {
                    for axis in 0..D {
                        let mut across = SVector::zeros();
                        across[axis] = 1.0;
                        // The part along the direction moves with it, the rest stands still.
                        node.prescribe(across, speed.at(time) * direction[axis], index, clamped);
                    }
                }
            }
            self.held.push(node);
        }
        Ok(())
    }

    fn reach<S: Shape<D>>(
        &mut self,
        scene: &Scene<D>,
        grid: &Grid<D>,
        shape: &S,
        placement: &Placement<D>,
        index: usize,
        condition: &Condition<D>,
    ) -> Result<(), SolveError> {
        let mut mark = |x: &SVector<f64, D>, domain: &SMatrix<f64, D, D>| -> Option<()> {
            let window = placement.window_around(grid, shape, x)?;
            let stencil = shape.stencil(grid, &window, x, domain)?;
            stencil.visit_values(|entry, weight| {
                if weight > REACHED {
                    // A node whose tile is not held has no mass either.
                    placement.each_field(&window, entry, |node| self.reached.push((node, index)));
                }
            });
            Some(())
        };
        let outside = |id: u32, x: &SVector<f64, D>| SolveError::Outside {
            body: condition.name().to_owned(),
            id: ParticleId(id),
            position: x.iter().copied().collect(),
            step: scene.step() + 1,
            time: scene.time(),
        };
        match condition.selection() {
            Selection::Rigid {
                position,
                half_edges,
            } => {
                for (row, x) in position.iter().enumerate() {
                    mark(x, half_edges).ok_or_else(|| outside(row as u32, x))?;
                }
            }
            Selection::Places(places) => {
                let point = SMatrix::from_diagonal_element(POINT * grid.spacing());
                for (row, x) in places.iter().enumerate() {
                    mark(x, &point).ok_or_else(|| outside(row as u32, x))?;
                }
            }
            Selection::Body { body, .. } => {
                let body = &scene.bodies()[*body];
                let motion = &body.particles().motion;
                for &row in placement.selected(index) {
                    let row = row as usize;
                    let f = Body::<D>::in_space(&motion.deformation_gradient[row]);
                    let domain = shape.domain(body.half_edges(), &f);
                    let x = &motion.position[row];
                    let id = body.particles().id[row].0;
                    mark(x, &domain).ok_or_else(|| outside(id, x))?;
                }
            }
        }
        Ok(())
    }
}
