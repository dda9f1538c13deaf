//! D12. The force at a grip is the force through every section.

use fissure::prelude::*;
use fissure::solvers::{QuasiStatic, QuasiStaticSettings};
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

const H: f64 = 0.0625;

/// A bar of 16 by 4 cells, pulled by rigid bodies; `speed` is of either grip.
fn bar(speed: impl Fn(f64) -> f64 + Send + Sync + Copy + 'static) -> Scene<2> {
    let mut scene = Table::scene(Space::Plane);
    let (l, w) = (16.0 * H, 4.0 * H);
    let grip = Spacing(H / 2.0);
    let along = || Hold::Component(Vector2::x());
    scene
        .fill(
            "bar",
            rubber(),
            &Block::new([0.0, 0.0], [l, w]),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .rigid(
            "left",
            &Block::new([-H, 0.0], [0.0, w]),
            &grip,
            along(),
            Velocity(move |t| -speed(t)),
        )
        .unwrap()
        .rigid(
            "right",
            &Block::new([l, 0.0], [l + H, w]),
            &grip,
            along(),
            Velocity(speed),
        )
        .unwrap();
    scene
}

fn grid() -> Grid<2> {
    Grid::over([-4.0 * H, -4.0 * H], [20.0 * H, 8.0 * H], H).unwrap()
}

/// `∫σ_xx dV` over a slab of whole cells, by its length.
fn section(scene: &Scene<2>, first: f64, cells: f64) -> f64 {
    let body = &scene.bodies()[0];
    let motion = body.motion();
    let mut force = 0.0;
    for (i, x) in motion.position.iter().enumerate() {
        if x[0] > first * H && x[0] < (first + cells) * H {
            let volume = body.particles().volume[i] * motion.deformation_gradient[i].determinant();
            force += motion.stress[i].xx() * volume;
        }
    }
    force / (cells * H)
}

#[test]
fn d12_slow_pull_has_one_force_at_grips_and_sections() {
    // Strain 1e-4: positions stay in their cells.
    let mut scene = bar(|t| 1e-4 * (t / 0.2).min(1.0));
    let mut solver = Table::solver(ShapeKind::Linear, grid(), ExplicitSettings::default()).unwrap();
    run(&mut scene, &mut *solver, Until::Time(0.5), &mut []).unwrap();
    let right = scene.reaction("right").unwrap()[0];
    let left = scene.reaction("left").unwrap()[0];
    println!("left {left:.3} right {right:.3}");
    for first in [4.0, 8.0, 11.0] {
        let through = section(&scene, first, 1.0);
        println!("section {first}: {through:.3}");
        assert!(
            (through / right - 1.0).abs() <= 0.01,
            "{through} at cell {first}, {right}"
        );
        assert!(
            (through / left + 1.0).abs() <= 0.01,
            "{through} at cell {first}, {left}"
        );
    }
}

#[test]
fn d12_quasi_static_pull_has_one_force_at_grips_and_sections() {
    let mut scene = bar(|_| 1e-4);
    let settings = QuasiStaticSettings {
        step: 0.05,
        ..Default::default()
    };
    let mut solver = QuasiStatic::new(grid(), shape::Linear, settings).unwrap();
    run(&mut scene, &mut solver, Until::Time(0.5), &mut []).unwrap();
    let right = scene.reaction("right").unwrap()[0];
    let left = scene.reaction("left").unwrap()[0];
    println!("quasi-static: left {left:.6} right {right:.6}");
    assert!((left / right + 1.0).abs() <= 1e-8);
    for first in [0.0, 4.0, 8.0, 11.0, 15.0] {
        let through = section(&scene, first, 1.0);
        println!("section {first}: {through:.6}");
        assert!(
            (through / right - 1.0).abs() <= 1e-3,
            "{through} at cell {first}, {right}"
        );
    }
    // The work at the grips, the work on the nodes and what the law stores come from three places.
    // The first two differ by what the fresh grid of a step does to the forces at a strain of 1e-4,
    // the last two by the square of the step.
    let energy = scene.energy();
    let (work, taken) = (energy.external, energy.internal);
    let (reset, time) = (taken / work - 1.0, energy.imbalance() / work);
    println!(
        "external {work:.6e}, internal off by {reset:.1e}, imbalance {time:.1e}, worst step {:.1e}",
        energy.worst_balance
    );
    assert!(energy.worst_balance <= 1e-5 && reset.abs() <= 1e-5 && time.abs() <= 1e-6);
    // Not one number in two places.
    assert!(energy.internal != energy.external);
}
