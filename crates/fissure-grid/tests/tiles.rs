//! Tiles: every window is covered, every node has one owner.

use std::collections::BTreeSet;

use fissure_grid::{ABSENT, Grid, TILE, Tiles, WINDOW, WINDOW_START, tile_of, window_map};
use nalgebra::Vector2;
use proptest::prelude::*;

/// Offset −1..=1 of a neighbour along each axis.
fn offset<const D: usize>(neighbour: usize) -> [i32; D] {
    std::array::from_fn(|axis| (neighbour / 3_usize.pow(axis as u32) % 3) as i32 - 1)
}

fn plus<const D: usize>(a: [i32; D], b: [i32; D]) -> [i32; D] {
    std::array::from_fn(|axis| a[axis] + b[axis])
}

fn check<const D: usize>(occupied: &[[i32; D]]) {
    let mut tiles = Tiles::new();
    tiles.rebuild([[7; D]].into_iter()); // leaves something to be forgotten
    tiles.rebuild(occupied.iter().copied());

    let expected: BTreeSet<[i32; D]> = occupied
        .iter()
        .flat_map(|&t| (0..Tiles::<D>::AROUND).map(move |n| plus(t, offset(n))))
        .collect();
    let held: BTreeSet<[i32; D]> = (0..tiles.len()).map(|t| tiles.coordinates(t)).collect();
    assert_eq!(held, expected);
    assert_eq!(tiles.len(), expected.len());
    assert_eq!(tiles.is_empty(), occupied.is_empty());

    let holders: BTreeSet<[i32; D]> = occupied.iter().copied().collect();
    let found: BTreeSet<[i32; D]> = tiles
        .occupied()
        .iter()
        .map(|&t| tiles.coordinates(t as usize))
        .collect();
    assert_eq!(found, holders);
    assert!(tiles.occupied().is_sorted_by(|a, b| a < b));

    for tile in 0..tiles.len() {
        let coordinates = tiles.coordinates(tile);
        assert_eq!(tiles.find(coordinates), Some(tile));
        assert_eq!(tiles.around(tile).len(), Tiles::<D>::AROUND);
        for (n, &number) in tiles.around(tile).iter().enumerate() {
            let there = plus(coordinates, offset(n));
            assert_eq!(
                tiles.find(there),
                (number != ABSENT).then_some(number as usize)
            );
            assert_eq!(number != ABSENT, expected.contains(&there));
            assert!(number != ABSENT || !holders.contains(&coordinates));
        }
    }

    let nodes: BTreeSet<[i32; D]> = (0..tiles.node_count())
        .map(|n| tiles.node_index(n))
        .collect();
    assert_eq!(nodes.len(), tiles.node_count());
    assert!(
        (0..tiles.node_count())
            .all(|n| tiles.find(tile_of(tiles.node_index(n))) == Some(n / Tiles::<D>::NODES))
    );

    let mut other = Tiles::new();
    other.rebuild(occupied.iter().rev().chain(occupied).copied());
    assert!((0..tiles.len()).all(|t| other.coordinates(t) == tiles.coordinates(t)));
    assert_eq!(other.occupied(), tiles.occupied());
}

proptest! {
    #[test]
    fn planes_are_consistent(occupied in prop::collection::vec([-9..9_i32, -9..9_i32], 0..40)) {
        check(&occupied);
    }

    #[test]
    fn solids_are_consistent(occupied in prop::collection::vec([-3..4_i32, -5..5_i32, 0..9_i32], 0..15)) {
        check(&occupied);
    }
}

#[test]
fn lines_are_consistent() {
    check(&[[3], [-4], [3]]);
}

#[test]
fn empty_rebuild_leaves_nothing() {
    let mut tiles = Tiles::<3>::new();
    assert!(tiles.is_empty() && tiles.find([0; 3]).is_none() && tiles.around(0).is_empty());
    tiles.rebuild([[1, 2, 3]].into_iter());
    assert_eq!((tiles.len(), tiles.node_count()), (27, 27 * 64));
    tiles.rebuild(std::iter::empty());
    assert!(tiles.is_empty() && tiles.occupied().is_empty() && tiles.node_count() == 0);
    assert_eq!(tiles.find([1, 2, 3]), None);
    assert!(tiles.around(0).is_empty());
}

#[test]
fn the_ends_of_the_index_range_are_met_without_panic() {
    let mut tiles = Tiles::<2>::new();
    tiles.rebuild([[i32::MAX, i32::MIN]].into_iter());
    assert_eq!(tiles.len(), 4);
    assert_eq!(
        tiles
            .around(tiles.occupied()[0] as usize)
            .iter()
            .filter(|&&t| t == ABSENT)
            .count(),
        5
    );
}

/// The curve visits the four tiles of a block before the next block.
#[test]
fn numbers_follow_the_curve() {
    let mut tiles = Tiles::<2>::new();
    tiles.rebuild([[1, 1], [2, 2]].into_iter());
    let first: Vec<_> = (0..7).map(|t| tiles.coordinates(t)).collect();
    assert_eq!(
        first,
        [[0, 0], [1, 0], [0, 1], [1, 1], [2, 0], [2, 1], [3, 1]]
    );
}

fn window_lands<const D: usize>() {
    let map = window_map::<D>();
    assert_eq!(map.len(), (WINDOW as usize).pow(D as u32));
    let digit = |n: usize, base: usize, axis: usize| (n / base.pow(axis as u32) % base) as i32;
    for (entry, &(neighbour, local)) in map.iter().enumerate() {
        for axis in 0..D {
            let there = TILE * offset::<D>(neighbour as usize)[axis]
                + digit(local as usize, TILE as usize, axis);
            assert_eq!(there, WINDOW_START + digit(entry, WINDOW as usize, axis));
        }
    }
}

#[test]
fn window_entries_land_on_their_nodes() {
    window_lands::<1>();
    window_lands::<2>();
    window_lands::<3>();
}

/// What owners gather from the windows round them is what the windows hold, each entry once.
#[test]
fn reversed_map_gathers_every_entry() {
    let map = window_map::<3>();
    let taken: usize = (0..27)
        .map(|n| {
            map.iter()
                .filter(|entry| entry.0 as usize == 26 - n)
                .count()
        })
        .sum();
    assert_eq!(taken, map.len());
}

#[test]
fn nodes_have_positions() {
    let grid = Grid::over([1.0, -1.0], [3.0, 1.0], 0.5).unwrap();
    let mut tiles = Tiles::new();
    tiles.rebuild([[0, 0]].into_iter());
    let centre = tiles.find([0, 0]).unwrap();
    assert_eq!(tiles.node_index(centre * 16 + 6), [2, 1]);
    assert_eq!(
        tiles.node_position(&grid, centre * 16 + 6),
        Vector2::new(2.0, -0.5)
    );
    let corner = tiles.find([-1, -1]).unwrap();
    assert_eq!(tiles.node_index(corner * 16 + 15), [-1, -1]);
}
