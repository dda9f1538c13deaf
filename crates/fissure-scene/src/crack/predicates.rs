//! Exact answers about points, segments and boxes in the plane.

use nalgebra::Vector2;
use robust::{Coord, orient2d};

/// Twice the area of the triangle `a b c`, positive if `c` is to the left of the way from `a` to
/// `b`; its sign is exact.
pub(super) fn orient(a: &Vector2<f64>, b: &Vector2<f64>, c: &Vector2<f64>) -> f64 {
    let coord = |p: &Vector2<f64>| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether `c` is to the left of the line through `a` and `b`, or on it.
pub(super) fn is_left(a: &Vector2<f64>, b: &Vector2<f64>, c: &Vector2<f64>) -> bool {
    orient(a, b, c) >= 0.0
}

/// Where on the closed segment `a b` it first meets the closed segment `c d`: 0 at `a`, 1 at `b`.
pub(super) fn meeting([a, b]: [&Vector2<f64>; 2], [c, d]: [&Vector2<f64>; 2]) -> Option<f64> {
    let (at_a, at_b) = (orient(c, d, a), orient(c, d, b));
    let (at_c, at_d) = (orient(a, b, c), orient(a, b, d));
    if at_a == 0.0 && at_b == 0.0 {
        return collinear_meeting([a, b], [c, d]);
    }
    let apart = |p: f64, q: f64| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
    (!apart(at_a, at_b) && !apart(at_c, at_d)).then(|| (at_a / (at_a - at_b)).clamp(0.0, 1.0))
}

fn collinear_meeting([a, b]: [&Vector2<f64>; 2], [c, d]: [&Vector2<f64>; 2]) -> Option<f64> {
    let way = b - a;
    let square = way.norm_squared();
    let (s, t) = ((c - a).dot(&way) / square, (d - a).dot(&way) / square);
    let (near, far) = (s.min(t), s.max(t));
    (far >= 0.0 && near <= 1.0).then(|| near.max(0.0))
}

/// Whether the closed segment `a b` meets the open box `|x − centre| < half`, component by component.
pub(super) fn meets_open_box(
    [a, b]: [&Vector2<f64>; 2],
    centre: &Vector2<f64>,
    half: &Vector2<f64>,
) -> bool {
    let (low, high) = (centre - half, centre + half);
    let overlaps = |k: usize| a[k].min(b[k]) < high[k] && a[k].max(b[k]) > low[k];
    if !(overlaps(0) && overlaps(1)) {
        return false;
    }
    // Two convex sets are apart if and only if a side of one of them separates them.
    let corners = [
        low,
        Vector2::new(high.x, low.y),
        high,
        Vector2::new(low.x, high.y),
    ];
    let sides = corners.map(|corner| orient(a, b, &corner));
    sides.iter().any(|side| *side > 0.0) && sides.iter().any(|side| *side < 0.0)
}
