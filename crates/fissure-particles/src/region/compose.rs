//! Regions written as a sentence.

use super::{Difference, Intersection, Region, Rotated, Translated, Union};

/// Makes regions of regions; every region has these methods.
///
/// ```
/// use fissure_particles::{Ball, Block, Compose, Region};
///
/// let plate = Block::new([0.0, 0.0], [0.2, 0.1])
///     .minus(Ball::new([0.1, 0.05], 0.02))
///     .rotated(std::f64::consts::FRAC_PI_2, [0.0, 0.0]);
/// assert!(plate.contains(&[-0.01, 0.01].into()));
/// assert!(!plate.contains(&[-0.05, 0.1].into()), "this is the hole");
/// ```
pub trait Compose<const D: usize>: Region<D> + Sized {
    /// The points of this region or the other.
    fn plus<R: Region<D>>(self, other: R) -> Union<Self, R> {
        Union(self, other)
    }

    /// The points of this region which are not in the other.
    fn minus<R: Region<D>>(self, other: R) -> Difference<Self, R> {
        Difference(self, other)
    }

    /// The points of this region which are in the other too.
    fn within<R: Region<D>>(self, other: R) -> Intersection<Self, R> {
        Intersection(self, other)
    }

    /// This region shifted by `offset`, m.
    fn translated(self, offset: [f64; D]) -> Translated<Self, D> {
        Translated::new(self, offset)
    }

    /// This plane region turned counter-clockwise by `angle` (rad) about `centre` (m).
    fn rotated(self, angle: f64, centre: [f64; 2]) -> Rotated<Self, 2>
    where
        Self: Region<2>,
    {
        Rotated::about_point(self, angle, centre)
    }

    /// This region of space turned by `angle` (rad) about the axis through `point` (m) along `axis`
    /// (any length).
    fn rotated_about(self, angle: f64, point: [f64; 3], axis: [f64; 3]) -> Rotated<Self, 3>
    where
        Self: Region<3>,
    {
        Rotated::about_axis(self, angle, point, axis)
    }
}

impl<const D: usize, R: Region<D>> Compose<D> for R {}
