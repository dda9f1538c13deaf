//! The largest value over all planes of a function of Mohr's plane.
//!
//! What a criterion sees of a stress on a plane is often no more than the normal traction `q = Σ σ_i p_i` and the squared
//! traction `r = Σ σ_i² p_i`, with the squares `p_i = n_i²` of the normal's components on the principal axes. Both are
//! linear in `p`, so that planes fill a triangle of the `(q, r)` plane, whose edges are Mohr's three circles. With the
//! derivatives of the function its largest value on an edge is a zero of a slope, found to the last bit; a corner, a
//! principal plane, is found exactly. A grid over the inside, where a maximum needs both derivatives to vanish, is scanned
//! as well, and its best point counts if it beats the edges.

use super::maximise_on_octant;
use crate::crossing::crossing;

/// A function of Mohr's plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnMohr {
    pub value: f64,
    /// ∂/∂q, 1/Pa.
    pub normal: f64,
    /// ∂/∂r, 1/Pa².
    pub squared: f64,
}

/// Intervals of 5° on a circle of Mohr (10° there).
const INTERVALS: u32 = 18;

/// Steps of the grid over the inside of the triangle, along an edge.
const INSIDE: u32 = 9;

/// By how much, of the value, the inside has to be larger.
const ADVANTAGE: f64 = 1e-9;

struct Best {
    value: f64,
    p: [f64; 3],
}

impl Best {
    fn consider(&mut self, value: f64, p: [f64; 3], advantage: f64) {
        if value - advantage * value.abs() > self.value {
            (self.value, self.p) = (value, p);
        }
    }
}

/// The largest value and the squares of the normal's components on the axes of these principal stresses, Pa.
pub(super) fn largest(
    principal: [f64; 3],
    function: impl Fn(f64, f64) -> OnMohr,
) -> (f64, [f64; 3]) {
    let at = |p: [f64; 3]| {
        let sum = |power: i32| (0..3).map(|i| principal[i].powi(power) * p[i]).sum();
        function(sum(1), sum(2))
    };
    let mut best = Best {
        value: f64::NEG_INFINITY,
        p: [1.0, 0.0, 0.0],
    };
    for corner in 0..3 {
        let p = std::array::from_fn(|i| if i == corner { 1.0 } else { 0.0 });
        best.consider(at(p).value, p, 1e-13);
    }
    for (i, j) in [(0, 2), (0, 1), (1, 2)] {
        let (per_normal, per_squared) = (
            principal[i] - principal[j],
            principal[i].powi(2) - principal[j].powi(2),
        );
        let on_edge = |share: f64| {
            let mut p = [0.0; 3];
            (p[i], p[j]) = (share, 1.0 - share);
            p
        };
        let slope = |share: f64| {
            let here = at(on_edge(share));
            here.normal * per_normal + here.squared * per_squared
        };
        let grid = |k: u32| {
            (std::f64::consts::FRAC_PI_2 * f64::from(k) / f64::from(INTERVALS))
                .sin()
                .powi(2)
        };
        let mut before = slope(0.0);
        for k in 1..=INTERVALS {
            let after = slope(if k == INTERVALS { 1.0 } else { grid(k) });
            // Zero at a point of the grid is no rare case: in pure shear the largest value is at 45° exactly.
            if before > 0.0 && after <= 0.0 {
                let ends = [grid(k - 1), grid(k)];
                let [share, _] = crossing(ends, [-before, -after], |share| -slope(share));
                let p = on_edge(share);
                best.consider(at(p).value, p, 1e-13);
            }
            before = after;
        }
    }
    for first in 1..INSIDE - 1 {
        for second in 1..INSIDE - first {
            let [a, b] = [first, second].map(|k| f64::from(k) / f64::from(INSIDE));
            let p = [a, b, 1.0 - a - b];
            best.consider(at(p).value, p, ADVANTAGE);
        }
    }
    if best.p.iter().all(|&p| p > 0.0) {
        let (value, n) = maximise_on_octant(|n| at(n.component_mul(n).into()).value);
        best.consider(value, n.component_mul(&n).into(), 0.0);
    }
    (best.value, best.p)
}
