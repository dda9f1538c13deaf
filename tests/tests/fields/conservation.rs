//! Contact takes no momentum, whatever the discretisation, and forces are those of the momentum.

use fissure::nalgebra::SVector;
use fissure::prelude::*;
use fissure_tests::{Build, Case, Space, Table, cases, momentum, momentum_scale, rubber};

const H: f64 = 0.125;
const STEPS: usize = 20;

/// Three blocks, two of which touch from the start, the third hits both aslant.
fn collision<const D: usize>(case: &Case) -> Scene<D>
where
    Table: Build<D>,
{
    let mut scene: Scene<D> = Table::scene(case.space);
    let block = |x: f64, y: f64, width: f64| {
        let (mut min, mut max) = ([0.03 * H; D], [3.03 * H; D]);
        (min[0], max[0]) = (x, x + width);
        (min[1], max[1]) = (y, y + 2.5 * H);
        Block::new(min, max)
    };
    let left = 8.03 * H;
    scene
        .fill(
            "below",
            rubber(),
            &block(left, 0.03 * H, 3.0 * H),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .fill(
            "above",
            rubber(),
            &block(left, 2.53 * H, 3.0 * H),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .fill(
            "right",
            rubber(),
            &block(left + 3.1 * H, 1.3 * H, 2.0 * H),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .contact(
            "layer",
            "below",
            "above",
            ContactLaw::Coulomb { friction: 0.3 },
        )
        .unwrap()
        .contact("low", "right", "below", ContactLaw::Stick)
        .unwrap()
        .contact("high", "above", "right", ContactLaw::Frictionless)
        .unwrap()
        .set_velocity("right", |x| {
            let mut v = SVector::repeat(0.3 * x[1]);
            (v[0], v[1]) = (-8.0, 0.5);
            v
        })
        .unwrap();
    scene
}

fn worst<const D: usize>(case: &Case) -> (f64, f64)
where
    Table: Build<D>,
{
    let mut scene = collision::<D>(case);
    let grid = Grid::over([-4.0 * H; D], [24.0 * H; D], H).unwrap();
    let mut solver = Table::solver(case.shape, grid, case.settings(0.3)).unwrap();
    let (mut worst, mut impulse) = (0.0, SVector::<f64, D>::zeros());
    for _ in 0..STEPS {
        let before = momentum(&scene);
        let report = solver.step(&mut scene, f64::INFINITY).unwrap();
        impulse += (scene.contact_force("low").unwrap() - scene.contact_force("high").unwrap())
            * report.dt;
        let change = momentum(&scene) - before;
        let axes = if case.space == Space::Axisymmetric {
            1..2
        } else {
            0..D
        };
        for axis in axes {
            let error = change[axis].abs() / momentum_scale(&scene);
            if !(error <= worst) {
                worst = error;
            }
        }
    }
    assert!(
        scene.energy().worst_balance <= 1e-11,
        "{case:?}: {:e}",
        scene.energy().worst_balance
    );
    // The two blocks were pushed to the left.
    assert!(impulse[0] < 0.0, "{case:?}: {impulse:?}");
    (worst, -impulse[0])
}

fn conserved<const D: usize>(space: Space)
where
    Table: Build<D>,
{
    let mut largest = 0.0_f64;
    // In space every seventh of the table: 7 has no factor in common with 5, 10 and 3, so that each shape and each transfer is among them.
    for case in cases(space).into_iter().step_by(if D == 3 { 7 } else { 1 }) {
        let (error, _) = worst::<D>(&case);
        assert!(error <= 1e-13, "{case:?}: {error:e} in a step");
        largest = largest.max(error);
    }
    println!("{space:?}: {largest:.1e} of the momenta in a step at most");
}

#[test]
fn contact_takes_no_momentum_in_plane() {
    conserved::<2>(Space::Plane);
}

#[test]
fn contact_takes_no_momentum_axisymmetric() {
    conserved::<2>(Space::Axisymmetric);
}

#[test]
fn contact_takes_no_momentum_in_space() {
    conserved::<3>(Space::Solid);
}
