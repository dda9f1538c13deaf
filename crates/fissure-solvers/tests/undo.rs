//! A step that writes over velocities and stresses gives the bits of one that keeps two copies, and leaves the scene as it
//! was when it fails.

#![allow(clippy::panic, clippy::unwrap_used)]

use fissure_grid::shape::{Bspline2, Gimp};
use fissure_grid::{Grid, Shape};
use fissure_materials::{Decohesive, Isotropic, NeoHookean, Normal, softening::Linear};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Plane, Scene, SolveError, Solver};
use fissure_solvers::{Explicit, ExplicitSettings, StressUpdate, Transfer};
use nalgebra::Vector2;

fn apic() -> ExplicitSettings {
    by(Transfer::Apic)
}

fn by(transfer: Transfer) -> ExplicitSettings {
    ExplicitSettings {
        transfer,
        stress_update: StressUpdate::Last,
        ..ExplicitSettings::default()
    }
}

/// A rubber block and a concrete one that tears, on their way out of the grid.
fn scene() -> Scene<2> {
    let rubber = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let concrete = Decohesive {
        elastic: Isotropic {
            density: 1000.0,
            young: 1e6,
            poisson: 0.2,
        },
        strength: 1e4,
        toughness: 500.0,
        softening: Linear,
        normal: Normal::Rankine,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let (left, right) = (
        Block::new([5.0, 2.0], [7.0, 4.0]),
        Block::new([9.0, 2.0], [11.0, 4.0]),
    );
    scene
        .fill("rubber", rubber, &left, &Spacing(0.125))
        .unwrap();
    scene
        .fill("concrete", concrete, &right, &Spacing(0.125))
        .unwrap();
    let rubber = |x: &Vector2<f64>| Vector2::new(5.0 + x[1].sin(), x[0].cos());
    scene.set_velocity("rubber", rubber).unwrap();
    let concrete = |x: &Vector2<f64>| Vector2::new(5.0 + 2.0 * (x[0] - 10.0), 0.0);
    scene.set_velocity("concrete", concrete).unwrap();
    scene
}

fn solver<S: Shape<2>>(shape: S, settings: ExplicitSettings) -> Explicit<S, 2> {
    let grid = Grid::over([0.0, 0.0], [12.0, 6.0], 0.25).unwrap();
    Explicit::new(grid, shape, settings).unwrap()
}

/// Everything that a step changes, particle by particle, whatever their order: numbers by the name of their column.
fn all(scene: &Scene<2>) -> Vec<(&'static str, Vec<f64>)> {
    let mut columns = vec![("time", vec![scene.time()])];
    for body in scene.bodies() {
        let (id, motion) = (&body.particles().id, body.motion());
        let mut rows: Vec<usize> = (0..id.len()).collect();
        rows.sort_by_key(|&row| id[row]);
        let mut column = |name, of: &dyn Fn(usize) -> Vec<f64>| {
            columns.push((name, rows.iter().flat_map(|&row| of(row)).collect()));
        };
        column("position", &|row| motion.position[row].as_slice().to_vec());
        column("velocity", &|row| motion.velocity[row].as_slice().to_vec());
        let gradient = motion.deformation_gradient;
        column("gradient", &|row| gradient[row].as_slice().to_vec());
        column("stress", &|row| motion.stress[row].mandel.to_vec());
        let affine = |row| motion.affine.get(row).copied().unwrap_or_default();
        column("affine", &|row| affine(row).as_slice().to_vec());
        for name in body.law().names() {
            let values = body.value(name).unwrap();
            column(name, &|row| vec![values[row]]);
        }
    }
    columns
}

/// Names of the columns that are not the same.
fn changed(
    before: &[(&'static str, Vec<f64>)],
    after: &[(&'static str, Vec<f64>)],
) -> Vec<&'static str> {
    assert_eq!(before.len(), after.len());
    let pairs = before.iter().zip(after);
    let changed = pairs.filter(|(before, after)| before != after);
    changed.map(|(before, _)| before.0).collect()
}

fn a_failed_step_leaves_all<S: Shape<2>>(shape: S, transfer: Transfer) {
    let (mut scene, mut solver) = (scene(), solver(shape, by(transfer)));
    let mut steps = 0;
    let before = loop {
        let before = all(&scene);
        match solver.step(&mut scene, f64::INFINITY) {
            Ok(_) => steps += 1,
            Err(SolveError::Outside { .. }) => break before,
            Err(other) => panic!("{other}"),
        }
    };
    assert!(steps > 30, "{steps}");
    let opening = scene.body("concrete").unwrap().value("opening").unwrap();
    let cracked = opening.iter().filter(|&&opening| opening > 0.0).count();
    assert!(cracked > 10 && cracked < opening.len(), "{cracked}");
    assert_eq!(
        changed(&before, &all(&scene)),
        [""; 0],
        "after step {steps}"
    );
    // Now there is no step before that could be made again.
    assert!(solver.step(&mut scene, f64::INFINITY).is_err());
    assert_eq!(changed(&before, &all(&scene)), [""; 0], "again");
}

#[test]
fn a_failed_step_leaves_the_scene_as_it_was() {
    a_failed_step_leaves_all(Bspline2, Transfer::Apic);
    a_failed_step_leaves_all(Bspline2, Transfer::Mls);
    a_failed_step_leaves_all(Gimp, Transfer::Apic);
}

#[test]
fn one_copy_gives_the_bits_of_two() {
    // Viscosity that does nothing, but needs both copies.
    let twice = ExplicitSettings {
        viscosity: Some((0.0, 0.0)),
        ..apic()
    };
    let run = |settings| {
        let (mut scene, mut solver) = (scene(), solver(Bspline2, settings));
        for _ in 0..30 {
            solver.step(&mut scene, f64::INFINITY).unwrap();
        }
        let copies = |body: &fissure_scene::Body<2>| body.particles().trial.stress.len();
        let copies: usize = scene.bodies().iter().map(copies).sum();
        (all(&scene), copies)
    };
    let (once, twice) = (run(apic()), run(twice));
    assert_eq!(changed(&once.0, &twice.0), [""; 0]);
    assert_eq!(once.1, 0);
    assert!(twice.1 > 0);
}
