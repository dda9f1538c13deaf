//! Particle columns, regions and the seeding of bodies.

mod affine;
mod error;
mod extra;
mod extra_column;
mod motion;
mod motion_slices;
mod order;
mod particles;
mod seeds;

pub use affine::Affine;
pub use error::{ExtraError, ParticleError};
pub use extra::{Column, Extra};
pub use motion::Motion;
pub use motion_slices::{MotionSlices, MotionSlicesMut};
pub use order::{reorder_column, sort_permutation};
pub use particles::{ParticleId, Particles};
pub use seeds::Seeds;
