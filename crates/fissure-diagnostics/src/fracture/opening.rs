//! Opening and sliding of the faces, and the stress intensities they imply.

use fissure_scene::{CrackLine, End};

use nalgebra::{Matrix3, Vector3};

use super::near_tip::opening_per_intensity;
use super::{Intensity, PlaneElastic};
use crate::MeasureError;

/// The displacement of one face of a crack against the other at a place behind a tip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FaceJump {
    /// Way along the crack behind the tip, m.
    pub distance: f64,
    /// Opening across the crack, m.
    pub opening: f64,
    /// Sliding along the crack, m: of the face to the left of the tip's direction, that way.
    pub sliding: f64,
}

/// Opening and sliding at the vertices of a crack, from the tip at `end` backwards, as steps have
/// summed them up there ([`CrackLine::jump`]).
pub fn opening_profile(crack: &CrackLine, end: End) -> Vec<FaceJump> {
    let (line, mut way) = (crack.line(), 0.0);
    let vertices = line.points().len();
    let order: Vec<usize> = match end {
        End::First => (0..vertices).collect(),
        End::Last => (0..vertices).rev().collect(),
    };
    let mut last = line.points()[order[0]];
    let profile = order.into_iter().map(|i| {
        let (x, jump) = (line.points()[i], crack.jump()[i]);
        way += (x - last).norm();
        last = x;
        // Seen from either tip the faces and the direction both swap, so the signs do not.
        let normal = line.foot(&x).normal;
        FaceJump {
            distance: way,
            opening: jump.dot(&normal),
            sliding: -normal.perp(&jump),
        }
    });
    profile.collect()
}

/// How far ahead of the tip (m; behind if negative) the faces seem to part: where the parabola through
/// `opening² + sliding²` over the distance, fitted by least squares, is zero. Of Griffith's crack it is
/// the tip exactly. On a grid a crack ends at nodes, up to a cell from where its line does.
///
/// # Errors
/// [`MeasureError::Parameter`] for fewer than three places; [`MeasureError::NotFinite`] if three of
/// them are not different or the parabola has no zero.
pub fn apparent_tip(jumps: &[FaceJump]) -> Result<f64, MeasureError> {
    if jumps.len() < 3 {
        return Err(few(jumps.len(), "3 or more"));
    }
    // In units of the largest distance, so that the sums are of one size.
    let unit = jumps.iter().map(|j| j.distance.abs()).fold(0.0, f64::max);
    let (mut sums, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for jump in jumps {
        let r = jump.distance / unit;
        let powers = Vector3::new(1.0, r, r * r);
        sums += powers * powers.transpose();
        right += powers * (jump.opening.powi(2) + jump.sliding.powi(2));
    }
    let not_finite = MeasureError::NotFinite {
        measure: "the apparent tip",
    };
    let solved = sums.cholesky().ok_or(not_finite.clone())?.solve(&right);
    let (a, b, c) = (solved.x, solved.y, solved.z);
    let ahead = unit * 2.0 * a / (b + (b * b - 4.0 * a * c).sqrt());
    if ahead.is_finite() {
        Ok(ahead)
    } else {
        Err(not_finite)
    }
}

/// K_I and K_II from the opening and sliding at places behind a tip that lies `ahead` (m) of where the
/// distances start: 0, or the [`apparent_tip`].
///
/// At each place `K(r) = δ E′/8 √(2π/r)`; since `K(r) = K + O(r)`, a straight line fitted by least
/// squares is read at the tip. Near the tip `K(r)` is off by `½ ahead/r` where `ahead` is not right, so
/// on a grid take the apparent tip and places a few cells behind it.
///
/// # Errors
/// [`MeasureError::Parameter`] for fewer than two places, a distance to the tip that is not positive
/// or twice the same; [`MeasureError::NotFinite`].
pub fn opening_intensity(
    jumps: &[FaceJump],
    ahead: f64,
    elastic: &PlaneElastic,
) -> Result<Intensity, MeasureError> {
    elastic.check()?;
    if jumps.len() < 2 {
        return Err(few(jumps.len(), "2 or more"));
    }
    let distances = jumps.iter().map(|jump| jump.distance + ahead);
    let places: Vec<(f64, &FaceJump)> = distances.zip(jumps).collect();
    if let Some((distance, _)) = places.iter().find(|(r, _)| !(*r > 0.0)) {
        return Err(refused("distance behind the tip", *distance, "> 0"));
    }
    let count = places.len() as f64;
    let mean = places.iter().map(|(r, _)| r).sum::<f64>() / count;
    let spread: f64 = places.iter().map(|(r, _)| (r - mean).powi(2)).sum();
    if !(spread > 0.0) {
        return Err(refused("spread of the distances", spread, "> 0"));
    }
    let at_tip = |value: &dyn Fn(&FaceJump) -> f64| {
        let terms = places.iter().map(|(r, jump)| {
            let k = value(jump) / opening_per_intensity(elastic, *r);
            k * (1.0 / count - mean * (r - mean) / spread)
        });
        terms.sum::<f64>()
    };
    let (k1, k2) = (at_tip(&|jump| jump.opening), at_tip(&|jump| jump.sliding));
    if k1.is_finite() && k2.is_finite() {
        Ok(Intensity { k1, k2 })
    } else {
        Err(MeasureError::NotFinite { measure: "K" })
    }
}

fn few(places: usize, permitted: &'static str) -> MeasureError {
    refused("number of places", places as f64, permitted)
}

fn refused(parameter: &'static str, value: f64, permitted: &'static str) -> MeasureError {
    MeasureError::Parameter {
        parameter,
        value,
        permitted,
    }
}
