//! Square lattices along the axes, of which a region keeps what lies in it.

use nalgebra::{SMatrix, SVector};

use super::{SeedError, Seeds};
use crate::region::Region;

/// Spacings below this many units in the last place of the coordinates are refused.
const LEAST_ULPS: f64 = 64.0;

/// A lattice of places at origin + (j + ½)·spacing, j integer along each axis.
pub(super) struct Lattice<const D: usize> {
    /// A corner of the sub-cells, m.
    pub(super) origin: SVector<f64, D>,
    /// Edge of the sub-cells, m.
    pub(super) spacing: f64,
}

impl<const D: usize> Lattice<D> {
    /// The places which lie in `region`, the first axis running fastest; each stands for a whole
    /// sub-cell.
    pub(super) fn fill(&self, region: &dyn Region<D>) -> Result<Seeds<D>, SeedError> {
        let (first, count) = self.candidates(region)?;
        let mut position = Vec::new();
        let mut index = [0_u64; D];
        'places: loop {
            // One place more on each side than the box needs: whether a place belongs is for the
            // region alone to say, or rounding could lose a place between two regions that adjoin.
            let x = SVector::from_fn(|i, _| {
                self.origin[i] + (first[i] + index[i] as f64 + 0.5) * self.spacing
            });
            if region.contains(&x) {
                position.push(x);
            }
            for axis in 0..D {
                index[axis] += 1;
                if index[axis] < count[axis] {
                    continue 'places;
                }
                index[axis] = 0;
            }
            break;
        }
        if position.is_empty() {
            let spacing = self.spacing;
            return Err(SeedError::NoParticles { spacing });
        }
        let measure = (0..D).fold(1.0, |measure, _| measure * self.spacing);
        Ok(Seeds {
            volume: vec![measure; position.len()],
            position,
            half_edges: SMatrix::identity() * (0.5 * self.spacing),
        })
    }

    /// First index and number of places along each axis that cover the region's box.
    fn candidates(&self, region: &dyn Region<D>) -> Result<(SVector<f64, D>, [u64; D]), SeedError> {
        let Self { origin, spacing } = self;
        length("particle spacing", *spacing)?;
        finite("origin of the lattice, m,", origin.as_slice())?;
        let (low, high) = finite_bounds(region)?;
        let mut first = SVector::zeros();
        let mut count = [0; D];
        let mut asked = 1.0;
        for axis in 0..D {
            let ends = [low[axis], high[axis]];
            let coordinate = ends.iter().fold(0.0_f64, |greatest, end| {
                greatest.max(end.abs()).max((end - origin[axis]).abs())
            });
            let least = LEAST_ULPS * f64::EPSILON * coordinate;
            let resolved = *spacing >= least;
            if !resolved {
                return Err(SeedError::Unresolved {
                    spacing: *spacing,
                    coordinate,
                    least,
                });
            }
            first[axis] = ((ends[0] - origin[axis]) / spacing).floor() - 1.0;
            let places = ((ends[1] - origin[axis]) / spacing).ceil() + 1.0 - first[axis];
            asked *= places;
            count[axis] = places as u64;
        }
        let few_enough = asked <= f64::from(u32::MAX);
        if !few_enough {
            let limit = u32::MAX;
            return Err(SeedError::TooMany { asked, limit });
        }
        Ok((first, count))
    }
}

/// The box of a region whose numbers are usable and which has an inside and an end.
pub(super) fn finite_bounds<const D: usize>(
    region: &dyn Region<D>,
) -> Result<(SVector<f64, D>, SVector<f64, D>), SeedError> {
    region.check()?;
    let (low, high) = region.bounds();
    for axis in 0..D {
        let (min, max) = (low[axis], high[axis]);
        // The width as well: both ends may be finite and their difference not.
        let usable = min < max && (max - min).is_finite();
        if !usable {
            return Err(SeedError::Bounds { axis, min, max });
        }
    }
    Ok((low, high))
}

/// Refuses a length which is not finite and greater than 0.
pub(super) fn length(quantity: &'static str, value: f64) -> Result<(), SeedError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(SeedError::Length { quantity, value })
}

/// Refuses the first value which is infinite or not a number.
pub(super) fn finite(quantity: &'static str, values: &[f64]) -> Result<(), SeedError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(SeedError::NotFinite { quantity, value }),
        None => Ok(()),
    }
}
