//! Cracks found in a field of failed particles.

use std::collections::{BTreeMap, BTreeSet};

use fissure_scene::{Polyline, Scene};
use nalgebra::Vector2;

use super::field::{named, thickness};
use crate::MeasureError;
use crate::error::check_positive;

/// Which particles have failed and how they make cracks.
///
/// Failed particles nearer to one another than `reach` belong to one crack (connected components).
/// Its centre line joins the centroids of its parts: the particles sorted by the shortest way
/// through the crack from one of its ends, `2 reach` to a part. It follows bends; a branched crack is
/// one component and its line runs between the branches.
#[derive(Clone, Debug, PartialEq)]
pub struct CrackExtraction<'a> {
    /// Name of the body.
    pub body: &'a str,
    /// The value of its law that tells how far a particle has failed.
    pub value: &'a str,
    /// A particle has failed if the value is at least this.
    pub failed: f64,
    /// It has failed in part, and belongs to the wake of the crack, if the value is above this.
    pub partial: f64,
    /// Particles nearer than this belong together, m: 1.5 to 2 times their spacing.
    pub reach: f64,
    /// Components of fewer particles are no cracks.
    pub least: usize,
}

/// A crack found in a field of failed particles. Positions are present ones.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtractedCrack {
    /// Its centre line, m.
    pub line: Polyline,
    /// Mean unit normal: of the straight way between the ends of the line.
    pub normal: Vector2<f64>,
    /// Number of failed particles.
    pub particles: usize,
    /// Rows of failed particles side by side: their reference area over length and spacing.
    pub rows: f64,
    /// Rows of particles that have failed in part and lie nearest to this crack.
    pub partial_rows: f64,
}

/// The cracks of a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExtractedCracks {
    /// Each of them, in the order of the lowest row of their particles.
    pub cracks: Vec<ExtractedCrack>,
}

impl ExtractedCracks {
    /// Number of cracks per length of the body, 1/m.
    ///
    /// # Errors
    /// [`MeasureError::Parameter`] if the length is not positive and finite.
    pub fn density(&self, length: f64) -> Result<f64, MeasureError> {
        check_positive("length of the body", length)?;
        Ok(self.cracks.len() as f64 / length)
    }

    /// Length of all, m.
    pub fn length(&self) -> f64 {
        self.cracks.iter().map(|crack| crack.line.length()).sum()
    }
}

impl CrackExtraction<'_> {
    /// The cracks of the body now.
    ///
    /// # Errors
    /// [`MeasureError::UnknownBody`], [`MeasureError::UnknownValue`], [`MeasureError::Parameter`] for a
    /// reach that is not positive, [`MeasureError::Kinematics`] in an axisymmetric scene.
    pub fn of(&self, scene: &Scene<2>) -> Result<ExtractedCracks, MeasureError> {
        check_positive("reach of the extraction", self.reach)?;
        let thickness = thickness(scene)?;
        let body = named(scene, self.body)?;
        let values = body
            .value(self.value)
            .ok_or_else(|| MeasureError::UnknownValue {
                body: self.body.to_owned(),
                value: self.value.to_owned(),
                present: body.law().names(),
            })?;
        let particles = body.particles();
        let (mut failed, mut partial) = (Vec::new(), Vec::new());
        for (i, value) in values.into_iter().enumerate() {
            let point = Point {
                x: particles.motion.position[i],
                area: particles.volume[i] / thickness,
            };
            if value >= self.failed {
                failed.push(point);
            } else if value > self.partial {
                partial.push(point);
            }
        }
        Ok(self.cracks(&failed, &partial))
    }

    fn cracks(&self, failed: &[Point], partial: &[Point]) -> ExtractedCracks {
        let neighbours = Neighbours::of(failed, self.reach);
        let mut cracks = Vec::new();
        for component in neighbours.components() {
            if component.len() < self.least.max(1) {
                continue;
            }
            let Some(line) = self.centre_line(&component, failed, &neighbours) else {
                continue;
            };
            let (first, last) = (line.points()[0], line.points()[line.segments()]);
            let chord = (last - first).normalize();
            let area: f64 = component.iter().map(|i| failed[*i].area).sum();
            let spacing = (area / component.len() as f64).sqrt();
            cracks.push(ExtractedCrack {
                normal: Vector2::new(-chord.y, chord.x),
                particles: component.len(),
                rows: area / (line.length() * spacing),
                partial_rows: 0.0,
                line,
            });
        }
        for point in partial {
            let away = |crack: &ExtractedCrack| crack.line.foot(&point.x).distance;
            let nearest = cracks
                .iter_mut()
                .map(|crack| (away(crack), crack))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, crack)) = nearest {
                crack.partial_rows += point.area.sqrt() / crack.line.length();
            }
        }
        ExtractedCracks { cracks }
    }

    /// The centre line of a component, from edge to edge of its particles.
    fn centre_line(
        &self,
        component: &[usize],
        points: &[Point],
        neighbours: &Neighbours,
    ) -> Option<Polyline> {
        let start = neighbours.farthest(component[0], points).0;
        let (_, way) = neighbours.farthest(start, points);
        let mut parts: BTreeMap<u64, (Vector2<f64>, f64)> = BTreeMap::new();
        for i in component {
            let part = (way.get(i)? / (2.0 * self.reach)) as u64;
            let (sum, area) = parts.entry(part).or_default();
            *sum += points[*i].x * points[*i].area;
            *area += points[*i].area;
        }
        let mut line: Vec<Vector2<f64>> = parts.values().map(|(sum, area)| sum / *area).collect();
        if line.len() < 2 {
            line = longest_axis(component, points);
        }
        // Each end as far out as its particles reach.
        for end in [0, line.len() - 1] {
            let inner = if end == 0 { line[1] } else { line[end - 1] };
            let out = (line[end] - inner).try_normalize(0.0)?;
            let mut reach = 0.0f64;
            for i in component {
                let from = points[*i].x - line[end];
                // Of the particles of this end only.
                if from.norm() < 4.0 * self.reach {
                    reach = reach.max(from.dot(&out) + 0.5 * points[*i].area.sqrt());
                }
            }
            line[end] += out * reach;
        }
        let chord = vec![line[0], line[line.len() - 1]];
        Polyline::new(line).or_else(|_| Polyline::new(chord)).ok()
    }
}

/// A failed particle.
#[derive(Clone, Copy)]
struct Point {
    x: Vector2<f64>,
    area: f64,
}

/// Two points along the longest axis of a few particles, about their centroid; along the first axis
/// if there is none.
fn longest_axis(component: &[usize], points: &[Point]) -> Vec<Vector2<f64>> {
    let area: f64 = component.iter().map(|i| points[*i].area).sum();
    let sums = component.iter().map(|i| points[*i].x * points[*i].area);
    let centre = sums.sum::<Vector2<f64>>() / area;
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for i in component {
        let d = points[*i].x - centre;
        xx += d.x * d.x;
        yy += d.y * d.y;
        xy += d.x * d.y;
    }
    let (sine, cosine) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
    let axis = Vector2::new(cosine, sine) * (1e-3 * points[component[0]].area.sqrt());
    vec![centre - axis, centre + axis]
}

/// For each point those within reach.
struct Neighbours(Vec<Vec<(usize, f64)>>);

impl Neighbours {
    fn of(points: &[Point], reach: f64) -> Self {
        let cell = |x: &Vector2<f64>| {
            let index = x / reach;
            (index.x.floor() as i64, index.y.floor() as i64)
        };
        let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
        for (i, point) in points.iter().enumerate() {
            cells.entry(cell(&point.x)).or_default().push(i);
        }
        let near = |point: &Point| {
            let (cx, cy) = cell(&point.x);
            let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (cx + dx, cy + dy)));
            let found = around.filter_map(|cell| cells.get(&cell)).flatten();
            let pairs = found.map(|j| (*j, (points[*j].x - point.x).norm()));
            pairs.filter(|(_, d)| *d <= reach).collect()
        };
        Self(points.iter().map(near).collect())
    }

    /// Points that hang together, each in the order it was found, by their lowest member.
    fn components(&self) -> Vec<Vec<usize>> {
        let mut seen = vec![false; self.0.len()];
        let mut components = Vec::new();
        for i in 0..self.0.len() {
            if seen[i] {
                continue;
            }
            seen[i] = true;
            let mut component = vec![i];
            let mut next = 0;
            while let Some(point) = component.get(next).copied() {
                for (j, _) in &self.0[point] {
                    if !seen[*j] {
                        seen[*j] = true;
                        component.push(*j);
                    }
                }
                next += 1;
            }
            components.push(component);
        }
        components
    }

    /// The point farthest from one by ways through the component, and those ways, m.
    fn farthest(&self, from: usize, points: &[Point]) -> (usize, BTreeMap<usize, f64>) {
        let mut ways = BTreeMap::from([(from, 0.0)]);
        // Dijkstra's algorithm; the bits of positive numbers are in the order of the numbers.
        let mut open = BTreeSet::from([(0, from)]);
        while let Some((bits, point)) = open.pop_first() {
            for (j, step) in &self.0[point] {
                let way = f64::from_bits(bits) + step;
                let known = ways.get(j).copied();
                if known.is_none_or(|known| way < known) {
                    if let Some(known) = known {
                        open.remove(&(known.to_bits(), *j));
                    }
                    ways.insert(*j, way);
                    open.insert((way.to_bits(), *j));
                }
            }
        }
        let last = ways.iter().max_by(|a, b| {
            let ways = a.1.total_cmp(b.1);
            // Of equally far ones the leftmost, lowest.
            let [x, y] = [a, b].map(|p| points[*p.0].x);
            ways.then(y.x.total_cmp(&x.x)).then(y.y.total_cmp(&x.y))
        });
        (last.map_or(from, |(i, _)| *i), ways)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const SPACING: f64 = 0.5;

    fn extraction(least: usize) -> CrackExtraction<'static> {
        CrackExtraction {
            body: "",
            value: "",
            failed: 1.0,
            partial: 0.0,
            reach: 1.6 * SPACING,
            least,
        }
    }

    /// Points of a lattice at an angle where `inside` of its own axes holds.
    fn lattice(degrees: f64, inside: impl Fn(f64, f64) -> bool) -> Vec<Point> {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let rows = (-60..60).flat_map(|j| (-60..60).map(move |i| (i, j)));
        let places = rows.map(|(i, j)| (f64::from(i) + 0.5, f64::from(j) + 0.5));
        let places = places.map(|(x, y)| (x * SPACING, y * SPACING));
        places
            .filter(|(x, y)| inside(*x, *y))
            .map(|(x, y)| Point {
                x: Vector2::new(cosine * x - sine * y, sine * x + cosine * y),
                area: SPACING * SPACING,
            })
            .collect()
    }

    #[test]
    fn a_straight_crack_at_any_angle() {
        for degrees in [0.0f64, 30.0, 90.0, -50.0] {
            let failed = lattice(degrees, |x, y| x.abs() < 10.0 && y.abs() < 0.5);
            let wake = |x: f64, y: f64| x.abs() < 10.0 && y.abs() > 0.5 && y.abs() < 1.0;
            let found = extraction(2).cracks(&failed, &lattice(degrees, wake));
            assert_eq!(found.cracks.len(), 1);
            let crack = &found.cracks[0];
            assert_eq!(crack.particles, 80);
            assert!(
                (crack.line.length() - 20.0).abs() < 0.5,
                "{degrees}: {crack:?}"
            );
            assert!((crack.rows - 2.0).abs() < 0.06, "{degrees}: {}", crack.rows);
            assert!((crack.partial_rows - 2.0).abs() < 0.06);
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let along = crack.normal.dot(&Vector2::new(cosine, sine)).abs();
            assert!(along < 0.03, "{degrees}: {along}");
        }
    }

    /// Rows of a lattice that are cut along the diagonal are one crack, not many.
    #[test]
    fn a_crack_across_the_lattice() {
        let failed = lattice(0.0, |x, y| (y - 0.7 * x).abs() < 0.5 && x.abs() < 8.0);
        let found = extraction(2).cracks(&failed, &[]);
        assert_eq!(found.cracks.len(), 1);
        let exact = 16.0 * (1.0f64 + 0.49).sqrt();
        let length = found.cracks[0].line.length();
        assert!((length / exact - 1.0).abs() < 0.05, "{length} for {exact}");
    }

    #[test]
    fn a_bent_crack() {
        let radius = 9.0;
        let failed = lattice(0.0, |x, y| (x.hypot(y) - radius).abs() < 0.55 && y > -3.0);
        let found = extraction(2).cracks(&failed, &[]);
        assert_eq!(found.cracks.len(), 1);
        let line = &found.cracks[0].line;
        let exact = radius * (PI + 2.0 * (3.0 / radius).asin());
        assert!(
            (line.length() / exact - 1.0).abs() < 0.05,
            "{}",
            line.length()
        );
        let off = |p: &Vector2<f64>| (p.norm() - radius).abs();
        assert!(line.points().iter().map(off).fold(0.0, f64::max) < SPACING);
    }

    #[test]
    fn several_cracks_and_single_particles() {
        let failed = lattice(0.0, |x, y| {
            let rows = (y.abs() < 0.3 || (y - 5.0).abs() < 0.3) && x.abs() < 4.0;
            rows || (y > 20.0 && y < 20.5 && x > 0.0 && x < 0.5)
        });
        let found = extraction(2).cracks(&failed, &[]);
        assert_eq!(found.cracks.len(), 2);
        assert!((found.density(10.0).unwrap() - 0.2).abs() < 1e-15);
        assert!((found.length() - 16.0).abs() < 1.0, "{}", found.length());
        assert!(found.density(0.0).is_err());
        let all = extraction(1).cracks(&failed, &[]);
        assert_eq!(all.cracks.len(), 3);
        assert!((all.cracks[2].line.length() - SPACING).abs() < 0.01 * SPACING);
        assert_eq!(
            extraction(1).cracks(&[], &failed),
            ExtractedCracks::default()
        );
    }
}
