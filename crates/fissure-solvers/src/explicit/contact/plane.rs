//! The plane between two clouds of particles.
//!
//! Of all planes between the clouds the one that is farthest from both: its normal is along the shortest way from
//! one convex hull to the other. Only particles that face the other cloud count, so that corners, edges and clouds of
//! unequal width do not tilt it, as they tilt gradients of volume and, less, logistic regression [Nairn, Hammerquist
//! and Smith 2020]. Both were tried here on the frictionless block of `tests/fields/friction.rs`; what they gave, 0.38 and
//! 0.475 g against 0.479, no command prints any more.
//!
//! The way is the point of least norm in the hull of all differences `b − a`, found by Wolfe's algorithm
//! [P. Wolfe 1976, Finding the nearest point in a polytope]: exact after finitely many exchanges of at most D + 1
//! points, in an order that depends on the points alone.

use nalgebra::{SMatrix, SVector};

/// Most points that span the nearest face, in space.
const MOST: usize = 4;
/// Relative progress below which the nearest point is found.
const FOUND: f64 = 1e-10;
/// Exchanges after which the best so far has to do.
const EXCHANGES: usize = 60;

/// Unit normal of the plane between the points of `first` and of `second`, from the first to the second. Where the
/// hulls overlap it is the direction from one middle to the other, or zero.
pub(super) fn normal_between<const D: usize>(
    first: &[SVector<f64, D>],
    second: &[SVector<f64, D>],
) -> SVector<f64, D> {
    let middle = |points: &[SVector<f64, D>]| {
        points.iter().sum::<SVector<f64, D>>() / points.len().max(1) as f64
    };
    let between = middle(second) - middle(first);
    let way = shortest_way(first, second, &between);
    // Round-off of hulls that touch has no direction.
    let way = if way.norm() > 1e-6 * between.norm() {
        way
    } else {
        between
    };
    way.try_normalize(0.0).unwrap_or_else(SVector::zeros)
}

/// The shortest vector from a point of the first hull to one of the second; zero where they overlap.
fn shortest_way<const D: usize>(
    first: &[SVector<f64, D>],
    second: &[SVector<f64, D>],
    start: &SVector<f64, D>,
) -> SVector<f64, D> {
    let Some(vertex) = support(first, second, start) else {
        return SVector::zeros();
    };
    let mut face = Face {
        points: [vertex; MOST],
        weights: [1.0, 0.0, 0.0, 0.0],
        count: 1,
    };
    let mut way = vertex;
    for _ in 0..EXCHANGES {
        let Some(vertex) = support(first, second, &way) else {
            break;
        };
        let square = way.norm_squared();
        let new = face.points[..face.count]
            .iter()
            .all(|point| *point != vertex);
        if !new || !(square - way.dot(&vertex) > FOUND * square) {
            break;
        }
        if !face.exchange(vertex) {
            break;
        }
        way = face.point();
    }
    way
}

/// The difference `b − a` least far along `direction`.
fn support<const D: usize>(
    first: &[SVector<f64, D>],
    second: &[SVector<f64, D>],
    direction: &SVector<f64, D>,
) -> Option<SVector<f64, D>> {
    let farthest = |points: &[SVector<f64, D>], direction: SVector<f64, D>| {
        let mut best: Option<(f64, SVector<f64, D>)> = None;
        for x in points {
            let reach = x.dot(&direction);
            if best.is_none_or(|(farthest, _)| reach > farthest) {
                best = Some((reach, *x));
            }
        }
        best.map(|(_, x)| x)
    };
    Some(farthest(second, -direction)? - farthest(first, *direction)?)
}

/// A simplex whose point of least norm lies inside.
struct Face<const D: usize> {
    points: [SVector<f64, D>; MOST],
    weights: [f64; MOST],
    count: usize,
}

impl<const D: usize> Face<D> {
    fn point(&self) -> SVector<f64, D> {
        let pairs = self.points.iter().zip(&self.weights);
        pairs.take(self.count).map(|(x, w)| x * *w).sum()
    }

    /// Takes a vertex in and drops those that the point of least norm no longer needs; false if
    /// the points are no simplex.
    fn exchange(&mut self, vertex: SVector<f64, D>) -> bool {
        if self.count > D {
            return false;
        }
        self.points[self.count] = vertex;
        self.weights[self.count] = 0.0;
        self.count += 1;
        while let Some(affine) = self.affine_weights() {
            if affine[..self.count].iter().all(|&weight| weight > 0.0) {
                self.weights = affine;
                return true;
            }
            // As far towards the point of the affine hull as weights stay positive.
            let share = |k: usize| self.weights[k] / (self.weights[k] - affine[k]);
            let outside = (0..self.count).filter(|&k| affine[k] <= 0.0);
            let step = outside.map(share).fold(1.0, f64::min);
            for (weight, affine) in self.weights.iter_mut().zip(affine) {
                *weight += step * (affine - *weight);
            }
            let kept = self.drop_weightless();
            if !kept {
                return true;
            }
        }
        false
    }

    /// Weights of the point of least norm in the affine hull: `(PᵀP + s 1 1ᵀ) μ = 1`, scaled to a
    /// sum of one; `None` if the points are no simplex.
    fn affine_weights(&self) -> Option<[f64; MOST]> {
        let scale = self.points[..self.count]
            .iter()
            .map(|x| x.norm_squared())
            .sum::<f64>();
        let matrix = SMatrix::<f64, MOST, MOST>::from_fn(|i, j| {
            if i < self.count && j < self.count {
                self.points[i].dot(&self.points[j]) / scale + 1.0
            } else {
                f64::from(u8::from(i == j))
            }
        });
        let ones = SVector::<f64, MOST>::from_fn(|i, _| f64::from(u8::from(i < self.count)));
        let solved = matrix.cholesky()?.solve(&ones);
        let sum: f64 = solved.iter().take(self.count).sum();
        let affine: [f64; MOST] = std::array::from_fn(|k| solved[k] / sum);
        affine.iter().all(|w| w.is_finite()).then_some(affine)
    }

    /// Removes the points without weight, at least the one of least weight; false if none would be
    /// left.
    fn drop_weightless(&mut self) -> bool {
        let least = self.weights[..self.count]
            .iter()
            .fold(f64::INFINITY, |a, &b| a.min(b));
        let mut kept = 0;
        for k in 0..self.count {
            if self.weights[k] > least.max(0.0) {
                (self.points[kept], self.weights[kept]) = (self.points[k], self.weights[k]);
                kept += 1;
            }
        }
        if kept == 0 {
            return false;
        }
        self.count = kept;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation2, Vector2};

    fn lattice(x: std::ops::Range<i32>, y: std::ops::Range<i32>) -> Vec<Vector2<f64>> {
        let rows = y.flat_map(|j| x.clone().map(move |i| (i, j)));
        rows.map(|(i, j)| Vector2::new(f64::from(i) + 0.5, f64::from(j) + 0.5) * 0.5)
            .collect()
    }

    #[test]
    fn flat_faces_give_their_normal() {
        // A cloud that covers half of the other's width.
        let (below, above) = (lattice(-3..3, -3..0), lattice(0..3, 0..3));
        for angle in [0.0, 0.3, 1.1, 2.9] {
            let turned = |cloud: &[Vector2<f64>]| -> Vec<Vector2<f64>> {
                cloud.iter().map(|x| Rotation2::new(angle) * x).collect()
            };
            let n = normal_between(&turned(&below), &turned(&above));
            let exact = Rotation2::new(angle) * Vector2::y();
            assert!((n - exact).norm() <= 1e-9, "{angle}: {n:?}");
            let back = normal_between(&turned(&above), &turned(&below));
            assert!((n + back).norm() <= 1e-6);
        }
    }

    #[test]
    fn a_corner_that_touches_a_face_has_the_normal_of_the_face() {
        let below = lattice(-4..4, -3..0);
        let wedge: Vec<_> = lattice(0..4, 0..4)
            .iter()
            .map(|x| Rotation2::new(std::f64::consts::FRAC_PI_4) * x)
            .collect();
        let n = normal_between(&below, &wedge);
        assert!((n - Vector2::y()).norm() <= 1e-9, "{n:?}");
    }

    #[test]
    fn clouds_that_are_one_give_no_direction() {
        let cloud = lattice(0..2, 0..2);
        let n = normal_between(&cloud, &cloud);
        assert_eq!(n, Vector2::zeros());
    }

    #[test]
    fn the_way_between_random_clouds_is_the_shortest_in_space() {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
        };
        for _ in 0..200 {
            let mut cloud = |shift: f64| -> Vec<SVector<f64, 3>> {
                let at = |x: f64, y, z| SVector::<f64, 3>::new(x + shift, y, z);
                (0..40).map(|_| at(random(), random(), random())).collect()
            };
            let (a, b) = (cloud(0.0), cloud(1.3));
            let way = shortest_way(&a, &b, &SVector::<f64, 3>::x());
            // Optimal if and only if no difference is nearer along it.
            let nearest = support(&a, &b, &way).unwrap();
            assert!(way.norm() > 0.2 && way.norm() < 1.3);
            assert!(way.norm_squared() - way.dot(&nearest) <= 1e-9, "{way:?}");
        }
    }
}
