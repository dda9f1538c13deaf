//! Reactions of rollers that are not at right angles: a block that rests in a groove.
//!
//! Every node of the block is held by both faces of the groove, so the forces of the faces are those
//! that carry the weight: `λ₁ n₁ + λ₂ n₂ = −m g`, whatever the order of the conditions.

use fissure::nalgebra::Matrix2;
use fissure::prelude::*;
use fissure::solvers::{QuasiStatic, QuasiStaticSettings};
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

const H: f64 = 0.125;
const RATE: f64 = 30.0;

/// Direction and speed of each face; the block moves as a whole.
fn faces() -> [(&'static str, Vector2<f64>, f64); 2] {
    [
        ("steep", Vector2::new(0.96, 0.28), 2e-3),
        ("flat", Vector2::new(-0.6, 0.8), -1e-3),
    ]
}

/// The velocity that both faces leave, and their forces on a block of this weight.
fn exact(weight: Vector2<f64>) -> (Vector2<f64>, [Vector2<f64>; 2]) {
    let [(_, a, v), (_, b, w)] = faces();
    let normals = Matrix2::from_columns(&[a, b]);
    let inverse = normals.try_inverse().unwrap();
    let forces = inverse * -weight;
    let velocity = inverse.transpose() * Vector2::new(v, w);
    (velocity, [a * forces[0], b * forces[1]])
}

fn groove(swapped: bool, load: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Scene<2> {
    let mut scene = Table::scene(Space::Plane);
    let block = Block::new([0.0, 0.0], [3.0 * H, 2.0 * H]);
    scene
        .fill("block", rubber(), &block, &Spacing(H / 2.0))
        .unwrap()
        .body_force(move |_, t| Vector2::new(0.3, -1.0) * load(t));
    let mut faces = faces();
    if swapped {
        faces.reverse();
    }
    for (name, direction, speed) in faces {
        scene
            .hold(
                name,
                "block",
                |_| true,
                Hold::Component(direction),
                Constant(speed),
            )
            .unwrap();
    }
    scene
}

fn grid() -> Grid<2> {
    Grid::over([-4.0 * H; 2], [8.0 * H; 2], H).unwrap()
}

fn check(scene: &Scene<2>, weight: Vector2<f64>, kick: Vector2<f64>, what: &str) {
    let (_, forces) = exact(weight + kick);
    for ((name, ..), force) in faces().iter().zip(forces) {
        let reaction = scene.reaction(name).unwrap();
        let error = (reaction - force).norm() / force.norm();
        println!("{what}: {name} {reaction:?}, off by {error:.1e}");
        // A node that the block reaches with less than 1e-10 is not held.
        assert!(error <= 1e-10, "{what}: {name} {reaction:?} for {force:?}");
    }
}

#[test]
fn two_skew_faces_carry_a_weight_each_along_its_own_normal() {
    for swapped in [false, true] {
        let mut scene = groove(swapped, |_| RATE);
        let mass: f64 = scene.bodies()[0].particles().mass.iter().sum();
        let weight = Vector2::new(0.3, -1.0) * (RATE * mass);
        let (velocity, _) = exact(weight);
        let settings = ExplicitSettings::default();
        let mut solver = Table::solver(ShapeKind::Gimp, grid(), settings).unwrap();
        // The first step sets it in motion.
        let report = solver.step(&mut scene, f64::INFINITY).unwrap();
        let kick = velocity * (-mass / report.dt);
        check(&scene, weight, kick, "explicit, first step");
        solver.step(&mut scene, f64::INFINITY).unwrap();
        check(&scene, weight, Vector2::zeros(), "explicit");
    }
}

#[test]
fn two_skew_faces_do_the_work_of_a_quasi_static_step() {
    for swapped in [false, true] {
        // The weight grows with time: at the start nothing is out of balance.
        let mut scene = groove(swapped, |t| RATE * t);
        let mass: f64 = scene.bodies()[0].particles().mass.iter().sum();
        let settings = QuasiStaticSettings {
            step: 0.25,
            ..Default::default()
        };
        let mut solver = QuasiStatic::new(grid(), shape::Linear, settings).unwrap();
        run(&mut scene, &mut solver, Until::Time(1.0), &mut []).unwrap();
        let weight = Vector2::new(0.3, -1.0) * (RATE * mass);
        check(&scene, weight, Vector2::zeros(), "quasi-static");
        // The loads give what the faces take.
        let work = 0.5 * weight.dot(&exact(weight).0);
        let error = (scene.energy().external / work).abs();
        println!("work of the loads {work:e} J, of all forces off by {error:.1e} of it");
        assert!(error <= 1e-12, "{error:e}");
    }
}
