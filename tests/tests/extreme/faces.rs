//! X7: particles exactly on faces, edges and corners of cells belong to one cell each, so that
//! mass and motion are those of particles elsewhere; on the grid's own faces too.

use fissure::prelude::*;
use fissure_tests::{Build, Case, ShapeKind, Space, Table, cases, momentum, rubber};

const H: f64 = 0.125;

fn on_nodes(shapes: &[ShapeKind]) {
    let chosen = |case: &Case| shapes.contains(&case.shape);
    for case in cases(Space::Plane).into_iter().filter(chosen) {
        let mut scene: Scene<2> = Table::scene(Space::Plane);
        // Lattice points at multiples of h/2: on nodes, on edges and in the middle of cells.
        let block = Block::new([-0.25 * H; 2], [4.25 * H; 2]);
        scene
            .fill("block", rubber(), &block, &Spacing(H / 2.0))
            .unwrap()
            .set_velocity("block", |_| Vector2::new(20.0, 10.0))
            .unwrap();
        let on_nodes = scene.bodies()[0].motion().position.iter();
        assert_eq!(
            on_nodes
                .filter(|x| x.iter().all(|c| (c / H).fract() == 0.0))
                .count(),
            25
        );
        let before = momentum(&scene);
        let grid = Grid::over([0.0; 2], [8.0 * H; 2], H).unwrap();
        let mut solver = Table::row(&case, grid, 0.4).unwrap();
        run(&mut scene, &mut *solver, Until::Steps(8), &mut []).unwrap();
        let error = (momentum(&scene) - before).norm() / before.norm();
        assert!(error <= 1e-14, "{case:?}: {error:e}");
        let motion = scene.bodies()[0].motion();
        for (f, v) in motion.deformation_gradient.iter().zip(motion.velocity) {
            let strain = (f - Matrix3::identity()).norm();
            assert!(strain <= 1e-12, "{case:?}: strain {strain:e}");
            let error = (v - Vector2::new(20.0, 10.0)).norm();
            assert!(error <= 1e-11, "{case:?}: {error:e}");
        }
    }
}

#[test]
fn x7_particles_on_nodes_are_moved_as_one_body() {
    on_nodes(&ShapeKind::ALL[1..]);
}

/// A particle on a face with nothing beyond reaches a node without mass: N is 0 there and ∇N is
/// not.
#[test]
fn x7_particles_on_nodes_are_moved_as_one_body_by_linear_functions() {
    on_nodes(&ShapeKind::ALL[..1]);
}

#[test]
fn x7_a_body_that_leaves_the_grid_says_so() {
    for shape in ShapeKind::ALL {
        let mut scene: Scene<2> = Table::scene(Space::Plane);
        scene
            .fill(
                "block",
                rubber(),
                &Block::new([0.0; 2], [2.0 * H; 2]),
                &Spacing(H / 2.0),
            )
            .unwrap()
            .set_velocity("block", |_| Vector2::new(20.0, 0.0))
            .unwrap();
        let grid = Grid::over([-H; 2], [4.0 * H; 2], H).unwrap();
        let settings = ExplicitSettings::default();
        let mut solver = Table::solver(shape, grid, settings).unwrap();
        let error = run(&mut scene, &mut *solver, Until::Steps(1000), &mut []).unwrap_err();
        let SolveError::Outside { position, step, .. } = &error else {
            panic!("{shape:?}: {error:?}");
        };
        // Where it still was: within a step of the face.
        assert!(
            position[0] <= 4.0 * H && position[0] > 3.5 * H,
            "{shape:?}: {position:?}"
        );
        assert_eq!(*step, scene.step() + 1);
    }
}
