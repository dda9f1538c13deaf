//! One strain for the particles of a cell.

use fissure_grid::{Grid, shape};
use fissure_materials::NeoHookean;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Constant, Hold, Plane, Scene, SolveError, Solver};
use fissure_solvers::{Averaging, QuasiStatic, QuasiStaticSettings};
use nalgebra::vector;

const CELL: f64 = 0.25;
const CELL_MEAN: Averaging = Averaging::Strain { hourglass: 0.1 };

fn solver(averaging: Averaging) -> QuasiStatic<shape::Linear, 2> {
    let grid = Grid::over([-1.0, -3.0], [6.0, 3.0], CELL).unwrap();
    let settings = QuasiStaticSettings {
        averaging,
        tolerance: 1e-10,
        ..QuasiStaticSettings::default()
    };
    QuasiStatic::new(grid, shape::Linear, settings).unwrap()
}

/// A block whose particles are no lattice of the grid, clamped on the left and loaded across on the right.
fn block(plane: Plane) -> Scene<2> {
    let law = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let spacing = Spacing(0.5 * CELL);
    let mut scene = Scene::plane(plane);
    scene
        .fill(
            "block",
            law,
            &Block::new([0.03, 0.01], [1.03, 0.76]),
            &spacing,
        )
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
            "block",
            |x| x[0] > 1.03 - CELL,
            move |t| vector![0.0, -4e3 * t],
        )
        .unwrap();
    scene
}

const STRAIN: Plane = Plane::Strain { thickness: 1.0 };

/// The tangent is the derivative of the forces at large strain, with what holds particles to their cell's mean at
/// work; and the works balance.
#[test]
fn newton_converges_quadratically_and_works_balance() {
    let mut scene = block(STRAIN);
    let mut solver = solver(CELL_MEAN);
    let (mut external, mut taken, mut held) = (0.0, 0.0, 0.0);
    for step in 1..=10 {
        let report = solver.step(&mut scene, 0.1 * f64::from(step)).unwrap();
        let residuals = &solver.statistics().residuals;
        assert!(report.iterations <= 4, "{residuals:?}");
        let near = residuals
            .windows(2)
            .filter(|pair| pair[0] <= 1e-2 && pair[1] >= 1e-12);
        for pair in near {
            assert!(pair[1] <= 0.1 * pair[0].powi(2) + 1e-12, "{residuals:?}");
        }
        external += report.energy.external;
        taken += report.energy.internal + report.energy.stabilisation;
        held += report.energy.stabilisation;
    }
    assert!((taken / external - 1.0).abs() <= 1e-3, "{taken} {external}");
    let stored = scene.energy().stored;
    assert!(
        ((stored + held) / external - 1.0).abs() <= 0.02,
        "{stored} and {held} of {external}"
    );
    assert!(
        held > 0.0 && held <= 0.05 * external,
        "{held} of {external}"
    );
}

#[test]
fn a_restarted_run_has_the_same_bits() {
    let run = |restart: bool| {
        let mut scene = block(STRAIN);
        let mut first = solver(CELL_MEAN);
        for step in 1..=2 {
            first.step(&mut scene, 0.1 * f64::from(step)).unwrap();
        }
        if restart {
            let mut again = block(STRAIN);
            again.restore(&scene.save().unwrap()).unwrap();
            let memory = first.memory();
            first = solver(CELL_MEAN);
            first.recall(&memory);
            scene = again;
        }
        first.step(&mut scene, 0.3).unwrap();
        scene.bodies()[0].motion().position.to_vec()
    };
    assert_eq!(run(false), run(true));
}

#[test]
fn what_makes_no_sense_is_refused() {
    for hourglass in [-0.1, f64::NAN, f64::INFINITY] {
        let grid = Grid::over([0.0, 0.0], [1.0, 1.0], CELL).unwrap();
        let settings = QuasiStaticSettings {
            averaging: Averaging::Strain { hourglass },
            ..QuasiStaticSettings::default()
        };
        let refused = QuasiStatic::new(grid, shape::Linear, settings);
        assert!(matches!(
            refused,
            Err(SolveError::Setting {
                setting: "hourglass",
                ..
            })
        ));
    }
}
