//! Polygons in the plane.

use nalgebra::Vector2;

use super::error::{RegionError, finite, positive};
use super::{Region, greatest, least};

/// A simple polygon, its vertices in either sense; the last is joined to the first.
///
/// Membership is by crossings of a ray along +x (even-odd rule) and half-open as that of a
/// [`Block`](super::Block): polygons which share an edge share no point of it. If the polygon
/// crosses itself, what is enclosed twice is outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// Vertices in order, m.
    pub vertices: Vec<Vector2<f64>>,
}

impl Polygon {
    /// The polygon with these vertices, m.
    pub fn new(vertices: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let vertices = vertices.into_iter().map(Vector2::from).collect();
        Self { vertices }
    }

    /// Enclosed area, m²; positive if the vertices go round counter-clockwise.
    pub fn signed_area(&self) -> f64 {
        // Relative to a vertex, so that a polygon far from the origin does not lose its digits.
        let base = self.vertices.first().copied().unwrap_or_default();
        let twice: f64 = self
            .edges()
            .map(|(a, b)| (a - base).perp(&(b - base)))
            .sum();
        0.5 * twice
    }

    fn edges(&self) -> impl Iterator<Item = (Vector2<f64>, Vector2<f64>)> + '_ {
        let ends = self.vertices.iter().cycle().skip(1);
        self.vertices.iter().zip(ends).map(|(a, b)| (*a, *b))
    }
}

impl Region<2> for Polygon {
    fn bounds(&self) -> (Vector2<f64>, Vector2<f64>) {
        let infinite = Vector2::repeat(f64::INFINITY);
        let nothing = (infinite, -infinite);
        self.vertices.iter().fold(nothing, |(min, max), x| {
            (min.zip_map(x, least), max.zip_map(x, greatest))
        })
    }

    fn contains(&self, x: &Vector2<f64>) -> bool {
        let mut inside = false;
        for (a, b) in self.edges() {
            // The lower end first, so that two polygons compute the crossing of a shared edge
            // alike, bit for bit.
            let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
            let straddles = low.y <= x.y && x.y < high.y;
            if straddles && x.x < low.x + (high.x - low.x) * ((x.y - low.y) / (high.y - low.y)) {
                inside = !inside;
            }
        }
        inside
    }

    fn check(&self) -> Result<(), RegionError> {
        let count = self.vertices.len();
        if count < 3 {
            return Err(RegionError::TooFewVertices { count });
        }
        finite(
            "vertex of a polygon, m,",
            self.vertices.iter().flat_map(|x| x.iter()),
        )?;
        positive("area of a polygon, m²,", self.signed_area().abs())
    }
}
