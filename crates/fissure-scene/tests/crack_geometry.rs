//! Geometry of cracks: exact cases and properties.

use fissure_scene::{CrackError, Polyline, Side};
use nalgebra::{Rotation2, Vector2};
use proptest::prelude::*;

type Point = Vector2<f64>;

fn point(x: f64, y: f64) -> Point {
    Vector2::new(x, y)
}

fn line(points: &[[f64; 2]]) -> Polyline {
    Polyline::new(points.iter().map(|p| point(p[0], p[1])).collect()).expect("a simple line")
}

fn opposite(side: Side) -> Side {
    match side {
        Side::Plus => Side::Minus,
        Side::Minus => Side::Plus,
    }
}

/// A crack whose abscissa grows from vertex to vertex: always simple.
fn growing_line() -> impl Strategy<Value = Polyline> {
    prop::collection::vec((0.1..2.0f64, -2.0..2.0f64), 2..8).prop_map(|steps| {
        let mut x = -3.0;
        let place = |(step, y)| {
            x += step;
            point(x, y)
        };
        Polyline::new(steps.into_iter().map(place).collect()).expect("a simple line")
    })
}

fn any_point(reach: f64) -> impl Strategy<Value = Point> {
    (-reach..reach, -reach..reach).prop_map(|(x, y)| point(x, y))
}

/// The same line with further vertices on its segments.
fn subdivided(line: &Polyline, parts: usize) -> Polyline {
    let pairs = line.points().windows(2);
    let inner = pairs.flat_map(|pair| {
        let way = pair[1] - pair[0];
        (0..parts).map(move |k| pair[0] + way * (k as f64 / parts as f64))
    });
    let mut points: Vec<Point> = inner.collect();
    points.extend(line.points().last());
    Polyline::new(points).expect("a simple line")
}

proptest! {
    #[test]
    fn sides_and_crossings_turn_with_the_plane_and_swap_in_a_mirror(
        line in growing_line(), a in any_point(6.0), b in any_point(6.0),
        angle in -3.2..3.2f64, shift in any_point(10.0),
    ) {
        // Far enough from where rounding of the motion may change the answer.
        let near = |x: &Point| line.foot(x).distance > 1e-9;
        prop_assume!(near(&a) && near(&b));
        let turn = Rotation2::new(angle);
        let moved = line.carried(|(_, p)| turn * p + shift).unwrap();
        let (to_a, to_b) = (turn * a + shift, turn * b + shift);
        prop_assert_eq!(moved.side(&to_a), line.side(&a));
        prop_assert_eq!(moved.crossing(&to_a, &to_b), line.crossing(&a, &b));
        prop_assert!((moved.length() - line.length()).abs() < 1e-12 * (1.0 + line.length()));

        let mirror = |p: &Point| point(p.x, -p.y);
        let mirrored = line.carried(|(_, p)| mirror(p)).unwrap();
        prop_assert_eq!(mirrored.side(&mirror(&a)), opposite(line.side(&a)));
        let crossed = line.crossing(&a, &b).map(opposite);
        prop_assert_eq!(mirrored.crossing(&mirror(&a), &mirror(&b)), crossed);

        // The same crack drawn from its other end has its sides swapped.
        let mut points = line.points().to_vec();
        points.reverse();
        let back = Polyline::new(points).unwrap();
        prop_assert_eq!(back.side(&a), opposite(line.side(&a)));
        prop_assert_eq!(back.crossing(&a, &b), line.crossing(&a, &b).map(opposite));
    }

    #[test]
    fn more_vertices_change_nothing(
        line in growing_line(), parts in 2usize..5, a in any_point(6.0), b in any_point(6.0),
        half in (0.05..1.5f64, 0.05..1.5f64),
    ) {
        let fine = subdivided(&line, parts);
        let foot = line.foot(&a);
        prop_assume!(foot.distance > 1e-9 && line.foot(&b).distance > 1e-9);
        prop_assert_eq!(fine.side(&a), line.side(&a));
        prop_assert_eq!(fine.crossing(&a, &b), line.crossing(&a, &b));
        // Boxes that only just touch may be told apart by the rounding of the new vertices.
        let half = point(half.0, half.1);
        let surely = line.meets_box(&a, &(half * (1.0 - 1e-9)));
        prop_assert!(fine.meets_box(&a, &(half * (1.0 + 1e-9))) || !surely);
        let other = fine.foot(&a);
        prop_assert!((other.arc - foot.arc).abs() < 1e-9 || (other.distance - foot.distance).abs() < 1e-12);
        prop_assert!((other.distance - foot.distance).abs() < 1e-12);
    }

    #[test]
    fn a_way_back_crosses_to_the_other_side(line in growing_line(), a in any_point(4.0), b in any_point(4.0)) {
        prop_assert_eq!(line.crossing(&b, &a), line.crossing(&a, &b).map(opposite));
    }

    /// On a lattice, where ways run through vertices and points lie on the crack all the time: a
    /// crack through everything is crossed if and only if the two sides differ.
    #[test]
    fn crossings_and_sides_agree_on_a_lattice(
        heights in prop::collection::vec(-2i32..3, 6), a in (-5i32..6, -5i32..6), b in (-5i32..6, -5i32..6),
    ) {
        let inner = heights.iter().enumerate().map(|(i, y)| [2.0 * i as f64 - 5.0, f64::from(*y)]);
        let ends = [[-50.0, f64::from(heights[0])], [50.0, f64::from(heights[5])]];
        let points: Vec<[f64; 2]> = std::iter::once(ends[0]).chain(inner).chain([ends[1]]).collect();
        let line = line(&points);
        let (a, b) = (point(f64::from(a.0), f64::from(a.1)), point(f64::from(b.0), f64::from(b.1)));
        let (from, to) = (line.side(&a), line.side(&b));
        prop_assert_eq!(line.crossing(&a, &b), (from != to).then_some(to));
    }

    #[test]
    fn boxes_that_a_crack_meets(line in growing_line(), centre in any_point(4.0), half in (0.05..1.0f64, 0.05..1.0f64)) {
        let half = point(half.0, half.1);
        let length = line.length();
        let step = 2e-3;
        let inside = |x: Point, more: f64| {
            let from = (x - centre).abs();
            from.x < half.x + more && from.y < half.y + more
        };
        let mut samples = (0..=(length / step) as usize).map(|k| line.at(k as f64 * step).0);
        if line.meets_box(&centre, &half) {
            prop_assert!(samples.any(|x| inside(x, step)));
        } else {
            prop_assert!(!samples.any(|x| inside(x, -1e-12)));
        }
    }

    #[test]
    fn points_of_the_line_are_their_own_feet(line in growing_line(), share in 0.0..1.0f64, off in -1e-3..1e-3f64) {
        let arc = share * line.length();
        let (x, tangent) = line.at(arc);
        let foot = line.foot(&x);
        prop_assert!(foot.distance < 1e-12 && (foot.arc - arc).abs() < 1e-12);
        prop_assert!((foot.normal.norm() - 1.0).abs() < 1e-14);
        // Off the line along a normal, away from vertices: the side is that of the normal.
        let normal = point(-tangent.y, tangent.x);
        let to_vertex = line.points().iter().map(|p| (p - x).norm()).fold(f64::INFINITY, f64::min);
        if off.abs() > 1e-12 && to_vertex > 0.2 {
            let side = if off > 0.0 { Side::Plus } else { Side::Minus };
            prop_assert_eq!(line.side(&(x + normal * off)), side);
        }
    }

    /// Simple or not, by all pairs of segments of a walk on a lattice.
    #[test]
    fn lines_that_meet_themselves_are_refused(walk in prop::collection::vec((-2i32..3, -2i32..3), 3..7)) {
        let points: Vec<Point> = walk.iter().map(|(x, y)| point(f64::from(*x), f64::from(*y))).collect();
        let segments: Vec<[Point; 2]> = points.windows(2).map(|p| [p[0], p[1]]).collect();
        // A fine walk along one segment comes to within less than rounding of every meeting.
        let distance = |x: Point, [a, b]: [Point; 2]| {
            let way = b - a;
            let t = ((x - a).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
            (x - a - way * t).norm()
        };
        let mut simple = segments.iter().all(|[a, b]| a != b);
        for i in 0..segments.len() {
            for j in (i + 1)..segments.len() {
                if !simple { continue; }
                // Meetings of lattice segments lie at multiples of 1/k, k ≤ 32, of their length.
                let meets = (1..=32u32).flat_map(|k| (0..=k).map(move |n| f64::from(n) / f64::from(k))).any(|t| {
                    let x = segments[i][0] + (segments[i][1] - segments[i][0]) * t;
                    let shared = j == i + 1 && (x - segments[i][1]).norm() < 1e-9;
                    !shared && distance(x, segments[j]) < 1e-9
                });
                // Adjacent ones may also fold back beyond the start of the first.
                let start = j == i + 1 && distance(segments[i][0], segments[j]) < 1e-9;
                simple &= !(meets || start);
            }
        }
        prop_assert_eq!(Polyline::new(points).is_ok(), simple);
    }
}

#[test]
fn sides_at_kinks_and_past_the_ends() {
    let hook = line(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]); // turns left
    for (x, y, side) in [
        (0.5, 0.1, Side::Plus),
        (0.9, 0.9, Side::Plus),
        (1.1, -0.1, Side::Minus),  // beyond the kink, outside
        (1.05, -5.0, Side::Minus), // below the line of the first segment
        (-9.0, 0.1, Side::Plus),   // past the first end
        (-9.0, -0.1, Side::Minus),
        (0.9, 9.0, Side::Plus), // past the last
        (1.1, 9.0, Side::Minus),
        (0.3, 0.0, Side::Plus), // on the crack
        (1.0, 0.0, Side::Plus), // its vertex
        (7.0, 0.0, Side::Minus),
    ] {
        assert_eq!(hook.side(&point(x, y)), side, "({x}, {y})");
    }
    let foot = hook.foot(&point(2.0, -1.0));
    assert!((foot.normal - point(-1.0, 1.0).normalize()).norm() < 1e-15);
    assert_eq!((foot.point, foot.arc), (point(1.0, 0.0), 1.0));
}

/// The last bit of a coordinate decides, 1e21 times smaller than the crack is long.
#[test]
fn sides_are_exact() {
    let slant = line(&[[0.0, 0.0], [1e5, 1e5]]);
    let up = f64::from_bits(0.3f64.to_bits() + 1);
    assert_eq!(slant.side(&point(0.3, up)), Side::Plus);
    assert_eq!(slant.side(&point(up, 0.3)), Side::Minus);
    assert_eq!(
        slant.crossing(&point(0.3, up), &point(up, 0.3)),
        Some(Side::Minus)
    );
}

#[test]
fn ways_through_vertices_and_ends() {
    let roof = line(&[[-1.0, -1.0], [0.0, 0.0], [1.0, -1.0]]);
    // Touching the peak is no crossing, through it is one.
    assert_eq!(roof.crossing(&point(-1.0, 0.0), &point(1.0, 0.0)), None);
    assert_eq!(
        roof.crossing(&point(0.0, 1.0), &point(0.0, -1.0)),
        Some(Side::Minus)
    );
    // In at one side of the roof and out at the other.
    assert_eq!(roof.crossing(&point(-2.0, -0.5), &point(2.0, -0.5)), None);
    assert_eq!(
        roof.crossing(&point(-2.0, -0.5), &point(0.0, -0.5)),
        Some(Side::Minus)
    );
    // A way through an end has one answer, whichever way it goes.
    let [there, back] = [[0.0, -2.0], [-2.0, 0.0]].map(|p| point(p[0], p[1]));
    let crossing = roof.crossing(&there, &back);
    assert_eq!(roof.crossing(&back, &there), crossing.map(opposite));
}

#[test]
fn a_box_is_open() {
    let flat = line(&[[0.0, 0.0], [1.0, 0.0]]);
    let half = point(0.5, 0.5);
    for (x, y, meets) in [
        (0.5, 0.5, false), // only touches
        (0.5, 0.499_999, true),
        (1.5, 0.0, false),
        (1.499_999, 0.0, true),
        (1.2, 0.4, true),
        (1.6, 0.0, false),
    ] {
        assert_eq!(flat.meets_box(&point(x, y), &half), meets, "({x}, {y})");
    }
    // Within the bounds of a slanting segment but beside it.
    let slant = line(&[[0.0, 0.0], [1.0, 1.0]]);
    assert!(!slant.meets_box(&point(0.8, 0.2), &point(0.2, 0.2)));
    assert!(slant.meets_box(&point(0.8, 0.2), &point(0.4, 0.4)));
}

#[test]
fn lines_that_are_none_are_refused() {
    let refused = |points: &[[f64; 2]]| {
        Polyline::new(points.iter().map(|p| point(p[0], p[1])).collect()).unwrap_err()
    };
    assert_eq!(refused(&[[0.0, 0.0]]), CrackError::TooShort { vertices: 1 });
    assert_eq!(
        refused(&[[0.0, 0.0], [f64::NAN, 0.0]]),
        CrackError::NotFinite { vertex: 1 }
    );
    assert_eq!(
        refused(&[[0.0, 0.0], [0.0, 0.0]]),
        CrackError::NoLength { segment: 0 }
    );
    let folded = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]];
    assert_eq!(
        refused(&folded),
        CrackError::NotSimple {
            first: 0,
            second: 1
        }
    );
    let looped = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, -1.0]];
    assert_eq!(
        refused(&looped),
        CrackError::NotSimple {
            first: 0,
            second: 2
        }
    );
    let closed = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]];
    assert_eq!(
        refused(&closed),
        CrackError::NotSimple {
            first: 0,
            second: 2
        }
    );
}
