//! What a mesh refuses before the first step, and holds by places.

use fissure_grid::{Grid, QuadMesh, shape};
use fissure_materials::NeoHookean;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Constant, ContactLaw, CrackSettings, Hold, Plane, Scene, SolveError, Solver};
use fissure_solvers::{
    Explicit, ExplicitSettings, Implicit, ImplicitSettings, QuasiStatic, QuasiStaticSettings,
};
use nalgebra::{Vector2, vector};

use crate::meshes::mapped;

const H: f64 = 0.125;

fn square() -> QuadMesh {
    mapped(8, 8, |i, j| Vector2::new(i, j) * H)
}

fn law() -> NeoHookean {
    NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    }
}

fn two_blocks() -> Scene<2> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    for (name, x) in [("a", 0.25), ("b", 0.5)] {
        let block = Block::new([x, 0.25], [x + 0.25, 0.5]);
        scene.fill(name, law(), &block, &Spacing(0.5 * H)).unwrap();
    }
    scene
}

/// The errors of every solver.
fn refusals(grid: &Grid<2>, scene: impl Fn() -> Scene<2>) -> [SolveError; 3] {
    let shape = || shape::Isoparametric(square());
    let grid = || grid.clone();
    let mut explicit = Explicit::new(grid(), shape(), ExplicitSettings::default()).unwrap();
    let mut quasi = QuasiStatic::new(grid(), shape(), QuasiStaticSettings::default()).unwrap();
    let mut implicit = Implicit::new(grid(), shape(), ImplicitSettings::default()).unwrap();
    let solvers: [&mut dyn Solver<2>; 3] = [&mut explicit, &mut quasi, &mut implicit];
    solvers.map(|solver| {
        let mut scene = scene();
        let error = solver.step(&mut scene, 1.0).unwrap_err();
        assert_eq!(scene.step(), 0);
        error
    })
}

#[test]
fn what_needs_windows_of_a_grid_is_refused() {
    let cracked = || {
        let mut scene = two_blocks();
        let points = [[0.3, 0.3], [0.4, 0.4]];
        scene
            .crack("crack", &points, CrackSettings::default())
            .unwrap();
        scene
    };
    let touching = || {
        let mut scene = two_blocks();
        scene
            .contact("touch", "a", "b", ContactLaw::default())
            .unwrap();
        scene
    };
    let own = square().grid();
    for error in refusals(&own, cracked)
        .into_iter()
        .chain(refusals(&own, touching))
    {
        assert!(matches!(error, SolveError::Unsupported { .. }), "{error}");
    }
    // A grid that is not the mesh's own.
    let other = Grid::over([0.0, 0.0], [1.0, 1.0], 0.25).unwrap();
    for error in refusals(&other, two_blocks) {
        assert!(matches!(error, SolveError::Unsupported { .. }), "{error}");
    }
}

/// In the box of the mesh but in none of its elements.
#[test]
fn a_particle_outside_is_named() {
    let beside = || {
        let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
        let block = Block::new([0.25, 0.25], [0.75, 0.75]);
        scene
            .fill("block", law(), &block, &Spacing(0.5 * H))
            .unwrap();
        scene
    };
    let hole = {
        let all = square();
        let keep = |k: &usize| ![27, 28, 35, 36].contains(k);
        let elements = (0..64).filter(keep).map(|k| all.elements()[k]).collect();
        QuadMesh::new(all.nodes().to_vec(), elements).unwrap()
    };
    assert_eq!(hole.grid(), square().grid());
    let settings = ExplicitSettings::default();
    let mut solver = Explicit::new(hole.grid(), shape::Isoparametric(hole), settings).unwrap();
    let error = solver.step(&mut beside(), 1.0).unwrap_err();
    assert!(
        matches!(error, SolveError::Outside { step: 1, .. }),
        "{error}"
    );
    // One that leaves the mesh on its way.
    let mesh = square();
    let mut solver = Explicit::new(mesh.grid(), shape::Isoparametric(mesh), settings).unwrap();
    let mut scene = beside();
    scene.set_velocity("block", |_| vector![3.0, 1.0]).unwrap();
    let error = loop {
        if let Err(error) = solver.step(&mut scene, 1.0) {
            break error;
        }
    };
    assert!(matches!(error, SolveError::Outside { .. }), "{error}");
    assert!(scene.time() * 3.0 >= 0.25);
}

/// A bar between two lines of nodes, one of which moves: with every shape whose point reaches one node, on a grid or a mesh.
#[test]
fn places_hold_their_nodes() {
    let pulled = |solver: &mut dyn Solver<2>| {
        let mut scene = Scene::plane(Plane::Strain { thickness: 2.0 });
        let block = Block::new([0.0, 0.0], [1.0, 0.25]);
        scene.fill("bar", law(), &block, &Spacing(0.5 * H)).unwrap();
        let line = |x: f64| [0.0, H, 2.0 * H].map(|y| Vector2::new(x, y));
        let along = Hold::Component(vector![1.0, 0.0]);
        scene
            .hold_places("left", &line(0.0), along, Constant(0.0))
            .unwrap()
            .hold_places("right", &line(1.0), along, Constant(1e-6))
            .unwrap();
        solver.step(&mut scene, 1.0).unwrap();
        scene.reaction("right").unwrap()[0]
    };
    let settings = QuasiStaticSettings::default();
    let grid = || Grid::over([-0.5, -0.5], [1.5, 0.75], H).unwrap();
    let mesh = mapped(16, 10, |i, j| Vector2::new(i - 4.0, j - 4.0) * H);
    let loads = [
        pulled(&mut QuasiStatic::new(grid(), shape::Linear, settings).unwrap()),
        pulled(&mut QuasiStatic::new(grid(), shape::Gimp, settings).unwrap()),
        pulled(&mut QuasiStatic::new(grid(), shape::Cpdi, settings).unwrap()),
        pulled(&mut QuasiStatic::new(mesh.grid(), shape::Isoparametric(mesh), settings).unwrap()),
    ];
    let exact = 1e6 / (1.0 - 0.3 * 0.3) * 0.5 * 1e-6;
    for (k, load) in loads.into_iter().enumerate() {
        // Domains of particles reach beyond the ends, where nothing is held.
        let bound = if k == 1 || k == 2 { 0.2 } else { 1e-5 };
        assert!((load / exact - 1.0).abs() <= bound, "{k}: {load} {exact}");
    }
    assert!((loads[0] / loads[3] - 1.0).abs() <= 1e-9);
    let mut scene = two_blocks();
    let hold = Hold::All(Vector2::x());
    assert!(scene.hold_places("none", &[], hold, Constant(0.0)).is_err());
    let wrong = [vector![0.0, f64::NAN]];
    assert!(
        scene
            .hold_places("wrong", &wrong, hold, Constant(0.0))
            .is_err()
    );
}
