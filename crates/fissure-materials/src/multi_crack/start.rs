//! Where a further plane may start: the largest failure function at least the threshold angle from
//! the planes there are.
//!
//! If the unrestricted maximum is far enough from all of them, it is that. Else it lies on the cone
//! about one of them: each cone is walked round in steps of 5°, the best allowed point refined, and
//! the best of all cones taken. The stress therefore exceeds the strength only in directions nearer
//! than the threshold to a plane, and a plane starts at the threshold as the stress turns past it,
//! not later with a drop.

use std::f64::consts::TAU;

use fissure_tensor::Vector3;

use super::{Decohesion, Plane, turn::on_cone_rate};
use crate::Initiation;
use fissure_tensor::Sym;

/// Points on a cone.
const POINTS: u32 = 72;

/// The largest failure function and its direction outside the cones; `None` if there is no such
/// direction on them. `threshold` gives `sin²` of the angle to keep from a plane.
pub(super) fn initiation<D: Decohesion>(
    decohesion: &D,
    stress: &Sym,
    planes: &[Plane],
    threshold: impl Fn(&Vector3<f64>, &Plane) -> f64,
) -> Option<Initiation> {
    let free = |normal: &Vector3<f64>| {
        planes.iter().all(|plane| {
            let sine_squared = normal.cross(&plane.normal()).norm_squared();
            sine_squared >= threshold(normal, plane)
        })
    };
    let first = decohesion.initiation(stress);
    if first.value <= 0.0 || free(&first.normal) {
        return Some(first);
    }
    let mut best: Option<Initiation> = None;
    for plane in planes {
        let axis = plane.normal();
        // A hair outside, so that round-off does not put the direction back inside.
        let sine_squared = threshold(&axis, plane) * (1.0 + 1e-9);
        if sine_squared >= 1.0 {
            return None;
        }
        // The direction of the unrestricted maximum starts the walk: it turns with the stress.
        let across = first.normal - axis * axis.dot(&first.normal);
        let Some(side) = across.try_normalize(1e-6).or_else(|| {
            let other = if axis.z.abs() < 0.9 {
                Vector3::z()
            } else {
                Vector3::x()
            };
            axis.cross(&other).try_normalize(0.0)
        }) else {
            continue;
        };
        let third = axis.cross(&side);
        let (sine, cosine) = (sine_squared.sqrt(), (1.0 - sine_squared).sqrt());
        let at = |angle: f64| {
            let (y, x) = angle.sin_cos();
            let normal = axis * cosine + (side * x + third * y) * sine;
            let value = if free(&normal) {
                decohesion.along(stress, &normal)
            } else {
                f64::NEG_INFINITY
            };
            Initiation { value, normal }
        };
        let found = round(at);
        if found.value > best.map_or(f64::NEG_INFINITY, |b| b.value) {
            best = Some(found);
        }
    }
    best
}

/// Change of the normal that [`initiation`] gave with the stress, the turning of the planes, and the `sin²` of the
/// threshold angle, given as value and rate for each.
pub(super) fn normal_rate<D: Decohesion>(
    decohesion: &D,
    stress: [&Sym; 2],
    planes: &[Plane],
    rates: &[Vector3<f64>],
    normal: &Vector3<f64>,
    threshold: impl Fn(&Plane, &Vector3<f64>) -> [f64; 2],
) -> Vector3<f64> {
    if decohesion.initiation(stress[0]).normal == *normal {
        return decohesion.normal_rate(stress[0], stress[1], normal);
    }
    // The cone that it is on.
    let mut best = (f64::INFINITY, Vector3::zeros());
    for (plane, rate) in planes.iter().zip(rates) {
        let axis = plane.normal();
        let [sine_squared, sine_squared_rate] = threshold(plane, rate);
        let gap = (normal.cross(&axis).norm_squared() - sine_squared).abs();
        if gap < best.0 {
            let axes = [&axis, rate];
            best = (
                gap,
                on_cone_rate(decohesion, stress, axes, sine_squared_rate, normal),
            );
        }
    }
    best.1
}

/// The largest value round a cone: a scan, and steps to either side that are halved.
fn round(at: impl Fn(f64) -> Initiation) -> Initiation {
    let step = TAU / f64::from(POINTS);
    let (mut angle, mut best) = (0.0, at(0.0));
    for index in 1..POINTS {
        let here = step * f64::from(index);
        let candidate = at(here);
        if candidate.value > best.value {
            (angle, best) = (here, candidate);
        }
    }
    let mut size = 0.5 * step;
    while size > 1e-9 {
        let (left, right) = (at(angle - size), at(angle + size));
        let (side, candidate) = if left.value > right.value {
            (-size, left)
        } else {
            (size, right)
        };
        if candidate.value > best.value {
            angle += side;
            best = candidate;
        } else {
            size *= 0.5;
        }
    }
    polished(at, angle, best)
}

/// A maximum is flat, so comparing values finds it to the root of round-off only: where it lies
/// between free directions, the zero of the slope finds it to round-off.
fn polished(at: impl Fn(f64) -> Initiation, start: f64, best: Initiation) -> Initiation {
    const H: f64 = 1e-3;
    let mut angle = start;
    for _ in 0..4 {
        let value = |steps: f64| at(angle + steps * H).value;
        let (a, b, c, d) = (value(-2.0), value(-1.0), value(1.0), value(2.0));
        let slope = (8.0 * (c - b) - (d - a)) / (12.0 * H);
        let bend = (16.0 * (b + c) - (a + d) - 30.0 * value(0.0)) / (12.0 * H * H);
        if !(slope.is_finite() && bend < 0.0 && (slope / bend).abs() < H) {
            return best;
        }
        angle -= slope / bend;
    }
    at(angle)
}
