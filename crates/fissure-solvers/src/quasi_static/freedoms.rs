//! Degrees of freedom of a step: nodes that particles reach, less what conditions hold.

use nalgebra::SVector;

use crate::constraints::{Constraints, HeldNode};

/// Marks a component without an equation.
pub(crate) const NONE: u32 = u32::MAX;

/// The displacement components of a node along its own orthonormal directions: those a condition
/// holds first, free ones after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NodeFreedom<const D: usize> {
    /// Orthonormal directions.
    pub directions: [SVector<f64, D>; D],
    /// How many of them are held.
    pub held: usize,
    /// Equation of each direction, [`NONE`] where there is none.
    pub equations: [u32; D],
    /// Whether any particle reaches the node.
    pub active: bool,
}

/// Degrees of freedom of all nodes.
#[derive(Debug, Default)]
pub(crate) struct Freedoms<const D: usize> {
    pub nodes: Vec<NodeFreedom<D>>,
    /// Number of equations.
    pub count: usize,
}

impl<const D: usize> Freedoms<D> {
    /// Numbers the free components of the active nodes.
    pub(crate) fn number(
        &mut self,
        node_count: usize,
        active: impl Fn(usize) -> bool,
        constraints: &Constraints<D>,
    ) {
        let axes = std::array::from_fn(|axis| {
            let mut direction = SVector::zeros();
            direction[axis] = 1.0;
            direction
        });
        let free = NodeFreedom {
            directions: axes,
            held: 0,
            equations: [NONE; D],
            active: false,
        };
        self.nodes.clear();
        self.nodes.resize(node_count, free);
        for held in &constraints.held {
            let node = &mut self.nodes[held.node];
            node.directions = completed(held, &axes);
            node.held = held.count;
        }
        self.count = 0;
        for (index, node) in self.nodes.iter_mut().enumerate() {
            node.active = active(index);
            if node.active {
                for equation in &mut node.equations[node.held..] {
                    *equation = self.count as u32;
                    self.count += 1;
                }
            }
        }
    }
}

/// The held directions, completed to an orthonormal basis by Gram and Schmidt.
fn completed<const D: usize>(
    held: &HeldNode<D>,
    axes: &[SVector<f64, D>; D],
) -> [SVector<f64, D>; D] {
    let mut basis = held.directions;
    for slot in held.count..D {
        // The axis that is left longest after projection is safe to normalise.
        let mut best = SVector::<f64, D>::zeros();
        for axis in axes {
            let mut rest = *axis;
            for known in &basis[..slot] {
                rest -= known * known.dot(axis);
            }
            if rest.norm_squared() > best.norm_squared() {
                best = rest;
            }
        }
        basis[slot] = best.normalize();
    }
    basis
}
