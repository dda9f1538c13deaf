//! Shapes against formulas written down independently.

mod support;

use fissure_grid::{Grid, Shape, Window, shape};
use fissure_tensor::Band;
use nalgebra::{Matrix1, Matrix2, Matrix3, Rotation2, Rotation3, Vector1, Vector2, Vector3};
use support::{deformation, nodes, spread};

const H: f64 = 0.5;

fn line() -> Grid<1> {
    Grid::over([0.0], [8.0], H).expect("grid")
}

/// Weights of all nodes in order at a point of the line.
fn along(shape: &impl Shape<1>, x: f64, half: f64) -> Vec<f64> {
    nodes(shape, &line(), &Vector1::new(x), &Matrix1::new(half))
        .expect("inside")
        .values()
        .map(|n| n.0)
        .collect()
}

fn close(a: &[f64], b: &[f64]) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() <= 1e-15, "{a} {b}");
    }
}

#[test]
fn known_values() {
    close(&along(&shape::Linear, 2.125, 0.0), &[0.75, 0.25]);
    close(&along(&shape::Bspline2, 2.0, 0.0), &[0.125, 0.75, 0.125]);
    close(&along(&shape::Bspline2, 2.25, 0.0), &[0.5, 0.5, 0.0]);
    close(
        &along(&shape::Bspline3, 2.0, 0.0),
        &[1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0],
    );
    close(
        &along(&shape::Bspline3, 2.25, 0.0),
        &[1.0 / 48.0, 23.0 / 48.0, 23.0 / 48.0, 1.0 / 48.0],
    );
    // Bardenhagen & Kober: at a node, 1 − l/(2h) in the middle.
    close(&along(&shape::Gimp, 2.0, 0.125), &[0.0625, 0.875, 0.0625]);
}

/// The closed forms of uGIMP are the linear functions averaged over the box.
#[test]
fn gimp_is_the_average() {
    let samples = 20_000;
    for half in [0.5, 0.37, 0.25, 0.1] {
        for k in 0..=16 {
            let x = 2.0 + H * f64::from(k) / 16.0;
            for (index, (value, _)) in nodes(
                &shape::Gimp,
                &line(),
                &Vector1::new(x),
                &Matrix1::new(half * H),
            )
            .expect("inside")
            {
                let average = (0..samples)
                    .map(|s| x / H + half * ((2.0 * f64::from(s) + 1.0) / f64::from(samples) - 1.0))
                    .map(|y| (1.0 - (y - f64::from(index[0])).abs()).max(0.0))
                    .sum::<f64>()
                    / f64::from(samples);
                assert!(
                    (value - average).abs() <= 1e-8,
                    "{half} {x} {value} {average}"
                );
            }
        }
    }
}

/// No jump of the gradient anywhere: it changes no faster than 1/(l h), however small the box.
#[test]
fn gimp_gradient_is_continuous() {
    for half in [0.5, 0.25, 0.01] {
        let steps = 20_000;
        let gradient = |k: i32| {
            let x = Vector1::new(2.0 + 2.0 * H * f64::from(k) / f64::from(steps));
            let nodes = nodes(&shape::Gimp, &line(), &x, &Matrix1::new(half * H)).expect("inside");
            (2..9)
                .map(|node| nodes.get(&[node]).map_or(0.0, |n| n.1[0]))
                .collect::<Vec<_>>()
        };
        let allowed = 1.01 / (half * H) * (2.0 / f64::from(steps)) + 1e-12;
        for k in 0..steps {
            for (a, b) in gradient(k).iter().zip(gradient(k + 1)) {
                assert!((a - b).abs() <= allowed, "{half} {k}");
            }
        }
    }
}

#[test]
fn gimp_takes_boxes_up_to_a_cell() {
    let stencil = |half: f64| {
        shape::Gimp.stencil(
            &line(),
            &Window::of_tile([1], 4),
            &Vector1::new(2.6),
            &Matrix1::new(half),
        )
    };
    for half in [0.0, 1e-300, 1e-12, 0.25, 0.25 * (1.0 + 1e-12)] {
        let nodes = nodes(
            &shape::Gimp,
            &line(),
            &Vector1::new(2.0),
            &Matrix1::new(half),
        )
        .expect("inside");
        assert!((nodes.values().map(|n| n.0).sum::<f64>() - 1.0).abs() <= 1e-15);
        assert!(nodes.values().map(|n| n.1[0]).sum::<f64>().abs() <= 1e-13);
    }
    for half in [0.26, 1e300, f64::INFINITY, f64::NAN] {
        assert!(stencil(half).is_none(), "{half}");
    }
}

/// A turned lattice is replaced by the aligned cube of equal volume.
#[test]
fn gimp_ignores_the_turn_of_a_lattice() {
    let grid = Grid::over([0.0; 2], [8.0; 2], H).expect("grid");
    let turn = Rotation2::new(0.6).into_inner();
    for x in spread::<2>(20).map(|x| x * 8.0) {
        let aligned = nodes(
            &shape::Gimp,
            &grid,
            &x,
            &Matrix2::from_diagonal_element(0.1),
        )
        .expect("inside");
        let turned = nodes(&shape::Gimp, &grid, &x, &(turn * 0.1)).expect("inside");
        for (a, b) in aligned.values().zip(turned.values()) {
            assert!((a.0 - b.0).abs() <= 1e-14 && (a.1 - b.1).amax() <= 1e-13);
        }
    }
    let grid = Grid::over([0.0; 3], [8.0; 3], H).expect("grid");
    let turn = Rotation3::from_euler_angles(0.3, -0.4, 0.9).into_inner();
    for x in spread::<3>(20).map(|x| x * 8.0) {
        let aligned = nodes(
            &shape::Gimp,
            &grid,
            &x,
            &Matrix3::from_diagonal_element(0.1),
        )
        .expect("inside");
        let turned = nodes(&shape::Gimp, &grid, &x, &(turn * 0.1)).expect("inside");
        for (a, b) in aligned.values().zip(turned.values()) {
            assert!((a.0 - b.0).abs() <= 1e-14 && (a.1 - b.1).amax() <= 1e-13);
        }
    }
}

/// The formula as Sadeghirad, Brannon & Burghardt print it for a parallelogram with full edges r1, r2.
#[test]
fn cpdi_is_the_published_formula() {
    let grid = Grid::over([0.0; 2], [8.0; 2], H).expect("grid");
    let hat = |y: f64| (1.0 - y.abs()).max(0.0);
    for (k, x) in spread::<2>(200)
        .map(|x| x.map(|c| 1.0 + 6.0 * c))
        .enumerate()
    {
        let domain = deformation::<2>(k, 0.4) * (0.25 * H);
        let (r1, r2): (Vector2<f64>, Vector2<f64>) =
            (2.0 * domain.column(0), 2.0 * domain.column(1));
        let volume = r1.perp(&r2);
        let corners = [
            x - 0.5 * (r1 + r2),
            x + 0.5 * (r1 - r2),
            x + 0.5 * (r1 + r2),
            x - 0.5 * (r1 - r2),
        ];
        let stencil = nodes(&shape::Cpdi, &grid, &x, &domain).expect("inside");
        for (index, (value, gradient)) in stencil {
            let s = corners.map(|c| {
                let y = (c - grid.node(index)) / H;
                hat(y.x) * hat(y.y)
            });
            let expected = Vector2::new(r1.y - r2.y, r2.x - r1.x) * (s[0] - s[2])
                + Vector2::new(r1.y + r2.y, -r1.x - r2.x) * (s[1] - s[3]);
            assert!((value - 0.25 * s.iter().sum::<f64>()).abs() <= 1e-14);
            assert!((gradient - expected / (2.0 * volume)).amax() <= 1e-12 / H);
        }
    }
}

#[test]
fn cpdi_domain_follows_the_deformation() {
    let (seeded, f) = (deformation::<3>(1, 0.2) * 0.1, deformation::<3>(2, 0.3));
    assert_eq!(shape::Cpdi.domain(&seeded, &f), f * seeded);
    assert_eq!(shape::Gimp.domain(&seeded, &f), seeded);
    assert_eq!(shape::Linear.domain(&seeded, &f), seeded);
}

/// A long domain ends one cell from its centre, wherever the particle is; others are not touched.
#[test]
fn cpdi_shortens_long_domains() {
    let grid = Grid::over([0.0; 3], [8.0; 3], H).expect("grid");
    for x in spread::<3>(200).map(|x| x * 8.0) {
        let stencil = |length: f64| {
            let domain = Matrix3::from_diagonal(&Vector3::new(length, 0.1, 0.2));
            nodes(&shape::Cpdi, &grid, &x, &domain).expect("inside")
        };
        assert_eq!(stencil(H), stencil(2.0 * H));
        assert_ne!(stencil(H), stencil(0.9 * H));
    }
}

#[test]
fn cpdi_needs_a_volume() {
    let grid = Grid::over([0.0; 2], [8.0; 2], H).expect("grid");
    let x = Vector2::new(3.2, 3.3);
    for domain in [
        Matrix2::zeros(),
        Matrix2::new(0.1, 0.1, 0.1, 0.1),
        Matrix2::from_element(f64::NAN),
        Matrix2::from_diagonal(&Vector2::new(f64::INFINITY, 0.1)),
    ] {
        assert!(
            shape::Cpdi
                .stencil(&grid, &Window::of_tile([1, 1], 4), &x, &domain)
                .is_none(),
            "{domain}"
        );
    }
}

/// The names are what files and command lines hold.
#[test]
fn names_are_fixed() {
    fn name(shape: impl Shape<2>) -> &'static str {
        shape.name()
    }
    let names = [
        name(shape::Linear),
        name(shape::Gimp),
        name(shape::Cpdi),
        name(shape::Bspline2),
        name(shape::Bspline3),
    ];
    assert_eq!(names, ["linear", "gimp", "cpdi", "bspline2", "bspline3"]);
}

#[test]
fn bands_follow_the_spacing() {
    fn band(shape: impl Shape<2>) -> Band {
        shape.band(0.5)
    }
    assert_eq!(band(shape::Linear), Band::Projected([0.5; 3]));
    assert_eq!(band(shape::Gimp), Band::Uniform(0.5));
    assert_eq!(band(shape::Cpdi), Band::Uniform(0.5));
    assert_eq!(band(shape::Bspline2), Band::Uniform(1.0));
    assert_eq!(band(shape::Bspline3), Band::Uniform(1.5));
}
