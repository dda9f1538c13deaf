//! Random numbers for the strengths of particles: without correlation, or as a field in space.
//!
//! [`WhiteNoise`] gives each particle a number by its id, [`FieldSampler`] draws a
//! [`RandomField`], a function of place. Both are standard normal, mean 0 and variance 1, and
//! functions of a seed and of the id or the place alone: neither threads nor the order of the
//! particles come in. A [`Marginal`] makes positive factors of mean 1 of them. Transcendental
//! functions and transforms are those of Rust crates, without instructions that only some
//! processors have, so a seed gives the same field elsewhere.

mod correlation;
mod embedding;
mod error;
mod field;
mod fourier;
mod marginal;
mod noise;

pub use correlation::Correlation;
pub use embedding::Embedding;
pub use error::FieldError;
pub use field::{FieldSampler, RandomField};
pub use marginal::Marginal;
pub use noise::WhiteNoise;
