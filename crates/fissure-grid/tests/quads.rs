//! Meshes of quadrilaterals: who owns a point, and the functions of the corners.

#![allow(
    missing_docs,
    clippy::neg_cmp_op_on_partial_ord,
    clippy::panic,
    clippy::unwrap_used
)]

use fissure_grid::{Grid, MeshError, QuadMesh, Shape, Stencil, Window, shape};
use fissure_tensor::{Band, Vector3};
use nalgebra::{Matrix2, Vector2};
use proptest::prelude::*;

/// `columns × rows` elements on the unit square, inner nodes moved by up to `amount` of a cell by some function without a
/// pattern, the whole turned by `angle`.
fn distorted(columns: usize, rows: usize, amount: f64, angle: f64, seed: u64) -> QuadMesh {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut nodes = Vec::new();
    for j in 0..=rows {
        for i in 0..=columns {
            let inner = i > 0 && i < columns && j > 0 && j < rows;
            let moved = if inner { 2.0 * amount } else { 0.0 };
            let x = (i as f64 + moved * random()) / columns as f64;
            let y = (j as f64 + moved * random()) / rows as f64;
            nodes.push(nalgebra::Rotation2::new(angle) * Vector2::new(x, y));
        }
    }
    QuadMesh::new(nodes, rectangles(columns, rows)).unwrap()
}

fn rectangles(columns: usize, rows: usize) -> Vec<[u32; 4]> {
    let node = |i: usize, j: usize| (j * (columns + 1) + i) as u32;
    (0..rows)
        .flat_map(|j| {
            (0..columns).map(move |i| {
                [
                    node(i, j),
                    node(i + 1, j),
                    node(i + 1, j + 1),
                    node(i, j + 1),
                ]
            })
        })
        .collect()
}

/// The element of the lowest number of which no face has the point beyond it, by exact arithmetic in `i128` on a lattice of
/// 2⁻⁴⁰; every coordinate used with it is on the lattice.
fn owner(mesh: &QuadMesh, x: &Vector2<f64>) -> Option<usize> {
    let whole = |v: &Vector2<f64>| v.map(|c| (c * 2_f64.powi(40)) as i128);
    let x = whole(x);
    mesh.elements().iter().position(|corners| {
        (0..4).all(|k| {
            let a = whole(&mesh.nodes()[corners[k] as usize]);
            let b = whole(&mesh.nodes()[corners[(k + 1) % 4] as usize]);
            (b.x - a.x) * (x.y - a.y) - (b.y - a.y) * (x.x - a.x) >= 0
        })
    })
}

/// The same mesh with all coordinates on the lattice of 2⁻²⁰, so that middles of faces are exact too.
fn on_lattice(mesh: &QuadMesh) -> QuadMesh {
    let round = |c: f64| (c * 2_f64.powi(20)).round() / 2_f64.powi(20);
    let nodes = mesh.nodes().iter().map(|x| x.map(round)).collect();
    QuadMesh::new(nodes, mesh.elements().to_vec()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn functions_are_complete(seed in 0_u64..1000, amount in 0.0..0.49, angle in -3.0..3.0, at in (0.0..1.0, 0.0..1.0)) {
        let mesh = distorted(5, 4, amount / 2.0, angle, seed);
        let x = nalgebra::Rotation2::new(angle) * Vector2::new(at.0, at.1);
        // A turned border point may fall outside by rounding.
        if let Some(element) = mesh.element(&x) {
            let corners = mesh.elements()[element].map(|node| mesh.nodes()[node as usize]);
            let functions = mesh.functions(element, &x);
            let sum: f64 = functions.iter().map(|f| f.0).sum();
            let place: Vector2<f64> = functions.iter().zip(&corners).map(|(f, c)| c * f.0).sum();
            let none: Vector2<f64> = functions.iter().map(|f| f.1).sum();
            let one: Matrix2<f64> = functions.iter().zip(&corners).map(|(f, c)| c * f.1.transpose()).sum();
            prop_assert!((sum - 1.0).abs() <= 4e-16);
            prop_assert!((place - x).norm() <= 1e-15);
            prop_assert!(none.norm() <= 1e-13);
            prop_assert!((one - Matrix2::identity()).norm() <= 1e-13);
            prop_assert!(functions.iter().all(|f| f.0 >= 0.0));
        }
    }

    /// On faces, at nodes, and one unit in the last place beside them.
    #[test]
    fn a_point_has_one_owner_from_wherever_it_is_sought(seed in 0_u64..1000, amount in 0.0..0.49, angle in -3.0..3.0) {
        let mesh = on_lattice(&distorted(4, 3, amount / 2.0, angle, seed));
        let mut points = mesh.nodes().to_vec();
        for corners in mesh.elements() {
            for k in 0..4 {
                let [a, b] = [k, (k + 1) % 4].map(|k| mesh.nodes()[corners[k] as usize]);
                points.extend([0.5, 0.25, 0.625].map(|t| a + (b - a) * t));
            }
        }
        for point in points.clone() {
            // One unit of the lattice.
            for way in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
                points.push(point + Vector2::from(way) * 2_f64.powi(-40));
            }
        }
        for x in &points {
            let expected = owner(&mesh, x);
            prop_assert_eq!(mesh.element(x), expected);
            for start in 0..mesh.elements().len() {
                prop_assert_eq!(mesh.element_from(start, x), expected);
            }
        }
    }

    /// Values at the nodes of a face do not depend on the side, those of other nodes vanish.
    #[test]
    fn functions_agree_across_a_face(seed in 0_u64..1000, amount in 0.0..0.49, angle in -3.0..3.0, t in 0.0..1.0) {
        let mesh = distorted(4, 4, amount / 2.0, angle, seed);
        for (element, corners) in mesh.elements().iter().enumerate() {
            for (face, other) in mesh.neighbours(element).into_iter().enumerate() {
                let Some(other) = other else { continue };
                let (from, to) = (corners[face], corners[(face + 1) % 4]);
                let [a, b] = [from, to].map(|node| mesh.nodes()[node as usize]);
                let x = a + (b - a) * t;
                let value = |element: usize, node: u32| {
                    let place = mesh.elements()[element].iter().position(|&n| n == node);
                    place.map_or(0.0, |place| mesh.functions(element, &x)[place].0)
                };
                for &node in corners.iter().chain(&mesh.elements()[other]) {
                    let expected = if node == from { 1.0 - t } else if node == to { t } else { 0.0 };
                    for side in [element, other] {
                        prop_assert!((value(side, node) - expected).abs() <= 1e-13);
                    }
                }
            }
        }
    }

    /// An element with angles near 0° and 180°, thin, and as far from zero as is allowed.
    #[test]
    fn the_map_is_inverted_in_ugly_elements(
        thin in -3.0..0.0, bend in 0.0..0.998, xi in -1.0..1.0, eta in -1.0..1.0, turn in -3.0..3.0, away in 0.0..1.0,
    ) {
        let thickness = 10_f64.powf(thin);
        let away = 1e6 * thickness * (1.0 - bend) * away;
        // The third corner goes towards the diagonal.
        let third = 1.0 - 0.5 * bend;
        let nodes = [[0.0, 0.0], [1.0, 0.0], [third, third * thickness], [0.0, thickness]]
            .map(|x| nalgebra::Rotation2::new(turn) * Vector2::from(x) + Vector2::repeat(away));
        let mesh = QuadMesh::new(nodes.to_vec(), vec![[0, 1, 2, 3]]).unwrap();
        let x = mesh.point(0, &Vector2::new(xi, eta));
        let found = mesh.natural(0, &x);
        let miss = (mesh.point(0, &found) - x).norm();
        prop_assert!(miss <= 2e-14 * (1.0 + 0.01 * away), "{}", miss);
        prop_assert!(found.amax() <= 1.0);
    }

    /// Of squares along the axes the functions are those of linear shape functions.
    #[test]
    fn squares_are_those_of_the_grid(x in 0.0..1.0, y in 0.0..1.0) {
        let mesh = distorted(4, 4, 0.0, 0.0, 1);
        let grid = Grid::over([0.0; 2], [1.0; 2], 0.25).unwrap();
        prop_assert_eq!(&mesh.grid(), &grid);
        let at = Vector2::new(x, y);
        let mut linear = Vec::new();
        let window = Window::of_tile([0, 0], 4);
        let stencil = shape::Linear.stencil(&grid, &window, &at, &Matrix2::zeros()).unwrap();
        stencil.visit(|entry, n, g| {
            linear.push((grid.node(window.node(entry)), n, g));
        });
        let element = mesh.element(&at).unwrap();
        for ((n, g), &node) in mesh.functions(element, &at).iter().zip(&mesh.elements()[element]) {
            let place = mesh.nodes()[node as usize];
            let same = linear.iter().find(|l| l.0 == place).unwrap();
            prop_assert!((same.1 - n).abs() <= 4e-16 && (same.2 - g).norm() <= 8e-15);
        }
    }
}

/// Every element's nodes are in its patch's window, patches of one colour have none in common, and a stencil gives the nodes
/// whichever patch near by it is made for.
#[test]
fn patches_hold_what_they_should() {
    let mesh = distorted(30, 17, 0.2, 0.3, 7);
    let patches = mesh.patches();
    for a in 0..patches.len() {
        assert!(patches.window(a).len() <= 64);
        for b in 0..a {
            let common = patches
                .window(a)
                .iter()
                .any(|n| patches.window(b).contains(n));
            assert!(!common || patches.colour_of(a) != patches.colour_of(b));
        }
    }
    let shape = shape::Isoparametric(mesh.clone());
    let grid = mesh.grid();
    let mut served = 0;
    for (element, corners) in mesh.elements().iter().enumerate() {
        let x = mesh.point(element, &Vector2::new(0.3, -0.4));
        let home = shape.home(&grid, &x, 4).unwrap();
        let own = Window::of_patch(home[0] as u32);
        assert!(shape.stencil(&grid, &own, &x, &Matrix2::zeros()).is_some());
        for patch in 0..patches.len() {
            let window = Window::of_patch(patch as u32);
            let Some(stencil) = shape.stencil(&grid, &window, &x, &Matrix2::zeros()) else {
                continue;
            };
            served += 1;
            let mut nodes = Vec::new();
            stencil.visit_values(|entry, _| nodes.push(patches.window(patch)[entry]));
            assert_eq!(nodes, corners);
            stencil.visit(|entry, _, _| {
                let node = mesh.nodes()[patches.window(patch)[entry] as usize];
                assert!((stencil.arm(entry) - (node - x)).norm() <= 0.0);
            });
        }
    }
    // Patches overlap: particles may leave them a little.
    assert!(served > mesh.elements().len() * 5 / 4);
}

#[test]
fn a_node_of_many_elements_has_an_owner() {
    // A star of 40 quadrilaterals round one node: more nodes than a window holds.
    let count = 40_u32;
    let mut nodes = vec![Vector2::zeros()];
    for k in 0..2 * count {
        let angle = std::f64::consts::PI * f64::from(k) / f64::from(count);
        let radius = if k % 2 == 0 { 1.0 } else { 1.2 };
        nodes.push(Vector2::new(radius * angle.cos(), radius * angle.sin()));
    }
    let elements: Vec<[u32; 4]> = (0..count)
        .map(|k| [0, 2 * k + 1, 2 * k + 2, (2 * k + 2) % (2 * count) + 1])
        .collect();
    let mesh = QuadMesh::new(nodes, elements).unwrap();
    assert_eq!(mesh.element(&Vector2::zeros()), Some(0));
    for start in 0..40 {
        assert_eq!(mesh.element_from(start, &Vector2::zeros()), Some(0));
        let x = mesh.point(start, &Vector2::zeros());
        assert_eq!(mesh.element_from(39 - start, &x), Some(start));
    }
}

#[test]
fn points_outside_belong_to_nobody() {
    // An L: the way from one arm to the other leads out.
    let all = distorted(4, 4, 0.0, 0.0, 1);
    let keep: Vec<[u32; 4]> = (0..16)
        .filter(|k| k % 4 < 2 || k / 4 < 2)
        .map(|k| all.elements()[k])
        .collect();
    let mesh = QuadMesh::new(all.nodes().to_vec(), keep).unwrap();
    for outside in [
        [0.75, 0.75],
        [1.1, 0.1],
        [-0.1, 0.5],
        [f64::NAN, 0.5],
        [0.5, f64::INFINITY],
    ] {
        let x = Vector2::from(outside);
        assert_eq!(mesh.element(&x), None);
        assert_eq!(mesh.element_from(3, &x), None);
    }
    let (x, y) = (Vector2::new(0.1, 0.9), Vector2::new(0.9, 0.1));
    let (start, end) = (mesh.element(&x).unwrap(), mesh.element(&y).unwrap());
    assert_eq!(mesh.element_from(start, &y), Some(end));
    assert_eq!(mesh.element_from(end, &x), Some(start));
}

#[test]
fn parts_fill_their_elements() {
    let mesh = distorted(6, 5, 0.2, 0.5, 3);
    let all: Vec<usize> = (0..30).collect();
    let parts = mesh.parts(&all, 3);
    let total: f64 = parts.iter().map(|part| part.1).sum();
    assert!((total - 1.0).abs() <= 1e-14);
    for (k, (x, area)) in parts.iter().enumerate() {
        assert_eq!(mesh.element(x), Some(k / 9));
        assert!(*area > 0.0);
    }
    let of_elements: f64 = (0..30).map(|k| mesh.area(k)).sum();
    assert!((of_elements - 1.0).abs() <= 1e-14);
}

#[test]
fn bands_are_those_of_the_elements() {
    let angle = 0.4_f64;
    let alike = distorted(4, 4, 0.0, angle, 1);
    let along = Vector3::new(angle.cos(), angle.sin(), 0.0);
    for band in [alike.widest_band(), alike.band(5)] {
        assert!(matches!(band, Band::Skewed(_)));
        assert!((band.width(&along) - 0.25).abs() <= 1e-15);
    }
    let other = distorted(4, 4, 0.2, angle, 1);
    let widest = other.widest_band();
    for element in 0..16 {
        assert!(other.band(element).max_width() <= widest.width(&along));
    }
}

#[test]
fn what_is_no_mesh_is_refused() {
    let square = || {
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
            .map(Vector2::from)
            .to_vec()
    };
    let new = QuadMesh::new;
    assert_eq!(new(square(), vec![]).unwrap_err(), MeshError::Empty);
    assert_eq!(
        new(square(), vec![[0, 1, 2, 7]]).unwrap_err(),
        MeshError::UnknownNode {
            element: 0,
            node: 7,
            nodes: 4
        }
    );
    // Clockwise, bow tie, a corner on a line, dented, two corners in one.
    assert!(matches!(
        new(square(), vec![[0, 3, 2, 1]]).unwrap_err(),
        MeshError::Jacobian { .. }
    ));
    assert!(matches!(
        new(square(), vec![[0, 1, 3, 2]]).unwrap_err(),
        MeshError::Jacobian { .. }
    ));
    assert!(matches!(
        new(square(), vec![[0, 1, 2, 2]]).unwrap_err(),
        MeshError::Jacobian { .. }
    ));
    for third in [0.5, 0.4] {
        let mut nodes = square();
        nodes[2] = Vector2::repeat(third);
        let error = new(nodes, vec![[0, 1, 2, 3]]).unwrap_err();
        assert!(
            matches!(error, MeshError::Jacobian { corner: 2, jacobian, .. } if jacobian <= 0.0),
            "{error}"
        );
    }
    let mut nodes = square();
    nodes[1].y = f64::NAN;
    assert!(matches!(
        new(nodes, vec![[0, 1, 2, 3]]).unwrap_err(),
        MeshError::NotFinite { node: 1, .. }
    ));
    assert!(matches!(
        new(square(), vec![[0, 1, 2, 3], [0, 1, 2, 3]]).unwrap_err(),
        MeshError::SharedSide {
            first: 0,
            second: 1,
            ..
        }
    ));
    // Two halves on the right of one element: node 4 hangs.
    let mut nodes = square();
    nodes.extend([[1.0, 0.5], [2.0, 0.0], [2.0, 0.5], [2.0, 1.0]].map(Vector2::from));
    let hanging = new(
        nodes.clone(),
        vec![[0, 1, 2, 3], [1, 5, 6, 4], [4, 6, 7, 2]],
    );
    assert_eq!(
        hanging.unwrap_err(),
        MeshError::NotConforming {
            node: 4,
            element: 0
        }
    );
    // Unused nodes hang nowhere.
    assert!(new(nodes, vec![[0, 1, 2, 3]]).is_ok());
    // Two nodes at one place: a slit.
    let mut nodes = square();
    nodes.extend([[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]].map(Vector2::from));
    let slit = new(nodes, vec![[0, 1, 2, 3], [4, 5, 6, 2]]);
    assert!(matches!(slit.unwrap_err(), MeshError::NotConforming { .. }));
}
