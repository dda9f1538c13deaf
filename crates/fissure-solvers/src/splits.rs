//! Nodes with more than one field.
//!
//! Particles fall into *groups* (`groups`), and a group has a [`Label`] at every node of its
//! window: which body's field it belongs to, which cracks lie between. Where particles of two labels
//! reach a node, the node is *split*: the field of the lowest label stays where the node is, each
//! further one is an *extra node* behind all others, with mass, momentum and forces of its own.
//! Whatever works on nodes need not know. Transfers go through the window of a tile and a group,
//! which is the plain one of the tile unless a node in it is split.

use fissure_grid::{ABSENT, Tiles};

use crate::groups::{Groups, Label};
use crate::window::WindowNodes;

/// Marks a window entry whose node is not split, and the number of none.
pub(crate) const NONE: u32 = u32::MAX;

/// A field at a split node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Copy {
    /// Number of its node.
    pub node: u32,
    /// Particles whose field it is.
    pub label: Label,
}

/// The window of a tile for the particles of a group, with split nodes in it.
#[derive(Clone, Debug)]
pub(crate) struct SplitWindow {
    pub tile: u32,
    pub group: u32,
    /// Node of every entry, [`NONE`] for numbers that are no entry.
    pub nodes: Box<[u32]>,
    /// Index into [`Splits::copies`] of every entry, [`NONE`] where the node is not split.
    pub copies: Box<[u32]>,
}

/// The split nodes of a scene and the windows that see them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Splits {
    /// Fields at split nodes; those of one node side by side, in the order of labels.
    pub copies: Vec<Copy>,
    /// Where the copies of each split node begin, and the end; ascending by node.
    pub starts: Vec<u32>,
    /// Windows that differ from those of their tiles, ascending by `(tile, group)`.
    pub windows: Vec<SplitWindow>,
    /// The node of which each extra node is a copy.
    pub origins: Vec<u32>,
}

impl Splits {
    /// Splits what is reached with several labels; `occupied` are the `(tile, group)` that hold
    /// particles, ascending and each once.
    pub(crate) fn rebuild<const D: usize>(
        &mut self,
        tiles: &Tiles<D>,
        groups: &Groups,
        occupied: &[(u32, u32)],
    ) {
        self.copies.clear();
        self.starts.clear();
        self.windows.clear();
        self.origins.clear();
        let near = near_a_difference(tiles, groups, occupied);
        let mut fields: Vec<(u32, Label)> = Vec::new();
        for &(tile, group) in &near {
            let nodes = WindowNodes::of_tile(tiles, tile as usize);
            let entries = tiles.window(tile as usize).entries();
            let field = |entry| (nodes.node(entry) as u32, groups.label(group, entry));
            fields.extend(entries.map(field));
        }
        fields.sort_unstable();
        fields.dedup();
        for fields in fields.chunk_by(|a, b| a.0 == b.0) {
            if fields.len() > 1 {
                self.split(tiles.node_count(), fields);
            }
        }
        if self.copies.is_empty() {
            return;
        }
        self.starts.push(self.copies.len() as u32);
        for (tile, group) in near {
            self.window(tiles, groups, tile, group);
        }
    }

    fn split(&mut self, plain: usize, fields: &[(u32, Label)]) {
        self.starts.push(self.copies.len() as u32);
        for (k, &(origin, label)) in fields.iter().enumerate() {
            let node = if k == 0 {
                origin
            } else {
                self.origins.push(origin);
                (plain + self.origins.len() - 1) as u32
            };
            self.copies.push(Copy { node, label });
        }
    }

    fn window<const D: usize>(&mut self, tiles: &Tiles<D>, groups: &Groups, tile: u32, group: u32) {
        let plain = WindowNodes::of_tile(tiles, tile as usize);
        let numbers = tiles.map().len();
        let mut copies = vec![NONE; numbers];
        let mut nodes = vec![NONE; numbers];
        for entry in tiles.window(tile as usize).entries() {
            let node = plain.node(entry);
            copies[entry] = self.copy(node, groups.label(group, entry));
            nodes[entry] = match copies[entry] {
                NONE => node as u32,
                copy => self.copies[copy as usize].node,
            };
        }
        if copies.iter().all(|&copy| copy == NONE) {
            return;
        }
        self.windows.push(SplitWindow {
            tile,
            group,
            nodes: nodes.into(),
            copies: copies.into(),
        });
    }

    /// Index of a label's field at a plain node, [`NONE`] if the node is not split.
    fn copy(&self, origin: usize, label: Label) -> u32 {
        let mut of_node = self.copies_of(origin);
        let found = of_node.find(|&copy| self.copies[copy].label == label);
        found.map_or(NONE, |copy| copy as u32)
    }

    /// Indices of the fields at a plain node; none if it is not split.
    pub(crate) fn copies_of(&self, origin: usize) -> std::ops::Range<usize> {
        let nodes = self.starts.len().saturating_sub(1);
        let starts = &self.starts[..nodes];
        let first = |start: &u32| self.copies[*start as usize].node as usize;
        match starts.binary_search_by_key(&origin, first) {
            Ok(k) => self.starts[k] as usize..self.starts[k + 1] as usize,
            Err(_) => 0..0,
        }
    }

    /// The fields of each split node.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        let pairs = self.starts.windows(2);
        pairs.map(|pair| pair[0] as usize..pair[1] as usize)
    }

    /// Index of the window of a tile and group, if it has split nodes.
    pub(crate) fn find(&self, tile: u32, group: u32) -> Option<usize> {
        let key = |window: &SplitWindow| (window.tile, window.group);
        self.windows.binary_search_by_key(&(tile, group), key).ok()
    }
}

/// The occupied `(tile, group)` whose windows overlap one with other labels.
fn near_a_difference<const D: usize>(
    tiles: &Tiles<D>,
    groups: &Groups,
    occupied: &[(u32, u32)],
) -> Vec<(u32, u32)> {
    // Windows reach two nodes beyond their tile, which has more: only those of neighbours overlap.
    let groups_at = |tile: u32| {
        let first = occupied.partition_point(|&(other, _)| other < tile);
        let same = occupied[first..].iter();
        same.take_while(move |&&(other, _)| other == tile)
    };
    let is_near = |&&(tile, group): &&(u32, u32)| {
        let around = tiles.around(tile as usize).iter().copied();
        around
            .filter(|&tile| tile != ABSENT)
            .any(|tile| groups_at(tile).any(|&(_, other)| groups.may_differ(group, other)))
    };
    occupied.iter().filter(is_near).copied().collect()
}
