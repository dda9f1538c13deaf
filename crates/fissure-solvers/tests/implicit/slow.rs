//! A pull so slow that little is left to balance but round-off.

use fissure_grid::{Grid, shape};
use fissure_materials::Isotropic;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Hold, Plane, Scene, Solver, Velocity};
use fissure_solvers::{Implicit, ImplicitSettings};
use nalgebra::vector;

/// A stiff bar is pulled smoothly over twenty transits of a wave. In the first steps the ends move so little that what
/// rounding leaves of the forces is 1e-7 of them, beyond any correction: every step is in balance after one, and none
/// is cut for want of it.
#[test]
fn a_pull_too_small_for_the_tolerance_is_in_balance_at_round_off() {
    let stone = Isotropic {
        density: 2350.0,
        young: 24.9e9,
        poisson: 0.18,
    };
    let (length, width) = (64.0, 8.0);
    let ramp = 20.0 * length / stone.p_wave_speed();
    let along = || Hold::Component(vector![1.0, 0.0]);
    let across = |from, to| Block::new([from, 0.0], [to, width]);
    let speed =
        move |t: f64| 1e-4 * length / ramp * (1.0 - (std::f64::consts::TAU * t / ramp).cos());
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene
        .fill("bar", stone, &across(0.0, length), &Spacing(0.5))
        .unwrap()
        .rigid(
            "held",
            &across(-1.0, 0.0),
            &Spacing(0.5),
            along(),
            Velocity(|_| 0.0),
        )
        .unwrap();
    scene
        .rigid(
            "pulled",
            &across(length, length + 1.0),
            &Spacing(0.5),
            along(),
            Velocity(speed),
        )
        .unwrap();
    let grid = Grid::over([-4.0; 2], [length + 4.0, width + 4.0], 1.0).unwrap();
    let settings = ImplicitSettings {
        step: ramp / 80.0,
        ..ImplicitSettings::default()
    };
    let mut solver = Implicit::new(grid, shape::Linear, settings).unwrap();
    let (mut iterations, mut cuts) = (0, 0);
    for step in 1..=20 {
        let report = solver.step(&mut scene, ramp).unwrap();
        iterations += report.iterations;
        cuts += solver.statistics().cuts;
        if step == 1 {
            println!(
                "residuals of the first step {:?}",
                solver.statistics().residuals
            );
        }
    }
    println!("{iterations} iterations, {cuts} cuts in 20 steps");
    assert_eq!((iterations, cuts), (20, 0));
}
