//! The largest value of a function over directions, where no closed form is known.
//!
//! A function of a direction may have several maxima and flat stretches, so a bisection can miss
//! the largest. A grid is scanned first, its best points at least one and a half grid steps apart
//! are each refined by steps to either side along two tangents, halved when none improves, and the
//! best end wins. The order of the grid decides ties, so equal input gives equal output.

use std::f64::consts::{FRAC_PI_2, PI};

use fissure_tensor::Vector3;

/// Which directions are searched; `n` and `−n` are the same plane.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Domain {
    /// All components not negative: enough for a function of their squares.
    Octant,
    /// All directions.
    HalfSphere,
    /// Those across z.
    Plane,
}

/// Grid points that are refined.
const KEPT: usize = 4;

/// Largest value found of a function of the squares of the components, and where.
pub(super) fn maximise_on_octant(function: impl Fn(&Vector3<f64>) -> f64) -> (f64, Vector3<f64>) {
    maximise(function, Domain::Octant, 18)
}

/// Largest value found and where, with a grid of `parts` steps to the quarter turn.
pub(crate) fn maximise(
    function: impl Fn(&Vector3<f64>) -> f64,
    domain: Domain,
    parts: u32,
) -> (f64, Vector3<f64>) {
    let step = FRAC_PI_2 / f64::from(parts);
    let mut kept = [(f64::NEG_INFINITY, Vector3::z()); KEPT];
    scan(domain, parts, |direction| {
        keep(&mut kept, function(&direction), direction, 1.5 * step);
    });
    let mut best = kept[0];
    for (value, direction) in kept {
        if value == f64::NEG_INFINITY {
            break;
        }
        let refined = refine(&function, (value, direction), step, domain);
        // Ends that differ by round-off are the same maximum seen twice: the first stays.
        if refined.0 > best.0 + 1e-13 * best.0.abs() {
            best = refined;
        }
    }
    polish(&function, best, domain)
}

fn scan(domain: Domain, parts: u32, mut visit: impl FnMut(Vector3<f64>)) {
    let (rows, turn) = match domain {
        Domain::Octant => (0..=parts, FRAC_PI_2),
        Domain::HalfSphere => (0..=parts, 2.0 * PI),
        Domain::Plane => (parts..=parts, PI),
    };
    let columns = (turn / FRAC_PI_2).round() as u32 * parts;
    let last = if matches!(domain, Domain::Octant) {
        columns
    } else {
        columns - 1
    };
    for row in rows {
        let (sine, cosine) = (FRAC_PI_2 * f64::from(row) / f64::from(parts)).sin_cos();
        for column in 0..=last {
            let (y, x) = (turn * f64::from(column) / f64::from(columns)).sin_cos();
            visit(Vector3::new(sine * x, sine * y, cosine));
            if row == 0 {
                break; // one pole
            }
        }
    }
}

/// Puts a point among the best, in descending order, unless a better one is close.
fn keep(kept: &mut [(f64, Vector3<f64>); KEPT], value: f64, direction: Vector3<f64>, apart: f64) {
    if value.is_nan() || value <= kept[KEPT - 1].0 {
        return;
    }
    let near = |other: &Vector3<f64>| direction.dot(other).abs() > apart.cos();
    let found = kept.iter().filter(|(v, _)| *v > f64::NEG_INFINITY);
    if found.clone().any(|(v, d)| *v >= value && near(d)) {
        return;
    }
    let mut entry = (value, direction);
    for slot in kept.iter_mut() {
        let old = *slot;
        if old.0 == f64::NEG_INFINITY {
            *slot = entry;
            return;
        }
        if entry.0 > old.0 {
            *slot = entry;
            if near(&old.1) {
                return; // the new one takes the place of a lesser neighbour
            }
            entry = old;
        }
    }
}

/// Two unit tangents at a direction.
fn tangents(at: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let other = if at.z.abs() < 0.9 {
        Vector3::z()
    } else {
        Vector3::x()
    };
    let first = at.cross(&other).normalize();
    [first, at.cross(&first)]
}

/// A maximum is flat, so comparing values finds it to the root of round-off only. Where the
/// function is smooth, Newton's method on its slopes, differences of fourth order, goes on to
/// round-off.
fn polish(
    function: &impl Fn(&Vector3<f64>) -> f64,
    best: (f64, Vector3<f64>),
    domain: Domain,
) -> (f64, Vector3<f64>) {
    const H: f64 = 2e-3;
    let mut at = best.1;
    for _ in 0..4 {
        let [first, second] = tangents(&at);
        let value =
            |a: f64, b: f64| function(&(at + first * (a * H) + second * (b * H)).normalize());
        let here = value(0.0, 0.0);
        let along = |a: f64, b: f64| {
            let (far_back, back) = (value(-2.0 * a, -2.0 * b), value(-a, -b));
            let (front, far) = (value(a, b), value(2.0 * a, 2.0 * b));
            let slope = (8.0 * (front - back) - (far - far_back)) / 12.0;
            let bend = (16.0 * (front + back) - (far + far_back) - 30.0 * here) / 12.0;
            (slope, bend)
        };
        let (slope, bend) = along(1.0, 0.0);
        let step = if matches!(domain, Domain::Plane) {
            first * (-slope / bend)
        } else {
            let (across, bend_across) = along(0.0, 1.0);
            let mixed =
                0.25 * (value(1.0, 1.0) + value(-1.0, -1.0) - value(1.0, -1.0) - value(-1.0, 1.0));
            let determinant = bend * bend_across - mixed * mixed;
            if !(bend < 0.0 && determinant > 1e-6 * bend * bend_across) {
                return best; // a ridge, or no smooth maximum
            }
            first * ((mixed * across - bend_across * slope) / determinant)
                + second * ((mixed * slope - bend * across) / determinant)
        };
        // Longer than the differences span: not the neighbourhood of a smooth maximum.
        let size = step.norm();
        if !(size < 1.0) {
            return best;
        }
        at = (at + step * H).normalize();
        if size < 1e-12 {
            break;
        }
    }
    let value = function(&at);
    if value >= best.0 - 1e-12 * best.0.abs() {
        (value.max(best.0), at)
    } else {
        best
    }
}

fn refine(
    function: &impl Fn(&Vector3<f64>) -> f64,
    start: (f64, Vector3<f64>),
    step: f64,
    domain: Domain,
) -> (f64, Vector3<f64>) {
    let (mut value, mut at) = start;
    let mut size = 0.5 * step;
    // A maximum is flat: 1e-8 in angle is round-off in value.
    for _ in 0..400 {
        if size < 1e-8 {
            break;
        }
        let [first, second] = tangents(&at);
        let sides = match domain {
            Domain::Plane => [first, -first, first, -first],
            Domain::Octant | Domain::HalfSphere => [first, -first, second, -second],
        };
        let mut improved = false;
        for tangent in sides {
            let next = (at + tangent * size).normalize();
            let there = function(&next);
            if there > value {
                (value, at, improved) = (there, next, true);
                break;
            }
        }
        if !improved {
            size *= 0.5;
        }
    }
    (value, at)
}
