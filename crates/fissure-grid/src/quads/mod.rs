//! A mesh of bilinear quadrilaterals: nodes at any place, straight faces, four corners an element.
//!
//! *Map* [Sanchez 2010, eqs 4.4.1-4.4.2]: with natural coordinates −1 ≤ ξ, η ≤ 1 and corners 1 to 4 counter-clockwise from
//! (−1, −1),
//!
//! ```text
//! N_i = ¼ (1 + ξ_i ξ)(1 + η_i η)        x = Σ N_i x_i        ∇N_i = J⁻ᵀ ∂N_i/∂(ξ, η),   J = ∂x/∂(ξ, η)
//! ```
//!
//! *Inverse* [eqs 4.4.8-4.4.9]: Newton's method from the centre, `J Δ(ξ, η) = x_p − x(ξ, η)`, until nothing is gained. Where a
//! step gains nothing before the point is found, ξ is bracketed by the signs on two opposite faces.
//!
//! *Search* [text after eq. 4.4.1]: from an element near by, across the face that the point is farthest beyond, by a table of
//! neighbours. The document starts from the element that the particle was in last; here it is that of the particle before it
//! in its patch, so that nothing is kept. Without such an element, or where the way leads out of the mesh, among the elements
//! listed for the point's cell of a coarse lattice.
//!
//! *Ownership*: on which side of a face a point lies is decided exactly (Shewchuk's predicate on the two nodes of the face),
//! so both neighbours agree. A point on a face or a node belongs to the element of the lowest number that has it.

mod checks;
mod element;
mod error;
mod search;

use std::sync::Arc;

use fissure_tensor::Band;
use nalgebra::{Matrix2, Vector2};

use crate::patches::Patches;
use crate::{Grid, Stencil};
use element::{CORNERS, Element};
pub use error::MeshError;
use search::Search;

/// A conforming mesh of convex quadrilaterals with straight faces. Cheap to clone: what it holds is shared.
#[derive(Clone, Debug)]
pub struct QuadMesh(Arc<Parts>);

#[derive(Debug)]
struct Parts {
    corners: Vec<[u32; 4]>,
    elements: Vec<Element>,
    search: Search,
    patches: Arc<Patches<2>>,
    /// Place of every corner among the nodes of its element's own patch.
    entries: Vec<[u8; 4]>,
    grid: Grid<2>,
    widest: Band,
}

impl PartialEq for QuadMesh {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
            || (self.nodes() == other.nodes() && self.elements() == other.elements())
    }
}

impl QuadMesh {
    /// A mesh of these nodes (m) and elements: four nodes each, counter-clockwise. Nodes that no element has are allowed.
    ///
    /// # Errors
    /// No element, a coordinate that is not finite, a node that is not there, a Jacobian that is not positive at a corner,
    /// faces that do not conform.
    pub fn new(nodes: Vec<Vector2<f64>>, elements: Vec<[u32; 4]>) -> Result<Self, MeshError> {
        checks::check(&nodes, &elements)?;
        let neighbours = checks::neighbours(&elements)?;
        let maps: Vec<Element> = elements
            .iter()
            .map(|corners| Element::of(corners.map(|node| nodes[node as usize])))
            .collect();
        let used = || elements.iter().flatten().map(|&node| nodes[node as usize]);
        let low = used().fold(nodes[elements[0][0] as usize], |a, b| a.inf(&b));
        let high = used().fold(low, |a, b| a.sup(&b));
        let grid = Grid::over(low.into(), high.into(), shortest(&nodes, &elements))?;
        let search = Search::new(&nodes, &elements, neighbours, (low, high));
        checks::check_corners(&nodes, &elements, &search)?;
        let patches = Patches::of_elements(&nodes, &elements)?;
        let entries = elements
            .iter()
            .enumerate()
            .map(|(element, corners)| {
                let patch = patches.home(element as u32);
                corners.map(|node| patches.entry(patch, node).unwrap_or(0))
            })
            .collect();
        let widest = widest(&maps);
        Ok(Self(Arc::new(Parts {
            corners: elements,
            elements: maps,
            search,
            patches: Arc::new(patches),
            entries,
            grid,
            widest,
        })))
    }

    /// Positions of the nodes, m.
    pub fn nodes(&self) -> &[Vector2<f64>] {
        self.0.patches.nodes()
    }

    /// Corners of the elements, counter-clockwise.
    pub fn elements(&self) -> &[[u32; 4]] {
        &self.0.corners
    }

    /// The box about the mesh, in cells as wide as the shortest way across an element: what a solver takes as its grid beside
    /// [`shape::Isoparametric`](crate::shape::Isoparametric). Its spacing bounds the explicit step.
    pub fn grid(&self) -> Grid<2> {
        self.0.grid.clone()
    }

    /// Area of an element, m²; `element` is below the number of elements, as for a slice.
    pub fn area(&self, element: usize) -> f64 {
        // The determinant of the Jacobian is linear in ξ and η: four times its value at the centre.
        4.0 * self.0.elements[element]
            .jacobian(&Vector2::zeros())
            .determinant()
    }

    /// The element across each face of an element, the face from corner k to corner k + 1; none on the border of the mesh.
    pub fn neighbours(&self, element: usize) -> [Option<usize>; 4] {
        self.0.search.neighbours(element)
    }

    /// The element that owns a point: the one of the lowest number that has it, borders included. None if the point is
    /// outside or not a number.
    pub fn element(&self, x: &Vector2<f64>) -> Option<usize> {
        let element = self.0.search.listed(self.nodes(), self.elements(), x)?;
        Some(element as usize)
    }

    /// The same, sought from an element near by, across one face after another.
    pub fn element_from(&self, start: usize, x: &Vector2<f64>) -> Option<usize> {
        let start = start as u32;
        let found = self
            .0
            .search
            .from(self.nodes(), self.elements(), start, x)?;
        Some(found as usize)
    }

    /// Natural coordinates of a point of an element, each in [−1, 1].
    pub fn natural(&self, element: usize, x: &Vector2<f64>) -> Vector2<f64> {
        self.0.elements[element].inverse(x)
    }

    /// The point of an element at natural coordinates, m.
    pub fn point(&self, element: usize, natural: &Vector2<f64>) -> Vector2<f64> {
        self.0.elements[element].point(natural)
    }

    /// Values and gradients (1/m) of the functions of an element's corners at a point of it.
    pub fn functions(&self, element: usize, x: &Vector2<f64>) -> [(f64, Vector2<f64>); 4] {
        let map = &self.0.elements[element];
        let at = map.inverse(x);
        let inverse = map
            .jacobian(&at)
            .try_inverse()
            .unwrap_or_else(Matrix2::zeros);
        CORNERS.map(|[xi, eta]| {
            let (along, across) = (1.0 + xi * at.x, 1.0 + eta * at.y);
            let slope = Vector2::new(0.25 * xi * across, 0.25 * eta * along);
            (0.25 * along * across, inverse.tr_mul(&slope))
        })
    }

    /// Middles (m) and areas (m²) of `per_side`² parts of each of these elements, equal in natural coordinates: where
    /// particles may go. The areas of an element's parts sum to its own.
    pub fn parts(&self, elements: &[usize], per_side: usize) -> Vec<(Vector2<f64>, f64)> {
        let middle = |k: usize| (2 * k + 1) as f64 / per_side as f64 - 1.0;
        let share = 4.0 / (per_side * per_side) as f64;
        let mut parts = Vec::with_capacity(elements.len() * per_side * per_side);
        for &element in elements {
            let map = &self.0.elements[element];
            for j in 0..per_side {
                for i in 0..per_side {
                    let at = Vector2::new(middle(i), middle(j));
                    parts.push((map.point(&at), share * map.jacobian(&at).determinant()));
                }
            }
        }
        parts
    }

    /// Width over which a smeared crack in an element dissipates its energy: that of the parallelogram with the element's
    /// centre and slopes there.
    pub fn band(&self, element: usize) -> Band {
        let [a, b] = self.0.elements[element].edges();
        Band::Skewed([a.into(), b.into()])
    }

    /// A band at least as wide as that of any element for every normal; that of every element where all are alike.
    pub fn widest_band(&self) -> Band {
        self.0.widest
    }

    /// The sets of elements that are worked on together.
    pub fn patches(&self) -> &Arc<Patches<2>> {
        &self.0.patches
    }

    /// The stencil of a point in a patch, sought from `last`; and the element.
    #[inline]
    pub(crate) fn stencil(
        &self,
        patch: u32,
        last: Option<u32>,
        x: &Vector2<f64>,
    ) -> Option<(QuadStencil, u32)> {
        let Parts {
            search,
            corners,
            patches,
            entries,
            ..
        } = &*self.0;
        let start = last.unwrap_or_else(|| patches.first_element(patch));
        let element = search.from(self.nodes(), corners, start, x)?;
        let nodes = corners[element as usize];
        let entries = if patches.home(element) == patch {
            entries[element as usize]
        } else {
            let mut entries = [0; 4];
            for (entry, &node) in entries.iter_mut().zip(&nodes) {
                *entry = patches.entry(patch, node)?;
            }
            entries
        };
        let functions = self.functions(element as usize, x);
        let stencil = QuadStencil {
            entries,
            functions,
            arms: nodes.map(|node| self.nodes()[node as usize] - x),
        };
        Some((stencil, element))
    }
}

/// The four corners of the element that a particle is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadStencil {
    entries: [u8; 4],
    functions: [(f64, Vector2<f64>); 4],
    /// From the particle to the corners, m.
    arms: [Vector2<f64>; 4],
}

impl Stencil<2> for QuadStencil {
    #[inline]
    fn visit(&self, mut f: impl FnMut(usize, f64, Vector2<f64>)) {
        for (&entry, (value, gradient)) in self.entries.iter().zip(&self.functions) {
            f(usize::from(entry), *value, *gradient);
        }
    }

    #[inline]
    fn arm(&self, window: usize) -> Vector2<f64> {
        let corner = self.entries.iter().position(|&e| usize::from(e) == window);
        corner.map_or_else(Vector2::zeros, |corner| self.arms[corner])
    }
}

/// The shortest way across an element: over its corners the least height of the parallelogram of the two faces there, m.
fn shortest(nodes: &[Vector2<f64>], elements: &[[u32; 4]]) -> f64 {
    let mut least = f64::INFINITY;
    for corners in elements {
        let x = corners.map(|node| nodes[node as usize]);
        for k in 0..4 {
            let (next, before) = (x[(k + 1) % 4] - x[k], x[(k + 3) % 4] - x[k]);
            least = least.min(next.perp(&before) / next.norm().max(before.norm()));
        }
    }
    least
}

/// Part by which edges may differ and still count as alike.
const ALIKE: f64 = 1e-9;

/// The band of all elements where they are alike, else one that is at least as wide for every normal.
fn widest(elements: &[Element]) -> Band {
    let bands = elements.iter().map(Element::edges);
    let [a, b] = elements
        .first()
        .map_or_else(Default::default, Element::edges);
    let same = |p: &Vector2<f64>, q: &Vector2<f64>| {
        // A face may be counted from either end.
        (p - q).norm().min((p + q).norm()) <= ALIKE * p.norm()
    };
    let alike = |[p, q]: [Vector2<f64>; 2]| {
        (same(&a, &p) && same(&b, &q)) || (same(&a, &q) && same(&b, &p))
    };
    if bands.clone().all(alike) {
        return Band::Skewed([a.into(), b.into()]);
    }
    let widths = bands.map(|[a, b]| Band::Skewed([a.into(), b.into()]).max_width());
    Band::Uniform(widths.fold(0.0, f64::max))
}
