//! The geometry of a line of segments in the plane.
//!
//! **Sides.** The line, extended straight past its ends, has a left and a right (CRACKS.md,
//! algorithm 1, step 1). A point belongs to the segment of the extended line it is nearest to and
//! lies on the side of that segment that the exact sign of `orient` says. If its foot is a vertex
//! where the line turns left, the point is on the left if it is to the left of *both* segments; where
//! the line turns right, of *either*. That is the sign of `(x − v)·(n₁ + n₂)`, the bisector normal,
//! for every point whose foot is the vertex. A line whose extensions meet it again (a hook, a spiral)
//! has no two sides beyond that meeting: the nearest piece decides.
//!
//! **Crossings.** The way from `a` to `b` crosses segment `p q` if `a` and `b` are on different
//! sides of `p q` and `p` and `q` on different sides of `a b`. The net number of crossings decides.
//!
//! **Ties.** "On the line counts as plus" is what one gets if the whole line is shifted to its right
//! by less than any number, each vertex along its bisector normal, and all answers are those of the
//! line so shifted (simulation of simplicity, Edelsbrunner and Mücke 1990). So they never contradict
//! one another: a way through a vertex or along a segment crosses or does not, and for a crack
//! through everything a way crosses it if and only if its ends are on different sides.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::CrackError;
use super::predicates::{is_left, meeting, meets_open_box, orient};

/// A side of a crack.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Side {
    /// To the left of the way from the first vertex to the last, or on the line.
    Plus,
    /// To its right.
    Minus,
}

impl Side {
    /// +1 or −1.
    pub fn sign(self) -> f64 {
        match self {
            Self::Plus => 1.0,
            Self::Minus => -1.0,
        }
    }

    fn left(left: bool) -> Self {
        if left { Self::Plus } else { Self::Minus }
    }
}

/// The point of a line that is nearest to some point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// The point on the line, m.
    pub point: Vector2<f64>,
    /// How far away it is, m.
    pub distance: f64,
    /// The segment it is on; at a vertex one of the two.
    pub segment: usize,
    /// Where on that segment: 0 at its start, 1 at its end.
    pub fraction: f64,
    /// Way along the line from its first vertex, m.
    pub arc: f64,
    /// Unit normal towards the plus side; at a kink the bisector of the two segments'.
    pub normal: Vector2<f64>,
}

/// Two or more points joined by segments that meet nowhere else.
///
/// ```
/// use fissure_scene::{Polyline, Side};
/// use nalgebra::Vector2;
///
/// let line = Polyline::new(vec![Vector2::new(0.0, 0.0), Vector2::new(1.0, 0.0), Vector2::new(2.0, 1.0)])?;
/// assert_eq!(line.side(&Vector2::new(0.5, 0.1)), Side::Plus);
/// assert_eq!(line.side(&Vector2::new(5.0, 3.9)), Side::Minus); // of the line past its end
/// // The crack ends before it gets there: nothing separates these two.
/// assert_eq!(line.crossing(&Vector2::new(5.0, 4.1), &Vector2::new(5.0, 3.9)), None);
/// # Ok::<(), fissure_scene::CrackError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Polyline {
    points: Vec<Vector2<f64>>,
}

impl Polyline {
    /// The line through these points, m.
    ///
    /// # Errors
    /// [`CrackError::TooShort`], [`CrackError::NotFinite`], [`CrackError::NoLength`] or
    /// [`CrackError::NotSimple`].
    pub fn new(points: Vec<Vector2<f64>>) -> Result<Self, CrackError> {
        let line = Self { points };
        line.check()?;
        Ok(line)
    }

    /// Its vertices in order, m.
    pub fn points(&self) -> &[Vector2<f64>] {
        &self.points
    }

    /// Number of segments.
    pub fn segments(&self) -> usize {
        self.points.len() - 1
    }

    /// The two ends of segment `i`.
    fn segment(&self, i: usize) -> [&Vector2<f64>; 2] {
        [&self.points[i], &self.points[i + 1]]
    }

    /// Unit vector along segment `i`, which must be below [`segments`](Self::segments).
    pub fn tangent(&self, i: usize) -> Vector2<f64> {
        let [a, b] = self.segment(i);
        (b - a).normalize()
    }

    /// Unit normal of segment `i` towards the plus side.
    pub fn normal(&self, i: usize) -> Vector2<f64> {
        let t = self.tangent(i);
        Vector2::new(-t.y, t.x)
    }

    /// Length, m.
    pub fn length(&self) -> f64 {
        let pairs = self.points.windows(2);
        pairs.map(|pair| (pair[1] - pair[0]).norm()).sum()
    }

    /// Its lowest and highest coordinates, m.
    pub fn bounds(&self) -> [Vector2<f64>; 2] {
        let first = self.points[0];
        let points = self.points.iter();
        points.fold([first, first], |[low, high], p| [low.inf(p), high.sup(p)])
    }

    /// Point and unit tangent at a way `arc` from the first vertex, m; the ends for less than 0 or
    /// more than the length.
    pub fn at(&self, arc: f64) -> (Vector2<f64>, Vector2<f64>) {
        let mut left = arc.max(0.0);
        let last = self.segments() - 1;
        for i in 0..=last {
            let [a, b] = self.segment(i);
            let length = (b - a).norm();
            if left <= length || i == last {
                let tangent = (b - a) / length;
                return (a + tangent * left.min(length), tangent);
            }
            left -= length;
        }
        (self.points[last + 1], self.tangent(last))
    }

    /// The side of the line, extended straight past its ends, on which a point lies.
    pub fn side(&self, x: &Vector2<f64>) -> Side {
        let (i, t) = self.nearest(x, true);
        let left_of = |i: usize| {
            let [a, b] = self.segment(i);
            is_left(a, b, x)
        };
        let at = if t <= 0.0 && i > 0 {
            i - 1
        } else if t >= 1.0 && i + 1 < self.segments() {
            i
        } else {
            return Side::left(left_of(i));
        };
        let ([a, b], [_, c]) = (self.segment(at), self.segment(at + 1));
        Side::left(if is_left(a, b, c) {
            left_of(at) && left_of(at + 1)
        } else {
            left_of(at) || left_of(at + 1)
        })
    }

    /// The nearest point of the line.
    pub fn foot(&self, x: &Vector2<f64>) -> Foot {
        let (segment, fraction) = self.nearest(x, false);
        let [a, b] = self.segment(segment);
        let point = a + (b - a) * fraction;
        let arc: f64 = (0..segment)
            .map(|i| (self.points[i + 1] - self.points[i]).norm())
            .sum();
        let vertex = match fraction {
            t if t <= 0.0 => segment,
            t if t >= 1.0 => segment + 1,
            _ => 0,
        };
        let normal = if vertex > 0 && vertex < self.segments() {
            self.normal_at(vertex)
        } else {
            self.normal(segment)
        };
        Foot {
            point,
            distance: (x - point).norm(),
            segment,
            fraction,
            arc: arc + (b - a).norm() * fraction,
            normal,
        }
    }

    /// The side of the line on which `to` lies if the straight way there from `from` crosses it;
    /// `None` if it does not, or as often forth as back. The line is not extended.
    pub fn crossing(&self, from: &Vector2<f64>, to: &Vector2<f64>) -> Option<Side> {
        let [low, high] = self.bounds();
        let beside = |k: usize| from[k].max(to[k]) < low[k] || from[k].min(to[k]) > high[k];
        if beside(0) || beside(1) {
            return None;
        }
        // One order of the two points, so that a way that just touches an end has one answer.
        let ahead = (from.x, from.y) <= (to.x, to.y);
        let way = if ahead { [from, to] } else { [to, from] };
        let mut net = 0;
        let mut before = self.vertex_is_left(0, way);
        for i in 0..self.segments() {
            let [p, q] = self.segment(i);
            let (left, after) = (is_left(p, q, to), self.vertex_is_left(i + 1, way));
            if left != is_left(p, q, from) && before != after {
                net += if left { 1 } else { -1 };
            }
            before = after;
        }
        (net != 0).then(|| Side::left(net > 0))
    }

    /// Whether vertex `i`, a little to the right of where it is, is to the left of the way from `a`
    /// to `b`.
    fn vertex_is_left(&self, i: usize, [a, b]: [&Vector2<f64>; 2]) -> bool {
        let area = orient(a, b, &self.points[i]);
        if area != 0.0 {
            return area > 0.0;
        }
        (b - a).perp(&self.vertex_normal(i)) <= 0.0
    }

    /// Unit normal at vertex `i`, the bisector of those of its segments; `i` as for a slice.
    pub fn normal_at(&self, i: usize) -> Vector2<f64> {
        self.vertex_normal(i).normalize()
    }

    /// Sum of the normals of the segments that meet in vertex `i`: along their bisector.
    fn vertex_normal(&self, i: usize) -> Vector2<f64> {
        let segments = i.saturating_sub(1)..(i + 1).min(self.segments());
        segments.map(|segment| self.normal(segment)).sum()
    }

    /// Whether the line meets the open box `|x − centre| < half`, component by component (m).
    pub fn meets_box(&self, centre: &Vector2<f64>, half: &Vector2<f64>) -> bool {
        let mut segments = 0..self.segments();
        segments.any(|i| meets_open_box(self.segment(i), centre, half))
    }

    /// Where the straight way from `from` to `to` first touches the line: the point, m, and the
    /// segment.
    pub fn first_meeting(
        &self,
        from: &Vector2<f64>,
        to: &Vector2<f64>,
    ) -> Option<(Vector2<f64>, usize)> {
        let meetings = (0..self.segments())
            .filter_map(|i| meeting([from, to], self.segment(i)).map(|fraction| (fraction, i)));
        let (fraction, segment) = meetings.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((from + (to - from) * fraction, segment))
    }

    /// Refuses points that make no simple line; after [`carried`](Self::carried) or by whoever wants
    /// to know.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn check(&self) -> Result<(), CrackError> {
        let vertices = self.points.len();
        if vertices < 2 {
            return Err(CrackError::TooShort { vertices });
        }
        let finite = |p: &Vector2<f64>| p.x.is_finite() && p.y.is_finite();
        if let Some(vertex) = self.points.iter().position(|p| !finite(p)) {
            return Err(CrackError::NotFinite { vertex });
        }
        (0..self.segments()).try_for_each(|i| self.check_segment(i, i))
    }

    /// Refuses segment `i` if it has no length or meets one of the first `others`.
    fn check_segment(&self, i: usize, others: usize) -> Result<(), CrackError> {
        let [a, b] = self.segment(i);
        if a == b {
            return Err(CrackError::NoLength { segment: i });
        }
        for j in (0..others).filter(|j| *j != i) {
            let [c, d] = self.segment(j);
            let meet = if j.abs_diff(i) == 1 {
                // They share a vertex; more only if one folds back on the other.
                let (shared, x, y) = if j < i { (a, c, b) } else { (b, a, d) };
                orient(x, shared, y) == 0.0 && (x - shared).dot(&(y - shared)) > 0.0
            } else {
                meeting([a, b], [c, d]).is_some()
            };
            if meet {
                let (first, second) = (i.min(j), i.max(j));
                return Err(CrackError::NotSimple { first, second });
            }
        }
        Ok(())
    }

    /// Adds a vertex before the first (`front`) or after the last; nothing is changed if it is
    /// refused.
    pub(super) fn extend(&mut self, front: bool, x: Vector2<f64>) -> Result<(), CrackError> {
        let index = if front { 0 } else { self.points.len() };
        if !(x.x.is_finite() && x.y.is_finite()) {
            return Err(CrackError::NotFinite { vertex: index });
        }
        self.points.insert(index, x);
        let segment = if front { 0 } else { self.segments() - 1 };
        let checked = self.check_segment(segment, self.segments());
        if checked.is_err() {
            self.points.remove(index);
        }
        checked
    }

    /// The same line with every vertex moved to a new place: finite, of no segment without length.
    /// Whether it still is simple is not asked.
    ///
    /// # Errors
    /// [`CrackError::NotFinite`] or [`CrackError::NoLength`].
    pub fn carried(
        &self,
        place: impl FnMut((usize, &Vector2<f64>)) -> Vector2<f64>,
    ) -> Result<Self, CrackError> {
        let points: Vec<_> = self.points.iter().enumerate().map(place).collect();
        let finite = |p: &Vector2<f64>| p.x.is_finite() && p.y.is_finite();
        if let Some(vertex) = points.iter().position(|p| !finite(p)) {
            return Err(CrackError::NotFinite { vertex });
        }
        match points.windows(2).position(|pair| pair[0] == pair[1]) {
            Some(segment) => Err(CrackError::NoLength { segment }),
            None => Ok(Self { points }),
        }
    }

    /// The same line with segments of at most `longest` (m), and of every vertex the segment and the place on it
    /// where it was put.
    pub(super) fn refined(&self, longest: f64) -> (Self, Vec<(usize, f64)>) {
        let mut origins = Vec::with_capacity(self.points.len());
        for i in 0..self.segments() {
            let [a, b] = self.segment(i);
            let pieces = ((b - a).norm() / longest).ceil().max(1.0) as usize;
            origins.extend((0..pieces).map(|k| (i, k as f64 / pieces as f64)));
        }
        origins.push((self.segments(), 0.0));
        let place = |&(i, t): &(usize, f64)| match self.points.get(i + 1) {
            Some(next) if t > 0.0 => self.points[i] * (1.0 - t) + next * t,
            _ => self.points[i],
        };
        let points = origins.iter().map(place).collect();
        (Self { points }, origins)
    }

    /// Segment and place on it of the point nearest to `x`; with `extended`, of the line past its
    /// ends. Of equally near ones the first.
    fn nearest(&self, x: &Vector2<f64>, extended: bool) -> (usize, f64) {
        let last = self.segments() - 1;
        let mut best = (0, 0.0);
        let mut least = f64::INFINITY;
        for i in 0..=last {
            let [a, b] = self.segment(i);
            let way = b - a;
            let mut t = (x - a).dot(&way) / way.norm_squared();
            if !(extended && i == 0) {
                t = t.max(0.0);
            }
            if !(extended && i == last) {
                t = t.min(1.0);
            }
            let square = (x - a - way * t).norm_squared();
            if square < least {
                (best, least) = ((i, t), square);
            }
        }
        best
    }
}
