//! Regions of space: which points belong to a body, a condition or a hole.

mod boolean;
mod compose;
mod error;
mod flat;
mod placed;
mod polygon;
mod predicate;
mod round;

use std::sync::Arc;

use nalgebra::SVector;

pub use boolean::{Difference, Intersection, Union};
pub use compose::Compose;
pub use error::RegionError;
pub use flat::{Block, HalfSpace};
pub use placed::{Rotated, Translated};
pub use polygon::Polygon;
pub use predicate::Where;
pub use round::{Ball, Cylinder};

/// A set of points of `D`-dimensional space; coordinates in m.
pub trait Region<const D: usize>: Send + Sync {
    /// Least and greatest coordinates of a box which holds every point of the region; infinite
    /// where it has no end. The box may be larger than needed. A box whose least exceeds its
    /// greatest coordinate holds nothing.
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>);

    /// Whether `x` belongs to the region. A point with a coordinate that is not a number belongs to
    /// none.
    fn contains(&self, x: &SVector<f64, D>) -> bool;

    /// Whether the numbers that make the region are usable. Constructors take any number, so that
    /// regions can be written down without `?`; whoever fills or selects asks here first. A region
    /// made of others asks those.
    ///
    /// # Errors
    /// [`RegionError`] with the first number outside its range.
    fn check(&self) -> Result<(), RegionError> {
        Ok(())
    }
}

macro_rules! region_behind_a_pointer {
    ($($pointer:ty),*) => {$(
        impl<const D: usize, R: Region<D> + ?Sized> Region<D> for $pointer {
            fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
                (**self).bounds()
            }

            fn contains(&self, x: &SVector<f64, D>) -> bool {
                (**self).contains(x)
            }

            fn check(&self) -> Result<(), RegionError> {
                (**self).check()
            }
        }
    )*};
}

region_behind_a_pointer!(&R, Box<R>, Arc<R>);

/// The lesser of two numbers, NaN if either is: `f64::min` would hide it.
fn least(a: f64, b: f64) -> f64 {
    if a < b || a.is_nan() { a } else { b }
}

/// The greater of two numbers, NaN if either is.
fn greatest(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}
