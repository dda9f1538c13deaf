//! X10: a grid at 1e8 m with cells of 1 mm is refused, since ε·1e8 m = 1.5e-8 m.

use fissure::grid::GridError;
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

#[test]
fn x10_cells_of_a_millimetre_at_1e8_metres_are_refused() {
    let refused = Grid::over([1e8, 0.0], [1e8 + 0.1, 0.1], 1e-3);
    let Err(GridError::TooFar {
        axis,
        coordinate,
        spacing,
        limit,
    }) = refused
    else {
        panic!("{refused:?}");
    };
    assert_eq!((axis, spacing), (0, 1e-3));
    assert!(coordinate > limit && limit >= 1e3, "{limit}");
}

#[test]
fn x10_what_the_grid_accepts_it_can_still_move() {
    // Close to the limit of h·1e-9/ε = 4504 m.
    let (far, h) = (4096.0, 1.0 / 1024.0);
    let mut scene: Scene<2> = Table::scene(Space::Plane);
    scene
        .fill(
            "block",
            rubber(),
            &Block::new([far; 2], [far + 4.0 * h; 2]),
            &Spacing(h / 2.0),
        )
        .unwrap()
        .set_velocity("block", |_| Vector2::new(10.0, 0.0))
        .unwrap();
    let grid = Grid::over([far - 4.0 * h; 2], [far + 16.0 * h; 2], h).unwrap();
    let settings = ExplicitSettings::default();
    let mut solver = Table::solver(ShapeKind::Bspline2, grid, settings).unwrap();
    run(&mut scene, &mut *solver, Until::Steps(100), &mut []).unwrap();
    for f in scene.bodies()[0].motion().deformation_gradient {
        let strain = (f - Matrix3::identity()).norm();
        // A hundred steps of round-off of the positions, 1e-9 of a cell each.
        assert!(strain <= 1e-7, "{strain:e}");
    }
}
