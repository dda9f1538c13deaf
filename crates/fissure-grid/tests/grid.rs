//! The grid: refusals, and one owner for every point.

use fissure_grid::{Grid, GridError, tile_of};
use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;

#[test]
fn covers_the_box_asked_for() {
    let grid = Grid::over([-0.02, -0.02], [0.22, 0.08], 5e-3).unwrap();
    assert_eq!(grid.cells(), [48, 20]);
    assert_eq!(grid.origin(), Vector2::new(-0.02, -0.02));
    assert!(grid.max().x >= 0.22 && grid.max().y >= 0.08);
    assert_eq!(grid.cell(&Vector2::new(0.22, 0.08)), Some([47, 19]));
    assert_eq!(Grid::over([0.0], [1.01], 0.5).unwrap().cells(), [3]);
    assert_eq!(Grid::over([0.0], [1e-30], 0.5).unwrap().cells(), [1]);
}

#[test]
fn refuses_what_it_cannot_be() {
    let over = |min, max, h| Grid::over([0.0, min], [1.0, max], h).unwrap_err();
    for spacing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(over(0.0, 1.0, spacing), GridError::Spacing { .. }));
    }
    assert!(matches!(
        over(f64::NAN, 1.0, 0.1),
        GridError::NotFinite { axis: 1, .. }
    ));
    assert!(matches!(
        over(0.0, f64::INFINITY, 0.1),
        GridError::NotFinite { axis: 1, .. }
    ));
    assert!(matches!(
        over(1.0, 1.0, 0.1),
        GridError::Empty { axis: 1, .. }
    ));
    assert!(matches!(
        over(1.0, 0.0, 0.1),
        GridError::Empty { axis: 1, .. }
    ));
    assert!(matches!(
        over(-f64::MAX, f64::MAX, 0.1),
        GridError::TooFar { axis: 1, .. }
    ));
    assert_eq!(
        Grid::over([0.0], [2e6], 1.0).unwrap_err(),
        GridError::TooManyCells {
            axis: 0,
            cells: 2e6,
            limit: 1 << 20
        }
    );
    assert!(Grid::over([0.0], [f64::from(1 << 20)], 1.0).is_ok());
}

/// A box 1e8 m away with millimetre cells cannot resolve them.
#[test]
fn refuses_a_far_offset() {
    let error = Grid::over([1e8, 0.0], [1e8 + 1.0, 1.0], 1e-3).unwrap_err();
    assert!(matches!(error, GridError::TooFar { axis: 0, .. }));
    let message = error.to_string();
    assert!(
        message.contains("100000001") && message.contains("local coordinates"),
        "{message}"
    );
    assert!(Grid::over([1e3, 0.0], [1e3 + 1.0, 1.0], 1e-3).is_ok());
}

#[test]
fn faces_and_corners_have_one_owner() {
    let grid = Grid::over([0.0; 3], [1.0, 2.0, 3.0], 0.25).unwrap();
    let point = Vector3::new;
    assert_eq!(grid.cell(&point(0.0, 0.0, 0.0)), Some([0, 0, 0]));
    assert_eq!(grid.cell(&point(0.25, 0.25, 0.25)), Some([1, 1, 1]));
    assert_eq!(
        grid.cell(&point(0.25_f64.next_down(), 0.25, 0.3)),
        Some([0, 1, 1])
    );
    assert_eq!(grid.cell(&point(1.0, 2.0, 3.0)), Some([3, 7, 11]));
    assert_eq!(
        grid.locate(&point(1.0, 0.125, 0.0)).unwrap().1,
        point(1.0, 0.5, 0.0)
    );
    // On a dyadic grid every node is owned by the cell above it.
    for index in [[0, 0, 0], [1, 5, 7], [3, 7, 11]] {
        assert_eq!(
            grid.locate(&grid.node(index)),
            Some((index, Vector3::zeros()))
        );
    }
}

#[test]
fn outside_has_no_owner() {
    let grid = Grid::over([0.0; 2], [1.0; 2], 0.25).unwrap();
    for bad in [
        -f64::MIN_POSITIVE,
        1.0_f64.next_up(),
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ] {
        assert_eq!(grid.cell(&Vector2::new(bad, 0.5)), None);
        assert_eq!(grid.locate(&Vector2::new(0.5, bad)), None);
    }
    let (cell, local) = grid.local(&Vector2::new(-1.0, 7.0));
    assert_eq!((cell, local), ([0, 3], Vector2::new(0.0, 1.0)));
}

#[test]
fn tiles_of_negative_nodes_lie_below() {
    assert_eq!(tile_of([-1, 0, 3], 4), [-1, 0, 0]);
    assert_eq!(tile_of([-4, -5, 4], 4), [-1, -2, 1]);
    assert_eq!(tile_of([-8, -9, 15], 8), [-1, -2, 1]);
}

proptest! {
    #[test]
    fn cell_and_coordinate_give_back_the_point(
        low in -10.0..10.0_f64, size in 0.1..10.0_f64, cells in 1.0..200.0_f64, at in 0.0..=1.0_f64,
    ) {
        let spacing = size / cells;
        let grid = Grid::over([low], [low + size], spacing).unwrap();
        let x = nalgebra::Vector1::new((low + at * size).min(low + size));
        let (cell, local) = grid.locate(&x).expect("inside");
        prop_assert!(cell[0] >= 0 && cell[0] < grid.cells()[0]);
        prop_assert!(local[0] >= 0.0 && local[0] <= 1.0);
        let back = grid.node(cell)[0] + local[0] * spacing;
        prop_assert!((back - x[0]).abs() <= 1e-9 * spacing);
        prop_assert_eq!(grid.cell(&x), Some(cell));
    }
}
