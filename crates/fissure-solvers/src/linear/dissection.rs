//! A nested-dissection order of the nodes of a matrix from their positions.

use super::blocks::BlockPattern;

/// Fewer nodes than this are not divided further.
const LEAF: usize = 8;

/// The order to eliminate nodes in: `order[k]` is the node that is eliminated as the `k`-th.
///
/// Nodes are halved across the longest side of the box around them; those of the lower half with a
/// neighbour in the upper one separate the two and come last; the halves are divided on (George
/// 1973). On a grid of `n` nodes the factor then has `O(n log n)` entries in 2D, `O(n^{4/3})` in 3D.
/// Nodes may share a position.
pub fn nested_dissection<const D: usize>(
    pattern: &BlockPattern,
    positions: &[[f64; D]],
) -> Vec<u32> {
    let mut nodes: Vec<u32> = (0..pattern.nodes() as u32).collect();
    let mut dissection = Dissection {
        pattern,
        positions,
        part: vec![0; nodes.len()],
        parts: 0,
        kept: Vec::new(),
        sorted: Vec::new(),
    };
    dissection.divide(&mut nodes);
    nodes
}

struct Dissection<'a, const D: usize> {
    pattern: &'a BlockPattern,
    positions: &'a [[f64; D]],
    /// Number of the upper half that a node was last in.
    part: Vec<u32>,
    parts: u32,
    kept: Vec<u32>,
    sorted: Vec<f64>,
}

impl<const D: usize> Dissection<'_, D> {
    /// Puts nodes into the order of elimination.
    fn divide(&mut self, nodes: &mut [u32]) {
        if nodes.len() <= LEAF {
            return;
        }
        let (axis, lower) = self.halve(nodes);
        if lower == 0 || lower == nodes.len() {
            return; // All in one place.
        }
        self.parts += 1;
        for &node in &nodes[lower..] {
            self.part[node as usize] = self.parts;
        }
        // Lower half | upper half | separator, each in the order it had.
        self.kept.clear();
        let mut kept = 0;
        for k in 0..lower {
            let node = nodes[k];
            let neighbours = self.pattern.neighbours(node as usize);
            let cut = |&other: &u32| self.part[other as usize] == self.parts;
            if neighbours.iter().any(cut) {
                self.kept.push(node);
            } else {
                nodes[kept] = node;
                kept += 1;
            }
        }
        let upper = nodes.len() - lower;
        nodes.copy_within(lower.., kept);
        nodes[kept + upper..].copy_from_slice(&self.kept);
        let separator = &mut nodes[kept + upper..];
        // Along its longest side, so that its own factor keeps close to the diagonal.
        let positions = self.positions;
        separator.sort_by(|&a, &b| {
            let (a, b) = (&positions[a as usize], &positions[b as usize]);
            (0..D)
                .filter(|&other| other != axis)
                .map(|other| a[other].total_cmp(&b[other]))
                .find(|order| order.is_ne())
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        let (lower, rest) = nodes.split_at_mut(kept);
        self.divide(lower);
        self.divide(&mut rest[..upper]);
    }

    /// Puts the nodes below a plane through the middle first; returns the axis across it and their number.
    fn halve(&mut self, nodes: &mut [u32]) -> (usize, usize) {
        let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for &node in nodes.iter() {
            for (axis, &x) in self.positions[node as usize].iter().enumerate() {
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
            }
        }
        let length = |axis: &usize| high[*axis] - low[*axis];
        let longest = (0..D).max_by(|a, b| length(a).total_cmp(&length(b)));
        let axis = longest.unwrap_or(0);
        let of = |node: &u32| self.positions[*node as usize][axis];
        self.sorted.clear();
        self.sorted.extend(nodes.iter().map(of));
        let middle = nodes.len() / 2;
        let (_, &mut plane, upper) = self.sorted.select_nth_unstable_by(middle, f64::total_cmp);
        // Whole layers of a grid: none may be torn, and neither half may be empty.
        let torn = upper.iter().all(|&x| x <= plane);
        let below = |node: &u32| {
            if torn {
                of(node) < plane
            } else {
                of(node) <= plane
            }
        };
        self.kept.clear();
        self.kept
            .extend(nodes.iter().copied().filter(|node| !below(node)));
        let mut lower = 0;
        for k in 0..nodes.len() {
            if below(&nodes[k]) {
                nodes[lower] = nodes[k];
                lower += 1;
            }
        }
        nodes[lower..].copy_from_slice(&self.kept);
        (axis, lower)
    }
}
