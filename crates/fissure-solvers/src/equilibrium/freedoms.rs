//! What conditions hold of the nodes.

use nalgebra::{SMatrix, SVector};

use super::links::Links;
use crate::constraints::{Constraints, HeldNode};
use crate::linear::BlockMatrix;

/// An active node some of whose components are held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hold<const D: usize> {
    /// Its number among the active nodes.
    pub number: usize,
    /// Orthonormal directions as columns, the held ones first.
    pub directions: SMatrix<f64, D, D>,
    /// How many are held.
    pub held: usize,
}

/// What is held of the active nodes.
#[derive(Debug, Default)]
pub(crate) struct Freedoms<const D: usize> {
    pub holds: Vec<Hold<D>>,
}

impl<const D: usize> Freedoms<D> {
    /// Collects what the conditions hold of the active nodes.
    pub(crate) fn collect(&mut self, links: &Links<D>, constraints: &Constraints<D>) {
        self.holds.clear();
        for held in &constraints.held {
            if let Some(number) = links.number(held.node) {
                self.holds.push(Hold {
                    number,
                    directions: completed(held),
                    held: held.count,
                });
            }
        }
    }

    /// Takes the held components out of a matrix, which is then one of the components along each held
    /// node's own directions; right sides are to be [turned](Self::turn).
    pub(crate) fn take_out(&self, matrix: &mut BlockMatrix<D>) {
        for hold in &self.holds {
            matrix.hold(hold.number, &hold.directions, hold.held);
        }
    }

    /// From components along the axes to those along the held nodes' own directions, with the held ones
    /// zero.
    pub(crate) fn turn(&self, vector: &mut [f64]) {
        for hold in &self.holds {
            let part = &mut vector[D * hold.number..D * (hold.number + 1)];
            let mut turned = hold.directions.tr_mul(&SVector::from_column_slice(part));
            turned.rows_mut(0, hold.held).fill(0.0);
            part.copy_from_slice(turned.as_slice());
        }
    }

    /// Back to components along the axes.
    pub(crate) fn turn_back(&self, vector: &mut [f64]) {
        for hold in &self.holds {
            let part = &mut vector[D * hold.number..D * (hold.number + 1)];
            let turned = hold.directions * SVector::from_column_slice(part);
            part.copy_from_slice(turned.as_slice());
        }
    }

    /// Sum of the squares of the components that are held.
    pub(crate) fn held_square(&self, vector: &[f64]) -> f64 {
        let mut sum = 0.0;
        for hold in &self.holds {
            let part = SVector::from_column_slice(&vector[D * hold.number..D * (hold.number + 1)]);
            let turned = hold.directions.tr_mul(&part);
            sum += turned.rows(0, hold.held).norm_squared();
        }
        sum
    }
}

/// The held directions, completed to an orthonormal basis by Gram and Schmidt.
fn completed<const D: usize>(held: &HeldNode<D>) -> SMatrix<f64, D, D> {
    let mut basis = held.directions;
    for slot in held.count..D {
        // The axis that is left longest after projection is safe to normalise.
        let mut best = SVector::<f64, D>::zeros();
        for axis in SMatrix::<f64, D, D>::identity().column_iter() {
            let mut rest = axis.clone_owned();
            for known in &basis[..slot] {
                rest -= known * known.dot(&axis);
            }
            if rest.norm_squared() > best.norm_squared() {
                best = rest;
            }
        }
        basis[slot] = best.normalize();
    }
    SMatrix::from_columns(&basis)
}
