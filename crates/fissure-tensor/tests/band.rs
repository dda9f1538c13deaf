//! Band widths against sections of a box measured numerically.

#[path = "support/random.rs"]
mod random;

use fissure_tensor::{Band, Vector3};
use proptest::prelude::*;
use random::{cases, direction};

/// Area of the central section of a box across `n`, by clipping a large square in that plane with
/// the six faces and the shoelace formula.
fn section_area(edges: &[f64; 3], n: &Vector3<f64>) -> f64 {
    let other = if n.x.abs() < 0.6 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let u = n.cross(&other).normalize();
    let w = n.cross(&u);
    let far = 4.0 * (edges[0] + edges[1] + edges[2]);
    let mut polygon = vec![
        u * far + w * far,
        w * far - u * far,
        -u * far - w * far,
        u * far - w * far,
    ];
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let inside = |p: &Vector3<f64>| 0.5 * edges[axis] - sign * p[axis];
            let mut clipped = Vec::new();
            for (i, p) in polygon.iter().enumerate() {
                let q = &polygon[(i + 1) % polygon.len()];
                let (a, b) = (inside(p), inside(q));
                if a >= 0.0 {
                    clipped.push(*p);
                }
                if (a >= 0.0) != (b >= 0.0) {
                    clipped.push(p + (q - p) * (a / (a - b)));
                }
            }
            polygon = clipped;
        }
    }
    let mut area = 0.0;
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        area += 0.5 * n.dot(&p.cross(q));
    }
    area.abs()
}

fn edges() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![
        prop::array::uniform3(0.05..2.0),
        (0.05..2.0).prop_map(|e| [e; 3]),
    ]
}

/// Directions, some of them along axes, diagonals or nearly so.
fn normals() -> impl Strategy<Value = Vector3<f64>> {
    let special = prop::array::uniform3(prop::sample::select(vec![0.0, 1.0, -1.0, 1e-9]))
        .prop_filter("a direction", |n| Vector3::from(*n).norm() > 0.5)
        .prop_map(|n| Vector3::from(n).normalize());
    prop_oneof![3 => direction(), 1 => special]
}

proptest! {
    #![proptest_config(cases(20_000))]

    #[test]
    fn section_of_a_box(e in edges(), n in normals()) {
        let width = Band::Section(e).width(&n);
        let measured = e[0] * e[1] * e[2] / section_area(&e, &n);
        prop_assert!((width - measured).abs() <= 1e-12 * measured, "{width} {measured}");
    }

    #[test]
    fn section_of_a_rectangle(a in 0.05..2.0, b in 0.05..2.0, angle in -3.2..3.2) {
        let n = Vector3::new(f64::cos(angle), f64::sin(angle), 0.0);
        let width = Band::Section([a, b, 0.0]).width(&n);
        // The chord through the centre ends at whichever pair of sides it meets first.
        let chord = f64::min(a / n.y.abs(), b / n.x.abs());
        prop_assert!((width - a * b / chord).abs() <= 1e-14);
        // The same for a box of any depth, which the crack runs through.
        prop_assert!((Band::Section([a, b, 0.7]).width(&n) - width).abs() <= 1e-14);
    }

    /// The sections of a box that measure least are those across its longest edge (Vaaler 1979).
    #[test]
    fn no_width_exceeds_the_largest(e in edges(), n in normals(), plane in prop::bool::ANY) {
        let e = if plane { [e[0], e[1], 0.0] } else { e };
        let n = if plane { Vector3::new(n.x, n.y, 0.0).try_normalize(1e-3) } else { Some(n) };
        prop_assume!(n.is_some());
        let n = n.unwrap();
        let skewed = Band::Skewed([[e[0], 0.3 * e[1]], [-0.8 * e[2], e[1]]]);
        for band in [Band::Section(e), Band::Projected(e), Band::Uniform(e[0]), skewed] {
            prop_assert!(band.width(&n) <= band.max_width() * (1.0 + 1e-15));
            prop_assert!(band.width(&n) > 0.0);
            prop_assert!((band.width(&-n) - band.width(&n)).abs() <= 0.0);
        }
        // The section width is the largest of the three projections or less than their sum.
        prop_assert!(Band::Section(e).width(&n) <= Band::Projected(e).width(&n) * (1.0 + 1e-15));
    }

    #[test]
    fn largest_widths_are_attained(e in edges()) {
        let along = Vector3::from(e).normalize();
        let projected = Band::Projected(e);
        prop_assert!((projected.width(&along) - projected.max_width()).abs() <= 1e-15 * 4.0);
        let section = Band::Section(e);
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let best = axes.iter().map(|n| section.width(n)).fold(0.0, f64::max);
        prop_assert!(best == section.max_width());
    }

    /// The band of squares, turned, is that of squares along the axes for the normal turned back.
    #[test]
    fn skewed_bands_turn_with_their_cells(h in 0.1..2.0_f64, angle in -3.2..3.2_f64, n in direction()) {
        let (sin, cos) = angle.sin_cos();
        let turned = Band::Skewed([[h * cos, h * sin], [-h * sin, h * cos]]);
        let back = Vector3::new(cos * n.x + sin * n.y, cos * n.y - sin * n.x, n.z);
        let straight = Band::Projected([h; 3]);
        prop_assert!((turned.width(&n) - straight.width(&back)).abs() <= 4e-15);
        prop_assert!((turned.max_width() - straight.max_width()).abs() <= 4e-15);
        prop_assert!((turned.scaled(3.0).width(&n) - 3.0 * turned.width(&n)).abs() <= 4e-15);
    }

    #[test]
    fn projected_width_is_additive_over_axes(e in edges(), n in direction()) {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let band = Band::Projected(e);
        let sum: f64 = (0..3).map(|i| n[i].abs() * band.width(&axes[i])).sum();
        prop_assert!((band.width(&n) - sum).abs() <= 1e-15 * 4.0);
    }
}

/// On a grid of cubes the volume of the cells that a plane cuts, per area of the plane, is on
/// average over its offsets `h (|n_x| + |n_y| + |n_z|)`.
#[test]
fn projected_width_counts_the_cells_that_a_plane_cuts() {
    for n in [
        [1.0_f64, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, 2.0, -3.0],
        [0.3, -0.4, 0.5],
    ] {
        let n: Vector3<f64> = Vector3::from(n).normalize();
        let reach = 0.5 * (n.x.abs() + n.y.abs() + n.z.abs());
        // Cell centres at integers; a cell is cut if its centre is within `reach` of the plane.
        let mut next = random::sequence(3);
        let (mut cut, mut area) = (0_u32, 0.0);
        for _ in 0..40 {
            let offset = next();
            // Columns along the axis that the plane crosses most steeply.
            let axis = n.iamax();
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            for a in -12..12 {
                for b in -12..12 {
                    area += 1.0 / n[axis].abs();
                    for c in -60..60 {
                        let distance =
                            n[axis] * f64::from(c) + n[j] * f64::from(a) + n[k] * f64::from(b)
                                - offset;
                        cut += u32::from(distance.abs() < reach);
                    }
                }
            }
        }
        let width = Band::Projected([1.0; 3]).width(&n);
        let counted = f64::from(cut) / area;
        assert!((counted - width).abs() <= 0.02 * width, "{counted} {width}");
    }
}
