//! Regions given by a closure.

use std::fmt;

use nalgebra::SVector;

use super::Region;
use super::error::{RegionError, extent};

/// The points of a box for which a closure says yes; half-open as a [`Block`](super::Block).
#[derive(Clone, Copy)]
pub struct Where<const D: usize, F: Fn(&SVector<f64, D>) -> bool + Send + Sync> {
    min: SVector<f64, D>,
    max: SVector<f64, D>,
    holds: F,
}

impl<const D: usize, F: Fn(&SVector<f64, D>) -> bool + Send + Sync> Where<D, F> {
    /// The points x with min ≤ x < max (m) for which `holds` is true.
    ///
    /// ```
    /// use fissure_particles::{Region, Where};
    ///
    /// let under_a_parabola = Where::new([0.0, 0.0], [1.0, 1.0], |x| x.y < x.x * x.x);
    /// assert!(under_a_parabola.contains(&[0.9, 0.8].into()));
    /// assert!(!under_a_parabola.contains(&[0.9, 0.9].into()));
    /// ```
    pub fn new(min: [f64; D], max: [f64; D], holds: F) -> Self {
        let (min, max) = (min.into(), max.into());
        Self { min, max, holds }
    }
}

impl<const D: usize, F: Fn(&SVector<f64, D>) -> bool + Send + Sync> Region<D> for Where<D, F> {
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
        (self.min, self.max)
    }

    fn contains(&self, x: &SVector<f64, D>) -> bool {
        (0..D).all(|i| self.min[i] <= x[i] && x[i] < self.max[i]) && (self.holds)(x)
    }

    fn check(&self) -> Result<(), RegionError> {
        extent(self.min.as_slice(), self.max.as_slice())
    }
}

impl<const D: usize, F: Fn(&SVector<f64, D>) -> bool + Send + Sync> fmt::Debug for Where<D, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Where")
            .field("min", &self.min)
            .field("max", &self.max)
            .finish_non_exhaustive()
    }
}
