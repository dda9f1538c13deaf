//! Tiles: every window is covered, every node has one owner.

use std::collections::BTreeSet;

use fissure_grid::{ABSENT, Grid, TileSize, Tiles, WINDOW_START, Window, tile_of};
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
    check_of(TileSize::Narrow, occupied);
    check_of(TileSize::Wide, occupied);
}

fn check_of<const D: usize>(size: TileSize, occupied: &[[i32; D]]) {
    let mut tiles = Tiles::new();
    tiles.rebuild(TileSize::Wide, [[7; D]].into_iter()); // leaves something to be forgotten
    tiles.rebuild(size, occupied.iter().copied());
    let cells = if size == TileSize::Wide && D < 3 {
        8
    } else {
        4
    };
    assert_eq!((tiles.cells(), size.cells::<D>()), (cells, cells));
    assert_eq!(tiles.nodes_each(), (cells as usize).pow(D as u32));

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
        (0..tiles.node_count()).all(
            |n| tiles.find(tile_of(tiles.node_index(n), cells)) == Some(n / tiles.nodes_each())
        )
    );

    let mut other = Tiles::new();
    other.rebuild(size, occupied.iter().rev().chain(occupied).copied());
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
    tiles.rebuild(TileSize::Narrow, [[1, 2, 3]].into_iter());
    assert_eq!((tiles.len(), tiles.node_count()), (27, 27 * 64));
    tiles.rebuild(TileSize::Narrow, std::iter::empty());
    assert!(tiles.is_empty() && tiles.occupied().is_empty() && tiles.node_count() == 0);
    assert_eq!(tiles.find([1, 2, 3]), None);
    assert!(tiles.around(0).is_empty());
}

#[test]
fn the_ends_of_the_index_range_are_met_without_panic() {
    let mut tiles = Tiles::<2>::new();
    tiles.rebuild(TileSize::Wide, [[i32::MAX, i32::MIN]].into_iter());
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
    tiles.rebuild(TileSize::Narrow, [[1, 1], [2, 2]].into_iter());
    let first: Vec<_> = (0..7).map(|t| tiles.coordinates(t)).collect();
    assert_eq!(
        first,
        [[0, 0], [1, 0], [0, 1], [1, 1], [2, 0], [2, 1], [3, 1]]
    );
}

/// Every entry of a window is kept where its node is; numbers that are no entry are kept nowhere.
fn window_lands<const D: usize>(size: TileSize) {
    let mut tiles = Tiles::new();
    tiles.rebuild(size, [[1; D]].into_iter());
    let tile = tiles.find([1; D]).expect("held");
    let (window, around) = (tiles.window(tile), tiles.around(tile));
    let side = tiles.cells() - 2 * WINDOW_START;
    assert_eq!(window.nodes, side);
    assert_eq!(window.first, [tiles.cells() + WINDOW_START; D]);
    let mut nodes = BTreeSet::new();
    for (entry, &(neighbour, local)) in tiles.map().iter().enumerate() {
        let Some(&there) = around.get(neighbour as usize) else {
            assert!(window.entries().all(|other| other != entry));
            continue;
        };
        let node = there as usize * tiles.nodes_each() + local as usize;
        assert_eq!(tiles.node_index(node), window.node(entry));
        nodes.insert(window.node(entry));
    }
    assert_eq!(nodes.len(), (side as usize).pow(D as u32));
    assert_eq!(window.entries().count(), nodes.len());
    assert_eq!(window.entries().last(), Some(window.last()));
    assert!(window.last() < Window::<D>::ENTRIES && Window::<D>::ENTRIES < Window::<D>::ELEMENTS);
}

#[test]
fn window_entries_land_on_their_nodes() {
    for size in [TileSize::Narrow, TileSize::Wide] {
        window_lands::<1>(size);
        window_lands::<2>(size);
        window_lands::<3>(size);
    }
}

#[test]
fn nodes_have_positions() {
    let grid = Grid::over([1.0, -1.0], [3.0, 1.0], 0.5).unwrap();
    let mut tiles = Tiles::new();
    tiles.rebuild(TileSize::Narrow, [[0, 0]].into_iter());
    let centre = tiles.find([0, 0]).unwrap();
    assert_eq!(tiles.node_index(centre * 16 + 6), [2, 1]);
    assert_eq!(
        tiles.node_position(&grid, centre * 16 + 6),
        Vector2::new(2.0, -0.5)
    );
    let corner = tiles.find([-1, -1]).unwrap();
    assert_eq!(tiles.node_index(corner * 16 + 15), [-1, -1]);
}
