//! Regions with plane faces: blocks along the axes and half-spaces.

use nalgebra::SVector;

use super::Region;
use super::error::{RegionError, extent, finite, positive};

/// An interval, rectangle or box along the axes: all x with min ≤ x < max in each coordinate.
///
/// The upper faces do not belong to it, so that adjoining blocks never share a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block<const D: usize> {
    /// Least coordinates, m.
    pub min: SVector<f64, D>,
    /// Greatest coordinates, m.
    pub max: SVector<f64, D>,
}

impl<const D: usize> Block<D> {
    /// The block from the corner `min` to the corner `max`, m.
    pub fn new(min: [f64; D], max: [f64; D]) -> Self {
        let (min, max) = (min.into(), max.into());
        Self { min, max }
    }
}

impl<const D: usize> Region<D> for Block<D> {
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
        (self.min, self.max)
    }

    fn contains(&self, x: &SVector<f64, D>) -> bool {
        (0..D).all(|i| self.min[i] <= x[i] && x[i] < self.max[i])
    }

    fn check(&self) -> Result<(), RegionError> {
        extent(self.min.as_slice(), self.max.as_slice())
    }
}

/// All points on the inner side of a plane (a line in 2D), the plane itself included.
///
/// It has no end, so that it is of use only inside an [`Intersection`](super::Intersection) or as
/// what a [`Difference`](super::Difference) takes away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace<const D: usize> {
    /// A point of the plane, m.
    pub point: SVector<f64, D>,
    /// Outward normal of any length.
    pub normal: SVector<f64, D>,
}

impl<const D: usize> HalfSpace<D> {
    /// The half-space which ends at `point` (m) and from which `normal` (of any length) points
    /// outward.
    pub fn new(point: [f64; D], normal: [f64; D]) -> Self {
        let (point, normal) = (point.into(), normal.into());
        Self { point, normal }
    }
}

impl<const D: usize> Region<D> for HalfSpace<D> {
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
        let infinite = SVector::repeat(f64::INFINITY);
        (-infinite, infinite)
    }

    fn contains(&self, x: &SVector<f64, D>) -> bool {
        (x - self.point).dot(&self.normal) <= 0.0
    }

    fn check(&self) -> Result<(), RegionError> {
        finite("point of a half-space, m,", &self.point)?;
        positive("length of the normal of a half-space", self.normal.norm())
    }
}
