//! A correction that leaves more unbalanced is shortened, or the system stiffened.

use fissure_grid::{Grid, shape};
use fissure_materials::NeoHookean;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Constant, Hold, Plane, Scene, SolveError, Solver};
use fissure_solvers::{QuasiStatic, QuasiStaticSettings, Safeguard};
use nalgebra::vector;

const CELL: f64 = 0.25;

const LAW: NeoHookean = NeoHookean {
    density: 1000.0,
    young: 1e6,
    poisson: 0.3,
};

/// A block of 1 m on rollers, pressed by a load of so many times its modulus.
fn block(load: f64) -> Scene<2> {
    let spacing = Spacing(0.5 * CELL);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene
        .fill("block", LAW, &Block::new([0.0, 0.0], [1.0, 1.0]), &spacing)
        .unwrap()
        .rigid(
            "left",
            &Block::new([-CELL, 0.0], [0.0, 1.0]),
            &spacing,
            Hold::Component(vector![1.0, 0.0]),
            Constant(0.0),
        )
        .unwrap()
        .rigid(
            "below",
            &Block::new([0.0, -CELL], [1.0, 0.0]),
            &spacing,
            Hold::Component(vector![0.0, 1.0]),
            Constant(0.0),
        )
        .unwrap()
        .force(
            "load",
            "block",
            |x| x[0] > 1.0 - 0.5 * CELL,
            move |t| vector![-load * LAW.young * t, 0.0],
        )
        .unwrap();
    scene
}

/// All of the load in one step that may not be cut: residuals, and what the wall bears over the load.
fn pressed(load: f64, safeguard: Safeguard) -> Result<(Vec<f64>, f64), SolveError> {
    let mut scene = block(load);
    let settings = QuasiStaticSettings {
        safeguard,
        max_cuts: 0,
        ..QuasiStaticSettings::default()
    };
    let grid = Grid::over([-1.0, -1.0], [3.0, 3.0], CELL).unwrap();
    let mut solver = QuasiStatic::new(grid, shape::Linear, settings)?;
    solver.step(&mut scene, 1.0)?;
    let borne = scene.reaction("left").unwrap()[0] / (load * LAW.young);
    Ok((solver.statistics().residuals.clone(), borne))
}

/// Where whole corrections lower the residual, nothing is shortened.
#[test]
fn small_steps_are_not_touched() {
    for load in [0.05, 0.2] {
        let [stiffened, searched] = [Safeguard::Stiffening, Safeguard::LineSearch]
            .map(|safeguard| pressed(load, safeguard).unwrap());
        assert_eq!(stiffened, searched, "{load}");
    }
}

/// A whole correction turns particles inside out or throws them off the grid; shorter ones lead to equilibrium, with the speed of Newton's method at the end.
#[test]
fn loads_of_the_modulus_balance_in_one_step() {
    for load in [0.5, 1.0, 2.0] {
        let refused = pressed(load, Safeguard::Stiffening);
        assert!(refused.is_err(), "{load}: {refused:?}");
        let (residuals, borne) = pressed(load, Safeguard::LineSearch).unwrap();
        println!("{load}: {} tries, borne {borne}", residuals.len() - 1);
        assert!(residuals.len() <= 20, "{load}: {residuals:?}");
        assert!((borne - 1.0).abs() <= 1e-7, "{load}: {borne}");
        let [.., before, last] = residuals[..] else {
            panic!("{residuals:?}");
        };
        assert!(last <= 10.0 * before * before, "{load}: {residuals:?}");
    }
}
