//! Numbers at the nodes: what particles sum to, and the vector fields they gather.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use fissure_grid::{FIELD, SUMS};
use nalgebra::SVector;
use rayon::prelude::*;

/// A nodal vector field: the components, zeros, and in the last place 1 where the node has mass.
pub(crate) type Field = Vec<[f64; FIELD]>;

/// Place of the mark of mass in an element of a [`Field`].
pub(crate) const MASSIVE: usize = FIELD - 1;

/// The vector of a field's element.
#[inline(always)]
pub(crate) fn vector<const D: usize>(element: &[f64; FIELD]) -> SVector<f64, D> {
    SVector::from_fn(|axis, _| element[axis])
}

/// A field's element.
#[inline(always)]
pub(crate) fn element<const D: usize>(v: &SVector<f64, D>, massive: bool) -> [f64; FIELD] {
    let mut element = [0.0; FIELD];
    element[..D].copy_from_slice(v.as_slice());
    element[MASSIVE] = if massive { 1.0 } else { 0.0 };
    element
}

/// Mass, momentum and internal force of every node.
///
/// The tiles of one colour have no node of their windows in common, so that threads never add to
/// one node at a time. The compiler cannot know, so the numbers are atomic; reading and writing
/// them in relaxed order costs what it costs without.
#[derive(Debug, Default)]
pub(crate) struct NodeSums<const D: usize> {
    nodes: Vec<Node>,
}

/// Momentum in the first three places, mass, internal force from the fifth on, as bits.
#[derive(Debug, Default)]
#[repr(align(64))]
struct Node([AtomicU64; SUMS]);

/// Nodes that a thread clears at a time.
const CLEARED: usize = 4096;

impl<const D: usize> NodeSums<D> {
    /// Where the mass stands in what a particle gives.
    pub(crate) const MASS: usize = MASSIVE;
    /// Where the internal force begins.
    pub(crate) const FORCE: usize = FIELD;

    /// Zero at so many nodes.
    pub(crate) fn clear(&mut self, count: usize) {
        self.nodes.resize_with(count, Node::default);
        self.nodes.par_chunks_mut(CLEARED).for_each(|nodes| {
            for node in nodes {
                for number in &mut node.0 {
                    *number.get_mut() = 0;
                }
            }
        });
    }

    /// More nodes, zero.
    #[cfg(feature = "implicit")]
    pub(crate) fn extend(&mut self, count: usize) {
        self.nodes.resize_with(count, Node::default);
    }

    pub(crate) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Adds to a node; one thread at a time.
    #[inline]
    pub(crate) fn add(&self, node: usize, numbers: &[f64; SUMS]) {
        for (sum, number) in self.nodes[node].0.iter().zip(&numbers[..FIELD + D]) {
            let present = f64::from_bits(sum.load(Relaxed));
            sum.store((present + number).to_bits(), Relaxed);
        }
    }

    /// Adds to a node's internal force, N.
    #[cfg(feature = "implicit")]
    pub(crate) fn add_force(&self, node: usize, force: &SVector<f64, D>) {
        let mut numbers = [0.0; SUMS];
        numbers[Self::FORCE..Self::FORCE + D].copy_from_slice(force.as_slice());
        self.add(node, &numbers);
    }

    /// Gives a node another momentum, kg·m/s.
    pub(crate) fn set_momentum(&mut self, node: usize, momentum: &SVector<f64, D>) {
        for (sum, number) in self.nodes[node].0.iter_mut().zip(momentum) {
            *sum.get_mut() = number.to_bits();
        }
    }

    #[inline]
    fn number(&self, node: usize, place: usize) -> f64 {
        f64::from_bits(self.nodes[node].0[place].load(Relaxed))
    }

    /// Mass, kg.
    #[inline]
    pub(crate) fn mass(&self, node: usize) -> f64 {
        self.number(node, Self::MASS)
    }

    /// Momentum, kg·m/s.
    #[inline]
    pub(crate) fn momentum(&self, node: usize) -> SVector<f64, D> {
        SVector::from_fn(|axis, _| self.number(node, axis))
    }

    /// Internal force, N.
    #[inline]
    pub(crate) fn internal_force(&self, node: usize) -> SVector<f64, D> {
        SVector::from_fn(|axis, _| self.number(node, Self::FORCE + axis))
    }

    /// Momentum over mass; a node without mass does not move.
    #[inline]
    pub(crate) fn velocity(&self, node: usize) -> SVector<f64, D> {
        let mass = self.mass(node);
        if mass > 0.0 {
            self.momentum(node) / mass
        } else {
            SVector::zeros()
        }
    }
}
