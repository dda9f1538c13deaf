//! Meshes of gmsh: what is read of them, what is refused, and a bar on one.

#![allow(missing_docs, clippy::panic, clippy::unwrap_used)]

use std::path::PathBuf;

use fissure_grid::{MeshError, shape};
use fissure_io::gmsh::{GmshError, GmshMesh};
use fissure_materials::{Decohesive, Isotropic, Normal, Scale, softening};
use fissure_scene::{Constant, Hold, Plane, Scene, Solver};
use fissure_solvers::{QuasiStatic, QuasiStaticSettings};
use fissure_tensor::Vector3;
use nalgebra::{Rotation2, Vector2};

fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name)
}

fn area(mesh: &GmshMesh, elements: &[usize]) -> f64 {
    elements
        .iter()
        .map(|&element| mesh.mesh.area(element))
        .sum()
}

#[test]
fn a_square_of_version_4_1() {
    let square = GmshMesh::read(data("square.msh")).unwrap();
    let mesh = &square.mesh;
    let names: Vec<&str> = square
        .groups()
        .iter()
        .map(|group| group.name.as_str())
        .collect();
    assert_eq!(names, ["corner", "bottom", "right", "top", "left", "body"]);
    let body = square.group("body").unwrap();
    assert_eq!((body.dimension, body.nodes.len()), (2, mesh.nodes().len()));
    assert_eq!(body.elements.len(), mesh.elements().len());
    assert!((area(&square, &body.elements) - 1.0).abs() <= 1e-14);
    for (name, axis, at) in [
        ("bottom", 1, 0.0),
        ("right", 0, 1.0),
        ("top", 1, 1.0),
        ("left", 0, 0.0),
    ] {
        let side = square.group(name).unwrap();
        assert_eq!((side.dimension, side.nodes.len()), (1, 9));
        assert!(side.elements.is_empty());
        assert!(square.places(name).unwrap().iter().all(|x| x[axis] == at));
        // All nodes of the side.
        let there = mesh.nodes().iter().filter(|x| x[axis] == at).count();
        assert_eq!(there, 9);
    }
    assert_eq!(square.places("corner").unwrap(), [Vector2::zeros()]);
    let seeds = square.seeds("body", 3).unwrap();
    assert_eq!(seeds.len(), 9 * mesh.elements().len());
    assert!((seeds.total_volume() - 1.0).abs() <= 1e-13);
    let present = match square.group("lid").unwrap_err() {
        GmshError::UnknownGroup { present, .. } => present,
        error => panic!("{error}"),
    };
    assert_eq!(present, names);
    assert!(matches!(
        square.seeds("left", 2).unwrap_err(),
        GmshError::NoElements { .. }
    ));
}

#[test]
fn a_bar_of_version_2_2() {
    let bar = GmshMesh::read(data("bar_15.msh")).unwrap();
    let body = bar.group("bar").unwrap();
    assert_eq!(
        (bar.mesh.elements().len(), body.elements.len()),
        (28 * 8, 20 * 6)
    );
    assert!((area(&bar, &body.elements) - 0.012).abs() <= 1e-16);
    let back = Rotation2::new(-15_f64.to_radians());
    for (name, at) in [("left end", 0.0), ("right end", 0.2)] {
        let places = bar.places(name).unwrap();
        assert_eq!(places.len(), 7);
        assert!(places.iter().all(|x| ((back * x).x - at).abs() <= 1e-15));
    }
    assert!((bar.mesh.grid().spacing() / 0.01 - 1.0).abs() <= 1e-9);
}

/// The bar of Sanchez 2010, ch. 5, on the mesh along it: strength and fracture energy whatever the angle.
#[test]
fn a_bar_breaks_on_its_mesh() {
    let file = GmshMesh::read(data("bar_15.msh")).unwrap();
    let turn = Rotation2::new(15_f64.to_radians());
    let axis = turn * Vector2::x();
    let (strength, toughness) = (2.7e6, 61.35);
    let law = Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength,
        toughness,
        softening: softening::Linear,
        normal: Normal::Prescribed(Vector3::new(axis.x, axis.y, 0.0)),
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 0.06 });
    let weaker = Scale {
        strength: 0.9,
        ..Scale::default()
    };
    let weak = |x: &Vector2<f64>| (0.1..0.11).contains(&x.dot(&axis));
    let hold = Hold::Component(axis);
    scene
        .add_body("bar", law, file.seeds("bar", 2).unwrap())
        .unwrap()
        .set_scale("bar", weak, weaker)
        .unwrap()
        .hold_places(
            "left",
            &file.places("left end").unwrap(),
            hold,
            Constant(0.0),
        )
        .unwrap()
        .hold_places(
            "right",
            &file.places("right end").unwrap(),
            hold,
            Constant(1.0),
        )
        .unwrap();
    let end = 1.1 * 2.0 * toughness / (0.9 * strength);
    let settings = QuasiStaticSettings {
        step: end / 60.0,
        ..QuasiStaticSettings::default()
    };
    let shape = shape::Isoparametric(file.mesh.clone());
    let mut solver = QuasiStatic::new(file.mesh.grid(), shape, settings).unwrap();
    let mut peak = 0.0_f64;
    while scene.time() < end {
        let report = solver.step(&mut scene, end).unwrap();
        peak = peak.max(report.reactions[1].dot(&axis));
    }
    let section = 0.06 * 0.06;
    let (load, energy) = (0.9 * strength * section, toughness * section);
    assert!((peak / load - 1.0).abs() <= 0.03, "{}", peak / load);
    let dissipated = scene.energy().dissipated;
    assert!(
        (dissipated / energy - 1.0).abs() <= 2e-3,
        "{}",
        dissipated / energy
    );
}

/// Two squares side by side in version 2.2: the first clockwise and against its group, the second in two, and a centre of an arc.
const TWO: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\
$PhysicalNames\n3\n1 1 \"the left side\"\n2 2 \"all\"\n2 3 \"right half\"\n$EndPhysicalNames\n\
$Nodes\n7\n10 0 0 1\n20 1 0 1\n30 1 1 1\n40 0 1 1\n50 2 0 1\n60 2 1 1\n70 9 9 9\n$EndNodes\n\
$Elements\n5\n1 15 2 0 7 70\n2 1 2 1 1 10 40\n3 3 2 -2 1 10 40 30 20\n4 3 2 2 2 20 50 60 30\n5 3 2 3 2 20 50 60 30\n$EndElements\n";

#[test]
fn what_is_no_order_and_what_is_double() {
    let two = GmshMesh::parse("two.msh", TWO).unwrap();
    assert_eq!(two.mesh.elements(), [[0, 1, 2, 3], [1, 4, 5, 2]]);
    assert_eq!(two.group("all").unwrap().elements, [0, 1]);
    assert_eq!(two.group("right half").unwrap().elements, [1]);
    assert_eq!(two.group("the left side").unwrap().nodes, [0, 3]);
    // Also with the ends of lines of another system.
    let other = GmshMesh::parse("two.msh", &TWO.replace('\n', "\r\n")).unwrap();
    assert_eq!(other, two);
}

#[test]
fn what_is_no_mesh_is_refused() {
    let refused = |text: &str| GmshMesh::parse("two.msh", text).unwrap_err();
    let with = |from: &str, to: &str| {
        assert!(TWO.contains(from), "{from}");
        refused(&TWO.replacen(from, to, 1))
    };
    assert!(matches!(
        GmshMesh::read(data("none.msh")).unwrap_err(),
        GmshError::File(_)
    ));
    assert!(matches!(refused(""), GmshError::NotGmsh { .. }));
    assert!(matches!(
        refused("solid ascii\n"),
        GmshError::NotGmsh { .. }
    ));
    assert!(
        matches!(with("2.2 0 8", "4 0 8"), GmshError::Version { version, .. } if version == "4")
    );
    assert!(matches!(
        with("2.2 0 8", "2.2 1 8"),
        GmshError::Binary { .. }
    ));
    assert!(matches!(
        with("$EndNodes", ""),
        GmshError::Section {
            section: "Nodes",
            ..
        }
    ));
    assert!(matches!(
        with("$Elements", "$Elephants"),
        GmshError::Section {
            section: "Elements",
            ..
        }
    ));
    assert!(matches!(
        with("20 1 0 1", "20 1 x 1"),
        GmshError::Line { line: 13, .. }
    ));
    assert!(matches!(
        with("20 1 0 1", "20 1 nan 1"),
        GmshError::Line { line: 13, .. }
    ));
    assert!(matches!(
        with("\"all\"", "all"),
        GmshError::Line { line: 7, .. }
    ));
    // One element more than there are.
    assert!(matches!(
        with("$Elements\n5", "$Elements\n6"),
        GmshError::Line { .. }
    ));
    // A triangle, and quadrilaterals of second order.
    for kind in [2, 10, 16] {
        let error = with("3 3 2 -2 1 10", &format!("3 {kind} 2 2 1 10"));
        assert!(matches!(error, GmshError::Element { element: 3, kind: k, .. } if k == kind));
    }
    let lines = "1 1 2 0 7 10 20\n$EndElements\n";
    let only_lines = format!(
        "{}$Elements\n1\n{lines}",
        TWO.split("$Elements").next().unwrap()
    );
    assert!(matches!(
        refused(&only_lines),
        GmshError::NoQuadrilaterals { .. }
    ));
    assert!(matches!(
        with("20 1 0 1", "10 1 0 1"),
        GmshError::TwoNodes { node: 10, .. }
    ));
    assert!(matches!(
        with("20 50 60 30", "20 50 61 30"),
        GmshError::UnknownNode { node: 61, .. }
    ));
    assert!(matches!(
        with("50 2 0 1", "50 2 0 1.5"),
        GmshError::NotPlane { node: 50, .. }
    ));
    assert!(matches!(
        with("2 1 2 1 1 10 40", "2 1 2 1 1 10 70"),
        GmshError::StrayNode { node: 70, .. }
    ));
    assert!(matches!(
        with("right half", "all"),
        GmshError::TwoGroups { .. }
    ));
    let dented = with("60 2 1 1", "60 1.2 0.2 1");
    let source = match dented {
        GmshError::Mesh { source, .. } => source,
        error => panic!("{error}"),
    };
    assert!(matches!(source, MeshError::Jacobian { element: 1, .. }));
}
