//! What can be wrong with a mesh.

use thiserror::Error;

use crate::GridError;

/// Why a mesh was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There is no element.
    #[error("the mesh has no element, must have at least 1")]
    Empty,
    /// A coordinate is infinite or not a number.
    #[error("node {node} is at ({x}, {y}) m, must be finite")]
    NotFinite {
        /// The node, from 0.
        node: usize,
        /// Its first coordinate, m.
        x: f64,
        /// Its second coordinate, m.
        y: f64,
    },
    /// An element names a node that is not there.
    #[error("element {element} has a corner at node {node}, must be below {nodes}")]
    UnknownNode {
        /// The element, from 0.
        element: usize,
        /// The node it names.
        node: u32,
        /// How many nodes there are.
        nodes: usize,
    },
    /// An element is not convex, has corners that coincide or lie on a line, or runs clockwise.
    #[error(
        "element {element} has the Jacobian {jacobian} m² at its corner {corner}, must be > 0: corners run \
         counter-clockwise and every angle is less than 180°"
    )]
    Jacobian {
        /// The element, from 0.
        element: usize,
        /// The corner, from 0.
        corner: usize,
        /// Determinant of the Jacobian matrix there, m².
        jacobian: f64,
    },
    /// More than two elements share a face, or two lie on one side of it.
    #[error(
        "elements {first} and {second} both lie on the same side of the face from node {from} to {to}"
    )]
    SharedSide {
        /// The one element, from 0.
        first: usize,
        /// The other.
        second: usize,
        /// Node at which the face begins.
        from: u32,
        /// Node at which it ends.
        to: u32,
    },
    /// A corner of an element lies in another or on its border without being a corner of it: a hanging node, two nodes at
    /// one place, or elements that overlap.
    #[error("node {node} lies in element {element} or on its border, must be one of its corners")]
    NotConforming {
        /// The node, from 0.
        node: usize,
        /// The element, from 0.
        element: usize,
    },
    /// More nodes or elements than are addressed.
    #[error("the mesh has {count} {what}, must be at most {limit}")]
    TooMany {
        /// What there are so many of.
        what: &'static str,
        /// How many.
        count: usize,
        /// How many are allowed.
        limit: usize,
    },
    /// The box about the mesh cannot be divided by its smallest element.
    #[error("the box about the mesh cannot be divided by its smallest element")]
    Grid(#[from] GridError),
}
