//! Particle columns, regions and the seeding of bodies.
//!
//! - [`Particles`] holds a body in columns: [`ParticleId`], mass, reference volume, the present
//!   [`Motion`] and the trial one, and optional columns of any type in [`Extra`]. A step reads
//!   `motion`, writes `trial` and commits; [`MotionSlicesMut::split_at`] gives disjoint ranges to
//!   threads.
//! - A [`Region`] says which points belong: [`Block`], [`Ball`], [`Cylinder`], [`Polygon`],
//!   [`HalfSpace`], [`Where`] a closure holds, and what [`Compose`] makes of them.
//! - A [`Seeding`] says where in a region particles go: [`Spacing`], [`PerCell`], [`InCell`],
//!   [`Turned`].
//! - [`WhiteNoise`] and [`RandomField`] give random numbers by id and by place, of which a
//!   [`Marginal`] makes factors on strengths.
//!
//! Lengths are in m, masses in kg, stresses in Pa, angles in rad. Space has `D` dimensions, tensors
//! three. Everything here gives the same bits for any number of threads.
//!
//! ```
//! use fissure_particles::{Ball, Block, Compose, Particles, Seeding, Spacing, sort_permutation};
//!
//! // A concrete plate of 60 mm thickness with a hole.
//! let plate = Block::new([0.0, 0.0], [0.2, 0.1]).minus(Ball::new([0.1, 0.05], 0.02));
//! let seeds = Spacing(2.5e-3).seed(&plate)?;
//! let mut particles = Particles::default();
//! particles.extend_from_seeds(&seeds, 2350.0, 0.06)?;
//!
//! // Sorted by columns of cells; ids and all columns go along.
//! let keys: Vec<u64> = particles.motion.position.iter().map(|x| (x.x / 5e-3) as u64).collect();
//! let mut order = Vec::new();
//! sort_permutation(&keys, &mut order);
//! particles.reorder(&order)?;
//!
//! // A step writes the trial and commits it.
//! particles.make_trial();
//! let (old, new) = (particles.motion.slices(), particles.trial.slices_mut());
//! new.velocity.copy_from_slice(old.velocity);
//! particles.commit()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod extra;
mod extra_column;
mod motion;
mod motion_slices;
mod order;
mod particles;
mod random;
mod region;
mod seeding;

pub use error::{ExtraError, ParticleError};
pub use extra::{Column, Extra};
pub use motion::Motion;
pub use motion_slices::{MotionSlices, MotionSlicesMut};
pub use order::{reorder_column, sort_permutation};
pub use particles::{ParticleId, Particles};
pub use random::{
    Correlation, Embedding, FieldError, FieldSampler, Marginal, RandomField, WhiteNoise,
};
pub use region::{
    Ball, Block, Compose, Cylinder, Difference, HalfSpace, Intersection, Polygon, Region,
    RegionError, Rotated, Translated, Union, Where,
};
pub use seeding::{InCell, PerCell, SeedError, Seeding, Seeds, Spacing, Turned};
