//! Which element has a point.

use nalgebra::Vector2;

use super::checks::orient;

/// Marks a face without a neighbour.
pub(super) const NONE: u32 = u32::MAX;
/// Faces crossed before the lists are asked: on a mesh of any shape the way could go round in circles.
const MOST_FACES: usize = 32;
/// Most cells of the lattice along an axis.
const MOST_CELLS: f64 = 4096.0;

/// Neighbours across faces, and for every cell of a lattice the elements whose boxes meet it.
#[derive(Debug)]
pub(super) struct Search {
    neighbours: Vec<[u32; 4]>,
    low: Vector2<f64>,
    /// Cells to a metre along each axis.
    density: Vector2<f64>,
    cells: [usize; 2],
    /// Where the list of each cell begins, and the end.
    starts: Vec<u32>,
    /// Elements, ascending within a cell.
    listed: Vec<u32>,
}

impl Search {
    /// About one cell an element, over the box of the mesh.
    pub(super) fn new(
        nodes: &[Vector2<f64>],
        elements: &[[u32; 4]],
        neighbours: Vec<[u32; 4]>,
        (low, high): (Vector2<f64>, Vector2<f64>),
    ) -> Self {
        let extent = high - low;
        let width = (extent.x * extent.y / elements.len() as f64).sqrt();
        let count = extent.map(|length| (length / width).ceil().clamp(1.0, MOST_CELLS));
        let mut search = Self {
            neighbours,
            low,
            density: count.component_div(&extent),
            cells: [count.x as usize, count.y as usize],
            starts: Vec::new(),
            listed: Vec::new(),
        };
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (element, corners) in elements.iter().enumerate() {
            let x = corners.map(|node| nodes[node as usize]);
            let from = search.cell(&x.iter().fold(x[0], |a, b| a.inf(b)));
            let to = search.cell(&x.iter().fold(x[0], |a, b| a.sup(b)));
            for row in from[1]..=to[1] {
                for column in from[0]..=to[0] {
                    pairs.push(((row * search.cells[0] + column) as u32, element as u32));
                }
            }
        }
        pairs.sort_unstable();
        let cells = search.cells[0] * search.cells[1];
        search.starts = vec![0; cells + 1];
        for (cell, _) in &pairs {
            search.starts[*cell as usize + 1] += 1;
        }
        for cell in 0..cells {
            search.starts[cell + 1] += search.starts[cell];
        }
        search.listed = pairs.into_iter().map(|(_, element)| element).collect();
        search
    }

    /// The cell of a point, the nearest one for points outside. It grows with either coordinate, so that a point between
    /// two others is in a cell between theirs, whatever rounding does.
    fn cell(&self, x: &Vector2<f64>) -> [usize; 2] {
        std::array::from_fn(|axis| {
            // A cast saturates.
            let cell = ((x[axis] - self.low[axis]) * self.density[axis]) as usize;
            cell.min(self.cells[axis] - 1)
        })
    }

    /// All elements that have a point, borders included, ascending.
    pub(super) fn all_with<'a>(
        &'a self,
        nodes: &'a [Vector2<f64>],
        elements: &'a [[u32; 4]],
        x: &'a Vector2<f64>,
    ) -> impl Iterator<Item = u32> + 'a {
        let [column, row] = self.cell(x);
        let cell = row * self.cells[0] + column;
        let listed = self.starts[cell] as usize..self.starts[cell + 1] as usize;
        let has = |&element: &u32| {
            let corners = &elements[element as usize];
            (0..4).all(|face| side(nodes, corners, face, x) >= 0.0)
        };
        self.listed[listed].iter().copied().filter(has)
    }

    /// The element of the lowest number that has a point.
    pub(super) fn listed(
        &self,
        nodes: &[Vector2<f64>],
        elements: &[[u32; 4]],
        x: &Vector2<f64>,
    ) -> Option<u32> {
        self.all_with(nodes, elements, x).next()
    }

    /// The same, across the faces from an element on.
    pub(super) fn from(
        &self,
        nodes: &[Vector2<f64>],
        elements: &[[u32; 4]],
        start: u32,
        x: &Vector2<f64>,
    ) -> Option<u32> {
        let mut element = start;
        for _ in 0..MOST_FACES {
            let corners = &elements[element as usize];
            let sides: [f64; 4] = std::array::from_fn(|face| side(nodes, corners, face, x));
            if sides.iter().all(|&side| side > 0.0) {
                return Some(element);
            }
            if !sides.iter().any(|&side| side < 0.0) {
                // On its border, or no number: who owns it the lists say.
                break;
            }
            let next = self.across(nodes, corners, &sides, element);
            if next == NONE {
                break;
            }
            element = next;
        }
        self.listed(nodes, elements, x)
    }

    /// The neighbour across the face that a point is farthest beyond.
    fn across(
        &self,
        nodes: &[Vector2<f64>],
        corners: &[u32; 4],
        sides: &[f64; 4],
        element: u32,
    ) -> u32 {
        let (mut farthest, mut face) = (0.0, 0);
        for (k, side) in sides.iter().enumerate() {
            let [from, to] = ends(corners, k).map(|node| &nodes[node as usize]);
            let beyond = -side / (to - from).norm();
            if beyond > farthest {
                (farthest, face) = (beyond, k);
            }
        }
        self.neighbours[element as usize][face]
    }

    pub(super) fn neighbours(&self, element: usize) -> [Option<usize>; 4] {
        self.neighbours[element].map(|other| (other != NONE).then_some(other as usize))
    }
}

fn ends(corners: &[u32; 4], face: usize) -> [u32; 2] {
    [corners[face], corners[(face + 1) % 4]]
}

/// Positive inside of a face, 0 on its line, negative beyond; the sign is exact.
#[inline]
fn side(nodes: &[Vector2<f64>], corners: &[u32; 4], face: usize, x: &Vector2<f64>) -> f64 {
    let [from, to] = ends(corners, face).map(|node| &nodes[node as usize]);
    orient(from, to, x)
}
