//! Nearly incompressible bodies with one volume change per cell.

use fissure_grid::{Grid, shape};
use fissure_materials::NeoHookean;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Constant, Hold, Plane, Scene, SolveError, Solver};
use fissure_solvers::{Averaging, QuasiStatic, QuasiStaticSettings};
use nalgebra::vector;

const CELL: f64 = 0.25;

/// A beam, 4 m by 1 m, clamped on the left and loaded across on the right.
fn beam(plane: Plane, poisson: f64, load: f64) -> Scene<2> {
    let law = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson,
    };
    let spacing = Spacing(0.5 * CELL);
    let mut scene = Scene::plane(plane);
    scene
        .fill("beam", law, &Block::new([0.0, 0.0], [4.0, 1.0]), &spacing)
        .unwrap()
        .rigid(
            "wall",
            &Block::new([-CELL, -CELL], [0.0, 1.0 + CELL]),
            &spacing,
            Hold::All(vector![1.0, 0.0]),
            Constant(0.0),
        )
        .unwrap()
        .force(
            "load",
            "beam",
            |x| x[0] > 4.0 - CELL,
            move |t| vector![0.0, -load * t],
        )
        .unwrap();
    scene
}

const STRAIN: Plane = Plane::Strain { thickness: 1.0 };

fn solver(averaging: Averaging, tolerance: f64) -> QuasiStatic<shape::Linear, 2> {
    let grid = Grid::over([-1.0, -3.0], [5.0, 2.0], CELL).unwrap();
    let settings = QuasiStaticSettings {
        averaging,
        tolerance,
        ..QuasiStaticSettings::default()
    };
    QuasiStatic::new(grid, shape::Linear, settings).unwrap()
}

/// How far the end sinks, m.
fn sag(poisson: f64, load: f64, averaging: Averaging) -> f64 {
    let mut scene = beam(STRAIN, poisson, load);
    let mut solver = solver(averaging, 1e-6);
    while scene.time() < 1.0 {
        solver.step(&mut scene, 1.0).unwrap();
    }
    let position = scene.bodies()[0].motion().position;
    0.5 - position
        .iter()
        .filter(|x| x[0] > 4.0 - 0.5 * CELL)
        .map(|x| x[1])
        .sum::<f64>()
        / 8.0
}

/// In plane strain a slender beam bends with E/(1 − ν²), and hardly sees how incompressible it is.
#[test]
fn x2_bending_does_not_lock() {
    for (poisson, locked) in [(0.49, 0.9), (0.499, 0.6), (0.4999, 0.5), (0.49999, 0.5)] {
        let expected = (1.0 - f64::powi(poisson, 2)) / (1.0 - 0.3_f64.powi(2));
        let ratio = |averaging| sag(poisson, 1.0, averaging) / sag(0.3, 1.0, averaging) / expected;
        let (own, mean) = (ratio(Averaging::None), ratio(Averaging::Volume));
        println!("nu = {poisson}: {mean:.3} of the deflection, {own:.3} without the mean");
        assert!((mean - 1.0).abs() <= 0.05, "{poisson}: {mean}");
        assert!(own <= locked, "{poisson}: {own}");
    }
}

/// The tangent is the derivative of the forces up to the strain: Newton's method converges fast where the beam
/// sinks by a twentieth of its height, and the laws store the work done.
#[test]
fn large_displacements_converge_and_balance() {
    for poisson in [0.3, 0.499] {
        let mut scene = beam(STRAIN, poisson, 200.0);
        let mut solver = solver(Averaging::Volume, 1e-8);
        let mut balance = 0.0;
        let steps = 5;
        for step in 1..=steps {
            let report = solver
                .step(&mut scene, f64::from(step) / f64::from(steps))
                .unwrap();
            assert!(report.iterations <= 8, "{poisson}: {report:?}");
            let last = solver
                .statistics()
                .residuals
                .windows(2)
                .last()
                .unwrap()
                .to_vec();
            assert!(
                last[1] <= 0.1 * last[0],
                "{poisson}: {:?}",
                solver.statistics()
            );
            balance += report.energy.internal;
        }
        let stored = scene.energy().stored;
        assert!(
            (balance / stored - 1.0).abs() <= 0.01,
            "{poisson}: {balance} {stored}"
        );
    }
}

/// Where the deformation is uniform there is nothing to average.
#[test]
fn uniform_stretch_is_left_alone() {
    let reach = |averaging| {
        let mut scene = Scene::plane(STRAIN);
        let law = NeoHookean {
            density: 1000.0,
            young: 1e6,
            poisson: 0.45,
        };
        let spacing = Spacing(0.5 * CELL);
        scene
            .fill("block", law, &Block::new([0.0, 0.0], [1.0, 1.0]), &spacing)
            .unwrap();
        for (name, from, to, axis, speed) in [
            ("left", [-CELL, 0.0], [0.0, 1.0], vector![1.0, 0.0], 0.0),
            (
                "right",
                [1.0, 0.0],
                [1.0 + CELL, 1.0],
                vector![1.0, 0.0],
                0.1,
            ),
            ("below", [0.0, -CELL], [1.0, 0.0], vector![0.0, 1.0], 0.0),
        ] {
            let hold = Hold::Component(axis);
            scene
                .rigid(name, &Block::new(from, to), &spacing, hold, Constant(speed))
                .unwrap();
        }
        solver(averaging, 1e-10).step(&mut scene, 1.0).unwrap();
        let stress = scene.bodies()[0].motion().stress;
        (stress[0].xx(), scene.reaction("right").unwrap()[0])
    };
    let (own, mean) = (reach(Averaging::None), reach(Averaging::Volume));
    assert!((own.0 / mean.0 - 1.0).abs() <= 1e-9, "{own:?} {mean:?}");
    assert!((own.1 / mean.1 - 1.0).abs() <= 1e-9, "{own:?} {mean:?}");
}

#[test]
fn plane_stress_is_refused() {
    let mut scene = beam(Plane::Stress { thickness: 1.0 }, 0.3, 1.0);
    let refused = solver(Averaging::Volume, 1e-6).step(&mut scene, 1.0);
    assert!(matches!(refused, Err(SolveError::Unsupported { .. })));
}

/// Force that widens a tube over the exact one: radii 0.5 and 1.5 m, 0.5 m high between smooth plates, inner face
/// displaced by 1e-6 m.
fn widening(poisson: f64, averaging: Averaging) -> f64 {
    let (inner, outer, height, way) = (0.5, 1.5, 0.5, 1e-6);
    let law = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson,
    };
    let spacing = Spacing(0.5 * CELL);
    let mut scene = Scene::axisymmetric();
    let tube = Block::new([inner, 0.0], [outer, height]);
    scene.fill("tube", law, &tube, &spacing).unwrap();
    for (name, from, to, axis, speed) in [
        (
            "core",
            [inner - CELL, 0.0],
            [inner, height],
            vector![1.0, 0.0],
            way,
        ),
        (
            "below",
            [inner, -CELL],
            [outer, 0.0],
            vector![0.0, 1.0],
            0.0,
        ),
        (
            "above",
            [inner, height],
            [outer, height + CELL],
            vector![0.0, 1.0],
            0.0,
        ),
    ] {
        let hold = Hold::Component(axis);
        scene
            .rigid(name, &Block::new(from, to), &spacing, hold, Constant(speed))
            .unwrap();
    }
    let grid = Grid::over([0.0, -1.0], [2.5, 2.0], CELL).unwrap();
    let settings = QuasiStaticSettings {
        averaging,
        tolerance: 1e-6,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid, shape::Linear, settings).unwrap();
    solver.step(&mut scene, 1.0).unwrap();
    let force = scene.reaction("core").unwrap()[0];
    // u = A r + B/r, no pressure at the outer face [Timoshenko and Goodier 1970, sec. 28].
    let elastic = law.elastic();
    let shear = elastic.shear_modulus();
    let ratio = shear / ((elastic.lambda() + shear) * outer * outer);
    let b = way / (ratio * inner + inner.recip());
    let pressure = 2.0 * shear * b * (inner.powi(-2) - outer.powi(-2));
    force / (pressure * std::f64::consts::TAU * inner * height)
}

/// The hoop stretch is one of those that make the volume. What is left is the error of four cells across the wall, that of
/// a tube that is not incompressible.
#[test]
fn x2_a_tube_does_not_lock() {
    let forces = |averaging| [0.3, 0.49, 0.4999].map(|poisson| widening(poisson, averaging));
    let (own, mean) = (forces(Averaging::None), forces(Averaging::Volume));
    println!("force over exact: {own:?} by itself, {mean:?} with the mean");
    assert!(
        mean.iter().all(|force| (force - 1.0).abs() <= 0.015),
        "{mean:?}"
    );
    assert!(own[2] >= 10.0, "{own:?}");
}
