//! The width over which a discretisation smears a crack.

use crate::Vector3;

/// Width, in metres, of the band of material that a smeared crack of given normal occupies.
///
/// It belongs to the discretisation, not to the law: a law turns an opening `w` into the
/// inelastic strain `w / width(n)`, so that the energy dissipated per crack area is the
/// fracture energy whatever the cell size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Band {
    /// The same width for every normal.
    Uniform(f64),
    /// `a|n_x| + b|n_y| + c|n_z|`: the mean number of cells a crack crosses, times their size.
    /// With `a = b = c = h` this is the band of linear shape functions on cells `h` wide.
    Projected([f64; 3]),
    /// `|n·a| + |n·b| + c|n_z|`: the same for cells that are parallelograms of the edges `a` and `b` in the plane;
    /// `c`, for cracks that the plane does not show, is the edge of a square of their area.
    Skewed([[f64; 2]; 2]),
    /// Volume over central section of a box with these edges, `V_p / A_c` of Nairn 2017, eq. 11.
    /// An edge of zero length stands for a dimension that the crack does not see (plane problems).
    Section([f64; 3]),
}

impl Band {
    /// Width of a crack with unit normal `normal`, m.
    pub fn width(&self, normal: &Vector3<f64>) -> f64 {
        match self {
            Self::Uniform(width) => *width,
            Self::Projected(edges) => {
                edges[0] * normal.x.abs() + edges[1] * normal.y.abs() + edges[2] * normal.z.abs()
            }
            Self::Skewed([a, b]) => {
                let along = |edge: &[f64; 2]| (edge[0] * normal.x + edge[1] * normal.y).abs();
                along(a) + along(b) + out_of_plane(a, b) * normal.z.abs()
            }
            Self::Section(edges) => section_width(edges, normal),
        }
    }

    /// The largest width over all normals, m.
    pub fn max_width(&self) -> f64 {
        match self {
            Self::Uniform(width) => *width,
            // Cauchy-Schwarz, attained by the normal parallel to the edge vector.
            Self::Projected(e) => (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]).sqrt(),
            // The same of the longer diagonal, whichever signs the two terms have, and the edge out of the plane.
            Self::Skewed([a, b]) => {
                let diagonal = |s: f64| (a[0] + s * b[0]).hypot(a[1] + s * b[1]);
                diagonal(1.0).max(diagonal(-1.0)).hypot(out_of_plane(a, b))
            }
            // The smallest central section of a box is the one across its longest edge: by Vaaler's
            // theorem (1979) `V/A ≤ √(Σ edge_i² n_i²)`, which the longest edge bounds and attains.
            Self::Section(e) => e[0].max(e[1]).max(e[2]),
        }
    }

    /// The band with every width multiplied by `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::Uniform(width) => Self::Uniform(width * factor),
            Self::Projected(edges) => Self::Projected(edges.map(|edge| edge * factor)),
            Self::Skewed(edges) => Self::Skewed(edges.map(|edge| edge.map(|c| c * factor))),
            Self::Section(edges) => Self::Section(edges.map(|edge| edge * factor)),
        }
    }

    /// A uniform band of the given width, m.
    pub fn cube(width: f64) -> Self {
        Self::Uniform(width)
    }
}

/// Edge of the square that has the area of a parallelogram.
fn out_of_plane(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).abs().sqrt()
}

/// `V/A` of the central section of a box: `1/f(0)` with `f` the density of the sum of three
/// independent uniform variables on `±w_i/2`, `w_i = edge_i |n_i|` (the section area at offset
/// `s` is the volume times that density).
fn section_width(edges: &[f64; 3], normal: &Vector3<f64>) -> f64 {
    let mut w = [
        edges[0] * normal.x.abs(),
        edges[1] * normal.y.abs(),
        edges[2] * normal.z.abs(),
    ];
    w.sort_by(|a, b| b.total_cmp(a));
    let [large, middle, small] = w;
    if large >= middle + small {
        return large;
    }
    // Here `small > large - middle ≥ 0`: the hexagonal section.
    let corner = middle + small - large;
    1.0 / (1.0 / large - corner * corner / (4.0 * large * middle * small))
}
