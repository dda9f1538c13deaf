//! What a mesh is asked before it is taken.

use nalgebra::Vector2;
use robust::{Coord, orient2d};

use super::MeshError;
use super::search::{NONE, Search};

/// Most nodes, and most elements.
const MOST: usize = 1 << 30;

/// Twice the area of the triangle `a b c`, positive if it runs counter-clockwise; its sign is exact.
#[inline]
pub(super) fn orient(a: &Vector2<f64>, b: &Vector2<f64>, c: &Vector2<f64>) -> f64 {
    let coord = |p: &Vector2<f64>| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}

/// Counts, numbers, and the Jacobian at every corner: it is linear along each face, and so positive everywhere.
pub(super) fn check(nodes: &[Vector2<f64>], elements: &[[u32; 4]]) -> Result<(), MeshError> {
    if elements.is_empty() {
        return Err(MeshError::Empty);
    }
    for (what, count) in [("nodes", nodes.len()), ("elements", elements.len())] {
        if count > MOST {
            let limit = MOST;
            return Err(MeshError::TooMany { what, count, limit });
        }
    }
    for (node, x) in nodes.iter().enumerate() {
        if !(x.x.is_finite() && x.y.is_finite()) {
            let (x, y) = (x.x, x.y);
            return Err(MeshError::NotFinite { node, x, y });
        }
    }
    for (element, corners) in elements.iter().enumerate() {
        if let Some(&node) = corners.iter().find(|&&node| node as usize >= nodes.len()) {
            let nodes = nodes.len();
            return Err(MeshError::UnknownNode {
                element,
                node,
                nodes,
            });
        }
        let x = corners.map(|node| nodes[node as usize]);
        for corner in 0..4 {
            let twice = orient(&x[(corner + 3) % 4], &x[corner], &x[(corner + 1) % 4]);
            // The faces at the corner are twice the slopes by ξ and η.
            let jacobian = 0.25 * twice;
            if !(jacobian > 0.0) {
                return Err(MeshError::Jacobian {
                    element,
                    corner,
                    jacobian,
                });
            }
        }
    }
    Ok(())
}

/// The element across each face of each, [`NONE`] where there is none.
pub(super) fn neighbours(elements: &[[u32; 4]]) -> Result<Vec<[u32; 4]>, MeshError> {
    // (lower node, higher node, whether the face runs from the higher one, element, face)
    let mut sides: Vec<(u32, u32, bool, u32, usize)> = Vec::with_capacity(4 * elements.len());
    for (element, corners) in elements.iter().enumerate() {
        for face in 0..4 {
            let (from, to) = (corners[face], corners[(face + 1) % 4]);
            let (low, high) = (from.min(to), from.max(to));
            sides.push((low, high, from > to, element as u32, face));
        }
    }
    sides.sort_unstable();
    let mut neighbours = vec![[NONE; 4]; elements.len()];
    for same in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        for pair in same.windows(2) {
            let (first, second) = (pair[0], pair[1]);
            if first.2 == second.2 {
                let corners = &elements[first.3 as usize];
                return Err(MeshError::SharedSide {
                    first: first.3 as usize,
                    second: second.3 as usize,
                    from: corners[first.4],
                    to: corners[(first.4 + 1) % 4],
                });
            }
            neighbours[first.3 as usize][first.4] = second.3;
            neighbours[second.3 as usize][second.4] = first.3;
        }
    }
    Ok(neighbours)
}

/// Refuses a corner of one element that another has without being its corner.
pub(super) fn check_corners(
    nodes: &[Vector2<f64>],
    elements: &[[u32; 4]],
    search: &Search,
) -> Result<(), MeshError> {
    let mut used = vec![false; nodes.len()];
    for &node in elements.iter().flatten() {
        used[node as usize] = true;
    }
    for (node, x) in nodes.iter().enumerate().filter(|(node, _)| used[*node]) {
        for element in search.all_with(nodes, elements, x) {
            if !elements[element as usize].contains(&(node as u32)) {
                let element = element as usize;
                return Err(MeshError::NotConforming { node, element });
            }
        }
    }
    Ok(())
}
