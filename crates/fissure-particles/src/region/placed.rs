//! Regions turned or shifted.

use nalgebra::{Rotation2, Rotation3, SMatrix, SVector, Unit, Vector3};

use super::error::{RegionError, finite};
use super::{Region, greatest, least};

/// A region turned about a point (2D) or an axis (3D).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotated<R, const D: usize> {
    inner: R,
    rotation: SMatrix<f64, D, D>,
    centre: SVector<f64, D>,
}

impl<R: Region<2>> Rotated<R, 2> {
    /// `inner` turned counter-clockwise by `angle` (rad) about `centre` (m).
    pub fn about_point(inner: R, angle: f64, centre: [f64; 2]) -> Self {
        Self {
            inner,
            rotation: Rotation2::new(angle).into_inner(),
            centre: centre.into(),
        }
    }
}

impl<R: Region<3>> Rotated<R, 3> {
    /// `inner` turned by `angle` (rad) about the axis through `point` (m) along `axis` (any
    /// length), right-handed.
    pub fn about_axis(inner: R, angle: f64, point: [f64; 3], axis: [f64; 3]) -> Self {
        // An axis of no length gives NaN, which `check` refuses.
        let axis = Unit::new_normalize(Vector3::from(axis));
        Self {
            inner,
            rotation: Rotation3::from_axis_angle(&axis, angle).into_inner(),
            centre: point.into(),
        }
    }
}

impl<const D: usize, R: Region<D>> Region<D> for Rotated<R, D> {
    /// The box about the turned corners of the inner box; all of space if that has no end.
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
        let infinite = SVector::repeat(f64::INFINITY);
        let (low, high) = self.inner.bounds();
        if low.iter().chain(&high).any(|value| value.is_infinite()) {
            return (-infinite, infinite);
        }
        let nothing = (infinite, -infinite);
        (0..1_usize << D).fold(nothing, |(min, max), corner| {
            let end = |i, _| {
                if corner >> i & 1 == 0 {
                    low[i]
                } else {
                    high[i]
                }
            };
            let corner = SVector::<f64, D>::from_fn(end);
            let turned = self.centre + self.rotation * (corner - self.centre);
            (min.zip_map(&turned, least), max.zip_map(&turned, greatest))
        })
    }

    fn contains(&self, x: &SVector<f64, D>) -> bool {
        let back = self.rotation.tr_mul(&(x - self.centre));
        self.inner.contains(&(self.centre + back))
    }

    fn check(&self) -> Result<(), RegionError> {
        finite("centre of a rotation, m,", &self.centre)?;
        finite("component of a rotation matrix", &self.rotation)?;
        self.inner.check()
    }
}

/// A region shifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Translated<R, const D: usize> {
    inner: R,
    offset: SVector<f64, D>,
}

impl<const D: usize, R: Region<D>> Translated<R, D> {
    /// `inner` shifted by `offset`, m.
    pub fn new(inner: R, offset: [f64; D]) -> Self {
        let offset = offset.into();
        Self { inner, offset }
    }
}

impl<const D: usize, R: Region<D>> Region<D> for Translated<R, D> {
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
        let (min, max) = self.inner.bounds();
        (min + self.offset, max + self.offset)
    }

    fn contains(&self, x: &SVector<f64, D>) -> bool {
        self.inner.contains(&(x - self.offset))
    }

    fn check(&self) -> Result<(), RegionError> {
        finite("offset of a translation, m,", &self.offset)?;
        self.inner.check()
    }
}
