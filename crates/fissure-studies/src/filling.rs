//! Particles at the same places in every cell of a region of any outline.

use fissure::nalgebra::SMatrix;
use fissure::prelude::*;

/// Two particles per cell and axis in a region of `area` m², volumes clipped at its edge.
///
/// Slivers in sub-cells whose centre is outside belong to nobody: they are shared out, so that the
/// volumes sum to the area.
///
/// # Errors
/// A region that is refused.
pub fn clipped(grid: &Grid<2>, region: &dyn Region<2>, area: f64) -> Result<Seeds<2>, SeedError> {
    fill(grid, region, area, true)
}

/// The same with particles that all have one volume, so that none is much lighter than others.
///
/// # Errors
/// A region that is refused.
pub fn whole(grid: &Grid<2>, region: &dyn Region<2>, area: f64) -> Result<Seeds<2>, SeedError> {
    fill(grid, region, area, false)
}

fn fill(
    grid: &Grid<2>,
    region: &dyn Region<2>,
    area: f64,
    clip: bool,
) -> Result<Seeds<2>, SeedError> {
    let places = InCell {
        origin: grid.origin().into(),
        cell: grid.spacing(),
        per_axis: 2,
        clip,
    };
    let mut seeds = places.seed(region)?;
    let missing = area / seeds.total_volume();
    for volume in &mut seeds.volume {
        *volume *= missing;
    }
    Ok(seeds)
}

/// Parts of a quarter of a cell smaller than this share of it join the largest part in their cell.
const LEAST_PART: f64 = 0.1;

/// Two particles per cell and axis in a convex outline (corners counter-clockwise), each in the middle of the part of its quarter of a
/// cell that is inside, and with the area of this part.
///
/// Gradients of bilinear functions are linear in a cell, so that sums of `V ∇N` are the integrals over the
/// outline: a uniform stress that leaves the sides free is in equilibrium, wherever they cross the cells.
pub fn cut(grid: &Grid<2>, outline: &[Vector2<f64>]) -> Seeds<2> {
    let h = grid.spacing();
    let origin = grid.origin();
    let bounds = |pick: fn(f64, f64) -> f64, axis: usize| {
        let along = outline.iter().map(|corner| corner[axis]);
        along.reduce(pick).map_or(0.0, |x| (x - origin[axis]) / h)
    };
    let cells = |axis| bounds(f64::min, axis).floor() as i64..bounds(f64::max, axis).ceil() as i64;
    let mut seeds = Seeds {
        position: Vec::new(),
        volume: Vec::new(),
        half_edges: SMatrix::identity() * (0.25 * h),
    };
    for i in cells(0) {
        for j in cells(1) {
            let corner = origin + Vector2::new(i as f64, j as f64) * h;
            let quarters = [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)];
            let parts =
                quarters.map(|(x, y)| part(corner + Vector2::new(x, y) * h, 0.5 * h, outline));
            for (area, moment) in joined(parts, LEAST_PART * 0.25 * h * h) {
                // Less than this is round-off.
                if area > 1e-12 * h * h {
                    seeds.position.push(moment / area);
                    seeds.volume.push(area);
                }
            }
        }
    }
    seeds
}

/// Area of a part and its first moment.
type Part = (f64, Vector2<f64>);

/// The part of a square within a convex outline.
fn part(corner: Vector2<f64>, side: f64, outline: &[Vector2<f64>]) -> Part {
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let mut polygon: Vec<Vector2<f64>> = square
        .map(|(x, y)| corner + Vector2::new(x, y) * side)
        .to_vec();
    for (number, from) in outline.iter().enumerate() {
        let along = outline[(number + 1) % outline.len()] - from;
        polygon = left_of(&polygon, from, &along);
    }
    // From a point beside it, so that little cancels.
    let fan = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let parts = fan.map(|(a, b)| {
        let area = 0.5 * (a - corner).perp(&(b - corner));
        (area, (a + b + corner) * (area / 3.0))
    });
    parts.fold((0.0, Vector2::zeros()), add)
}

fn add(a: Part, b: Part) -> Part {
    (a.0 + b.0, a.1 + b.1)
}

/// What of a polygon lies left of a line [Sutherland and Hodgman 1974].
fn left_of(
    polygon: &[Vector2<f64>],
    from: &Vector2<f64>,
    along: &Vector2<f64>,
) -> Vec<Vector2<f64>> {
    let mut left = Vec::with_capacity(polygon.len() + 1);
    let height = |x: &Vector2<f64>| along.perp(&(x - from));
    for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (at_a, at_b) = (height(a), height(b));
        if at_a >= 0.0 {
            left.push(*a);
        }
        if (at_a >= 0.0) != (at_b >= 0.0) {
            left.push(a + (b - a) * (at_a / (at_a - at_b)));
        }
    }
    left
}

/// The parts of a cell, those smaller than `least` added to the largest.
fn joined(parts: [Part; 4], least: f64) -> Vec<Part> {
    let mut parts = parts.to_vec();
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let small = parts.split_off(parts.partition_point(|part| part.0 >= least).max(1));
    parts[0] = small.into_iter().fold(parts[0], add);
    parts
}

/// Seeds that are already there.
pub struct Seeded(pub Seeds<2>);

impl Seeding<2> for Seeded {
    fn seed(&self, _region: &dyn Region<2>) -> Result<Seeds<2>, SeedError> {
        let half_edges: SMatrix<f64, 2, 2> = self.0.half_edges;
        Ok(Seeds {
            position: self.0.position.clone(),
            volume: self.0.volume.clone(),
            half_edges,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_the_area_and_the_middle_of_the_outline() {
        let grid = Grid::over([-1.0, -1.0], [1.0, 1.0], 0.1).unwrap();
        let (sin, cos) = 0.4_f64.sin_cos();
        let corner = |x: f64, y: f64| Vector2::new(0.03 + cos * x - sin * y, sin * x + cos * y);
        let outline = [
            corner(-0.5, -0.2),
            corner(0.5, -0.2),
            corner(0.5, 0.2),
            corner(-0.5, 0.2),
        ];
        let seeds = cut(&grid, &outline);
        assert!((seeds.total_volume() - 0.4).abs() <= 1e-14);
        let moment = seeds.position.iter().zip(&seeds.volume);
        let moment: Vector2<f64> = moment.map(|(x, volume)| x * *volume).sum();
        assert!((moment / 0.4 - Vector2::new(0.03, 0.0)).norm() <= 1e-14);
        let least = seeds.volume.iter().copied().fold(1.0, f64::min);
        assert!(least > 1e-12 && seeds.volume.len() > 100);
    }
}
