//! Cracks as lines in the plane: their geometry, what their faces do, how they grow.
//!
//! A [`CrackLine`] is a [`Polyline`] of material points (Nairn's CRAMP: line segments carried by the
//! velocity field) with two ends and a rule for contact of its faces. It knows no grid: solvers ask
//! on which side a particle lies, whether the crack separates a particle from a node, whether it
//! meets a box around a node, and carry it along. A [`GrowthCriterion`] says whether and where a
//! tip moves on.
//!
//! The **plus side** is to the left of the way from the first vertex to the last; normals point to
//! it. Every test of a side uses the exact sign of the area of a triangle (Shewchuk's adaptive
//! predicate, crate `robust`), and a point exactly on a line counts as on its plus side: answers
//! are consistent at vertices and for collinear points, and the same on every machine.

mod bond;
mod building;
mod error;
mod growth;
mod polyline;
mod predicates;
mod surface;

pub use bond::{Bond, BondAnswer, FacePoint};
pub use error::CrackError;
pub use growth::{Grown, Growth, GrowthCriterion, GrowthError, grow_cracks};
pub use polyline::{Foot, Polyline, Side};
pub use surface::{CarriedCrack, CrackLine, CrackSettings, End, EndState, VertexMotion};
