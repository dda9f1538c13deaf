//! Regions made of two others.

use nalgebra::SVector;

use super::error::RegionError;
use super::{Region, greatest, least};

/// The points of either region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Union<A, B>(pub A, pub B);

/// The points of the first region which are not in the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference<A, B>(pub A, pub B);

/// The points of both regions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection<A, B>(pub A, pub B);

impl<const D: usize, A: Region<D>, B: Region<D>> Region<D> for Union<A, B> {
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
        let (a, b) = (self.0.bounds(), self.1.bounds());
        (a.0.zip_map(&b.0, least), a.1.zip_map(&b.1, greatest))
    }

    fn contains(&self, x: &SVector<f64, D>) -> bool {
        self.0.contains(x) || self.1.contains(x)
    }

    fn check(&self) -> Result<(), RegionError> {
        self.0.check()?;
        self.1.check()
    }
}

impl<const D: usize, A: Region<D>, B: Region<D>> Region<D> for Difference<A, B> {
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
        self.0.bounds()
    }

    fn contains(&self, x: &SVector<f64, D>) -> bool {
        self.0.contains(x) && !self.1.contains(x)
    }

    fn check(&self) -> Result<(), RegionError> {
        // The second too: a hole of radius NaN would otherwise take nothing away, silently.
        self.0.check()?;
        self.1.check()
    }
}

impl<const D: usize, A: Region<D>, B: Region<D>> Region<D> for Intersection<A, B> {
    fn bounds(&self) -> (SVector<f64, D>, SVector<f64, D>) {
        let (a, b) = (self.0.bounds(), self.1.bounds());
        (a.0.zip_map(&b.0, greatest), a.1.zip_map(&b.1, least))
    }

    fn contains(&self, x: &SVector<f64, D>) -> bool {
        self.0.contains(x) && self.1.contains(x)
    }

    fn check(&self) -> Result<(), RegionError> {
        self.0.check()?;
        self.1.check()
    }
}
