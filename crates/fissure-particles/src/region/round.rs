//! Round regions: balls and cylinders.

use nalgebra::{SVector, Vector3};

use super::Region;
use super::error::{RegionError, finite, positive};

/// All points at most a radius from a centre: an interval, disc or ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball<const D: usize> {
    /// Centre, m.
    pub centre: SVector<f64, D>,
    /// Radius, m, greater than 0.
    pub radius: f64,
}

impl<const D: usize> Ball<D> {
    /// The ball about `centre` (m) with `radius` (m).
    pub fn new(centre: [f64; D], radius: f64) -> Self {
        let centre = centre.into();
        Self { centre, radius }
    }
}

impl<const D: usize> Region<D> for Ball<D> {
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
        let half = SVector::repeat(self.radius);
        (self.centre - half, self.centre + half)
    }

    fn contains(&self, x: &SVector<f64, D>) -> bool {
        // Not squared: a negative radius holds nothing.
        (x - self.centre).norm() <= self.radius
    }

    fn check(&self) -> Result<(), RegionError> {
        finite("centre of a ball, m,", &self.centre)?;
        positive("radius of a ball, m,", self.radius)
    }
}

/// A circular cylinder between two points of its axis. The end face at `from` belongs to it and
/// that at `to` does not, so that cylinders put end to end never share a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// First end of the axis, m.
    pub from: Vector3<f64>,
    /// Second end of the axis, m.
    pub to: Vector3<f64>,
    /// Radius, m, greater than 0.
    pub radius: f64,
}

impl Cylinder {
    /// The cylinder whose axis goes from `from` to `to` (m), with `radius` (m).
    pub fn new(from: [f64; 3], to: [f64; 3], radius: f64) -> Self {
        let (from, to) = (from.into(), to.into());
        Self { from, to, radius }
    }
}

impl Region<3> for Cylinder {
    fn bounds(&self) -> (Vector3<f64>, Vector3<f64>) {
        let direction = (self.to - self.from).normalize();
        // Half-width of a disc with this normal along each axis; rounding may push n² above 1.
        let half = direction.map(|n| self.radius * (1.0 - (n * n).clamp(0.0, 1.0)).sqrt());
        let least = self.from.zip_map(&self.to, super::least);
        let greatest = self.from.zip_map(&self.to, super::greatest);
        (least - half, greatest + half)
    }

    fn contains(&self, x: &Vector3<f64>) -> bool {
        let axis = self.to - self.from;
        let offset = x - self.from;
        let length = axis.norm();
        let along = offset.dot(&axis) / length;
        let across = offset - axis * (along / length);
        0.0 <= along && along < length && across.norm() <= self.radius
    }

    fn check(&self) -> Result<(), RegionError> {
        finite("end of a cylinder's axis, m,", &self.from)?;
        finite("end of a cylinder's axis, m,", &self.to)?;
        let length = (self.to - self.from).norm();
        positive("length of a cylinder, m,", length)?;
        positive("radius of a cylinder, m,", self.radius)
    }
}
