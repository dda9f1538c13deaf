//! Opening and sliding of the faces, and the stress intensities they imply.

use fissure_scene::{CrackLine, End};

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

/// K_I and K_II from the opening and sliding at places behind a tip.
///
/// At each place `K(r) = δ E′/8 √(2π/r)`; since `K(r) = K + O(r)`, a straight line fitted by least
/// squares is read at the tip. Places nearer than two cells are better left out: a grid rounds the
/// tip.
///
/// # Errors
/// [`MeasureError::Parameter`] for fewer than two places, a distance that is not positive or twice
/// the same; [`MeasureError::NotFinite`].
pub fn opening_intensity(
    jumps: &[FaceJump],
    elastic: &PlaneElastic,
) -> Result<Intensity, MeasureError> {
    elastic.check()?;
    let refused = |parameter, value, permitted| {
        Err(MeasureError::Parameter {
            parameter,
            value,
            permitted,
        })
    };
    if jumps.len() < 2 {
        return refused("number of places", jumps.len() as f64, "2 or more");
    }
    if let Some(jump) = jumps.iter().find(|jump| !(jump.distance > 0.0)) {
        return refused("distance behind the tip", jump.distance, "> 0");
    }
    let count = jumps.len() as f64;
    let mean = jumps.iter().map(|jump| jump.distance).sum::<f64>() / count;
    let spread: f64 = jumps.iter().map(|j| (j.distance - mean).powi(2)).sum();
    if !(spread > 0.0) {
        return refused("spread of the distances", spread, "> 0");
    }
    let at_tip = |value: &dyn Fn(&FaceJump) -> f64| {
        let terms = jumps.iter().map(|jump| {
            let k = value(jump) / opening_per_intensity(elastic, jump.distance);
            k * (1.0 / count - mean * (jump.distance - mean) / spread)
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
