//! X13: no body, no particle, one cell.

use fissure::nalgebra::Matrix2;
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

fn solver(shape: ShapeKind) -> Box<dyn Solver<2>> {
    let grid = Grid::over([0.0; 2], [1.0; 2], 1.0).unwrap();
    assert_eq!(grid.cells(), [1, 1]);
    Table::solver(shape, grid, ExplicitSettings::default()).unwrap()
}

#[test]
fn x13_a_scene_without_particles_is_a_typed_error() {
    let mut none: Scene<2> = Table::scene(Space::Plane);
    let error = solver(ShapeKind::Linear).step(&mut none, 1.0).unwrap_err();
    assert!(matches!(error, SolveError::Empty), "{error:?}");

    let mut hollow: Scene<2> = Table::scene(Space::Plane);
    let seeds = Seeds {
        position: Vec::new(),
        volume: Vec::new(),
        half_edges: Matrix2::identity(),
    };
    hollow.add_body("hollow", rubber(), seeds).unwrap();
    let error = solver(ShapeKind::Linear)
        .step(&mut hollow, 1.0)
        .unwrap_err();
    assert!(matches!(error, SolveError::Empty), "{error:?}");
    assert!(hollow.save().is_ok() && hollow.energy().kinetic == 0.0);
}

#[test]
fn x13_an_empty_region_is_a_typed_error() {
    let mut scene: Scene<2> = Table::scene(Space::Plane);
    let nowhere = Where::new([0.0; 2], [1.0; 2], |_| false);
    let error = scene.fill("b", rubber(), &nowhere, &Spacing(0.5)).err();
    let Some(SceneError::Seed {
        source: SeedError::NoParticles { .. },
        ..
    }) = error
    else {
        panic!("{error:?}");
    };
    assert!(scene.bodies().is_empty());
}

#[test]
fn x13_one_cell_holds_a_body_that_moves() {
    for shape in ShapeKind::ALL {
        let mut scene: Scene<2> = Table::scene(Space::Plane);
        scene
            .fill(
                "block",
                rubber(),
                &Block::new([0.25; 2], [0.75; 2]),
                &Spacing(0.25),
            )
            .unwrap()
            .set_velocity("block", |_| Vector2::new(0.5, -0.25))
            .unwrap();
        let mut solver = solver(shape);
        run(&mut scene, &mut *solver, Until::Steps(20), &mut []).unwrap();
        for v in scene.bodies()[0].motion().velocity {
            let error = (v - Vector2::new(0.5, -0.25)).norm();
            assert!(error <= 1e-12, "{shape:?}: {error:e}");
        }
    }
}
