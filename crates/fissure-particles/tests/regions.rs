//! Regions: membership, bounds, what is made of them, and numbers that make none.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use fissure_particles::{
    Ball, Block, Compose, Cylinder, HalfSpace, Polygon, Region, RegionError, Rotated, Where,
};
use nalgebra::{SVector, Vector2, Vector3};
use proptest::prelude::*;

/// Every sampled point of the region lies in its bounds, and some do lie in it.
fn within_bounds<const D: usize>(region: &dyn Region<D>, reach: f64) {
    let (min, max) = region.bounds();
    let (per_axis, mut inside) = (24_usize, 0);
    for sample in 0..per_axis.pow(D as u32) {
        let mut rest = sample;
        let x = SVector::<f64, D>::from_fn(|_, _| {
            let place = (rest % per_axis) as f64 / per_axis as f64;
            rest /= per_axis;
            reach * (2.0 * place - 1.0)
        });
        if region.contains(&x) {
            inside += 1;
            assert!((0..D).all(|i| min[i] <= x[i] && x[i] <= max[i]), "{x}");
        }
    }
    assert!(inside > 0);
}

#[test]
fn blocks_are_half_open() {
    let block = Block::new([0.0, 1.0], [2.0, 3.0]);
    assert!(block.contains(&Vector2::new(0.0, 1.0)));
    assert!(!block.contains(&Vector2::new(2.0, 1.5)));
    assert!(!block.contains(&Vector2::new(1.0, 3.0)));
    assert!(!block.contains(&Vector2::new(f64::NAN, 1.5)));
}

#[test]
fn booleans_are_those_of_membership() {
    let (a, b) = (
        Block::new([0.0, 0.0], [2.0, 2.0]),
        Ball::new([2.0, 2.0], 1.0),
    );
    for i in 0..40 {
        for j in 0..40 {
            let x = Vector2::new(0.1 * f64::from(i), 0.1 * f64::from(j));
            let (in_a, in_b) = (a.contains(&x), b.contains(&x));
            assert_eq!(a.plus(b).contains(&x), in_a || in_b);
            assert_eq!(a.minus(b).contains(&x), in_a && !in_b);
            assert_eq!(a.within(b).contains(&x), in_a && in_b);
        }
    }
    let bounds = |min, max| (Vector2::repeat(min), Vector2::repeat(max));
    assert_eq!(a.plus(b).bounds(), bounds(0.0, 3.0));
    assert_eq!(a.minus(b).bounds(), bounds(0.0, 2.0));
    assert_eq!(a.within(b).bounds(), bounds(1.0, 2.0));
}

#[test]
fn a_quarter_turn_moves_a_block_where_it_should() {
    let block = Block::new([1.0, 0.0], [3.0, 1.0]).rotated(FRAC_PI_2, [1.0, 0.0]);
    assert!(block.contains(&Vector2::new(0.5, 1.9)));
    assert!(!block.contains(&Vector2::new(1.5, 0.5)));
    let (min, max) = block.bounds();
    assert!((min - Vector2::new(0.0, 0.0)).norm() < 1e-15);
    assert!((max - Vector2::new(1.0, 2.0)).norm() < 1e-15);

    let beam = Block::new([0.0, 0.0, 0.0], [4.0, 1.0, 1.0]).rotated_about(
        FRAC_PI_2,
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 7.0],
    );
    assert!(beam.contains(&Vector3::new(-0.5, 3.5, 0.5)));
    assert!(!beam.contains(&Vector3::new(3.5, 0.5, 0.5)));
}

#[test]
fn a_shift_moves_points_and_bounds_alike() {
    let ball = Ball::new([0.0, 0.0, 0.0], 1.0).translated([5.0, 0.0, 0.0]);
    assert!(ball.contains(&Vector3::new(5.5, 0.0, 0.0)));
    assert!(!ball.contains(&Vector3::zeros()));
    assert_eq!(ball.bounds().1, Vector3::new(6.0, 1.0, 1.0));
}

#[test]
fn bounds_hold_every_point() {
    let tilted = Cylinder::new([-0.3, -0.2, -0.5], [0.4, 0.6, 0.2], 0.3);
    within_bounds::<3>(&tilted, 1.5);
    within_bounds::<3>(
        &tilted.rotated_about(0.7, [0.1, 0.2, 0.3], [1.0, 2.0, -1.0]),
        1.5,
    );
    within_bounds::<2>(&Polygon::new([[0.0, 0.0], [1.0, 0.2], [0.3, 0.9]]), 1.5);
    within_bounds::<2>(&Ball::new([0.1, 0.2], 0.5), 1.5);
    within_bounds::<2>(
        &Block::new([0.0, 0.0], [1.0, 0.3]).rotated(0.4, [0.2, 0.9]),
        1.5,
    );
    let cut = Ball::new([0.0, 0.0], 1.0).within(HalfSpace::new([0.0, 0.0], [1.0, 1.0]));
    within_bounds::<2>(&cut, 1.5);
    assert!(!cut.contains(&Vector2::new(0.3, 0.3)));
    assert!(cut.contains(&Vector2::new(-0.3, -0.3)));
}

#[test]
fn a_cylinder_along_an_axis_has_tight_bounds_and_half_open_ends() {
    let cylinder = Cylinder::new([0.0, 0.0, 1.0], [0.0, 0.0, 3.0], 0.5);
    let (min, max) = cylinder.bounds();
    assert!((min - Vector3::new(-0.5, -0.5, 1.0)).norm() < 1e-15);
    assert!((max - Vector3::new(0.5, 0.5, 3.0)).norm() < 1e-15);
    assert!(cylinder.contains(&Vector3::new(0.0, 0.0, 1.0)));
    assert!(!cylinder.contains(&Vector3::new(0.0, 0.0, 3.0)));
    assert!(!cylinder.contains(&Vector3::new(0.4, 0.4, 2.0)));
}

#[test]
fn half_spaces_turned_have_no_end() {
    let half = HalfSpace::new([1.0, 0.0], [1.0, 0.0]).rotated(FRAC_PI_4, [0.0, 0.0]);
    assert_eq!(half.bounds().0, Vector2::repeat(f64::NEG_INFINITY));
    assert!(half.contains(&Vector2::new(0.7, 0.7)));
    assert!(!half.contains(&Vector2::new(0.72, 0.72)));
}

#[test]
fn a_polygon_does_not_mind_its_winding_nor_a_notch() {
    let notched = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [2.0, 1.0], [0.0, 3.0]];
    let forth = Polygon::new(notched);
    let back = Polygon::new(notched.into_iter().rev());
    assert_eq!((forth.signed_area(), back.signed_area()), (8.0, -8.0));
    for i in -5..50 {
        for j in -5..40 {
            let x = Vector2::new(0.1 * f64::from(i), 0.1 * f64::from(j));
            assert_eq!(forth.contains(&x), back.contains(&x));
        }
    }
    assert!(forth.contains(&Vector2::new(0.5, 2.0)));
    assert!(!forth.contains(&Vector2::new(2.0, 2.0)));
}

#[test]
fn numbers_that_make_no_region_are_refused() {
    let nan = f64::NAN;
    assert!(Block::new([0.0, 1.0], [1.0, 1.0]).check().is_err());
    assert!(Block::new([0.0, nan], [1.0, 1.0]).check().is_err());
    assert!(matches!(
        Block::new([0.0, 0.0], [1.0, nan]).check(),
        Err(RegionError::Extent { axis: 1, .. })
    ));
    for radius in [nan, 0.0, -1.0, f64::INFINITY] {
        let ball = Ball::new([0.0, 0.0], radius);
        assert!(ball.check().is_err());
        let plate = Block::new([-1.0, -1.0], [1.0, 1.0]);
        assert!(plate.minus(ball).check().is_err(), "a hole counts as well");
        assert!(ball.plus(plate).check().is_err());
        assert!(plate.within(ball).rotated(0.1, [0.0, 0.0]).check().is_err());
        assert!(
            Cylinder::new([0.0; 3], [0.0, 0.0, 1.0], radius)
                .check()
                .is_err()
        );
    }
    assert!(!Ball::new([0.0, 0.0], -1.0).contains(&Vector2::new(0.5, 0.0)));
    assert!(Cylinder::new([1.0; 3], [1.0; 3], 1.0).check().is_err());
    assert!(HalfSpace::new([0.0, 0.0], [0.0, 0.0]).check().is_err());
    let two = Polygon::new([[0.0, 0.0], [1.0, 0.0]]);
    assert_eq!(two.check(), Err(RegionError::TooFewVertices { count: 2 }));
    assert!(
        Polygon::new([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]])
            .check()
            .is_err()
    );
    assert!(
        Polygon::new([[0.0, 0.0], [1.0, nan], [2.0, 0.0]])
            .check()
            .is_err()
    );
    let ball = Ball::new([0.0, 0.0], 1.0);
    assert!(ball.rotated(nan, [0.0, 0.0]).check().is_err());
    assert!(ball.translated([nan, 0.0]).check().is_err());
    let ball = Ball::new([0.0, 0.0, 0.0], 1.0);
    assert!(
        Rotated::about_axis(ball, 1.0, [0.0; 3], [0.0; 3])
            .check()
            .is_err()
    );
    assert!(Where::new([0.0], [nan], |_| true).check().is_err());
}

#[test]
fn bounds_do_not_hide_what_is_no_number() {
    let nan = Ball::new([0.0, 0.0], f64::NAN);
    let block = Block::new([0.0, 0.0], [1.0, 1.0]);
    for bounds in [nan.plus(block).bounds(), block.plus(nan).bounds()] {
        assert!(bounds.0.iter().chain(&bounds.1).all(|v| v.is_nan()));
    }
    let vertices = [[0.0, 0.0], [f64::NAN, 1.0], [2.0, 0.0]];
    assert!(Polygon::new(vertices).bounds().0.x.is_nan());
}

proptest! {
    #[test]
    fn polygons_sharing_an_edge_share_no_point_and_leave_none(
        ends in prop::array::uniform2(-0.9_f64..0.9),
        steps in prop::collection::vec(0.0_f64..=1.0, 60),
    ) {
        let [low, high] = ends;
        let left = Polygon::new([[-1.0, -1.0], [low, -1.0], [high, 1.0], [-1.0, 1.0]]);
        let right = Polygon::new([[low, -1.0], [1.0, -1.0], [1.0, 1.0], [high, 1.0]]);
        for t in steps {
            let edge = Vector2::new(low + (high - low) * t, 2.0 * t - 1.0);
            let count = [&left, &right].into_iter().filter(|p| p.contains(&edge)).count();
            prop_assert_eq!(count, usize::from(edge.y < 1.0));
        }
    }

    #[test]
    fn turning_back_restores_membership(angle in -PI..PI, x in -1.0_f64..2.0, y in -1.0_f64..2.0) {
        let block = Block::new([0.0, 0.0], [1.0, 0.5]);
        let point = Vector2::new(x, y);
        let to_the_edge = [x, 1.0 - x, y, 0.5 - y].into_iter().fold(f64::INFINITY, |d, v| d.min(v.abs()));
        prop_assume!(to_the_edge > 1e-9);
        let twice = block.rotated(angle, [0.3, 0.4]).rotated(-angle, [0.3, 0.4]);
        prop_assert_eq!(twice.contains(&point), block.contains(&point));
    }
}
