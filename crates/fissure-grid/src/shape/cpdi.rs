//! Convected particle domains: linear functions sampled at the corners of a domain that deforms with the particle.

use fissure_tensor::Band;
use nalgebra::{SMatrix, SVector};

use crate::{Grid, OneByOne, Shape, Stencil, Window, simd::EIGHT, simd::Lanes};

/// Corners of a parallelepiped, the most a domain has.
const MOST_CORNERS: usize = 8;

/// CPDI (Sadeghirad, Brannon & Burghardt 2011): the domain is a parallelogram or parallelepiped whose edges follow the
/// deformation gradient; on it the linear functions are replaced by the multilinear ones through its corners.
///
/// `N_i = 2^−D Σ_c N_i(x_c)` and `∇N_i = 2^−D Σ_c N_i(x_c) R^−T σ_c`, with the half-edges `R` as columns, corners
/// `x_c = x + R σ_c` and signs `σ_c ∈ {−1, 1}^D`: the averages of function and gradient over the domain. The latter is
/// not the derivative of the former.
///
/// A domain may extend one cell from its centre along each grid axis. A longer one is shortened along that axis, after the
/// idea of Homel, Brannon & Guilkey (2016): the particle then parts from its neighbours at a stretch that does not depend
/// on where it sits in its window. Consistency is not touched, since the shortened domain is a parallelepiped too. No
/// stencil for a domain without volume, which has no gradient.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cpdi;

/// The stencil of [`Cpdi`]: for each corner of the domain its cell and the coordinate in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corners<const D: usize> {
    /// Window index of the lowest node of each corner's cell; the first 2^D count.
    bases: [usize; MOST_CORNERS],
    /// Coordinate of each corner in its cell, [0, 1].
    locals: [SVector<f64, D>; MOST_CORNERS],
    /// R^−T, 1/m.
    rates: SMatrix<f64, D, D>,
    /// From the particle to the first node of the window, m.
    arm: SVector<f64, D>,
    /// Cell width, m.
    spacing: f64,
}

impl<const D: usize> Shape<D> for Cpdi {
    type Stencil = Corners<D>;
    type Stencils = OneByOne<Corners<D>>;
    const DEFORMS: bool = true;

    fn name(&self) -> &'static str {
        "cpdi"
    }

    #[inline]
    fn domain(&self, initial: &SMatrix<f64, D, D>, f: &SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
        f * initial
    }

    #[inline]
    fn stencil(
        &self,
        grid: &Grid<D>,
        window: &Window<D>,
        x: &SVector<f64, D>,
        domain: &SMatrix<f64, D, D>,
    ) -> Option<Self::Stencil> {
        let (cell, local) = grid.locate(x)?;
        let edges = shortened(domain * grid.inverse_spacing());
        let rates = edges.try_inverse()?.transpose() * grid.inverse_spacing();
        if !rates.iter().all(|rate| rate.is_finite()) {
            return None;
        }
        let mut corners = Corners {
            bases: [0; MOST_CORNERS],
            locals: [SVector::zeros(); MOST_CORNERS],
            rates,
            arm: SVector::zeros(),
            spacing: grid.spacing(),
        };
        for corner in 0..1 << D {
            let at = local + edges * signs(corner);
            for axis in 0..D {
                // The corner is at most one cell away, so this is the floor.
                let offset = i32::from(at[axis] >= 1.0) - i32::from(at[axis] < 0.0);
                corners.locals[corner][axis] = at[axis] - f64::from(offset);
                let start = window.start(axis, cell[axis] + offset, 2)?;
                corners.bases[corner] += start * Window::<D>::ROW.pow(axis as u32);
            }
        }
        // The window is near now, or some corner would not have been in it.
        corners.arm = SVector::from_fn(|axis, _| {
            let nodes = window.first[axis] - cell[axis];
            (f64::from(nodes) - local[axis]) * grid.spacing()
        });
        Some(corners)
    }

    #[inline(always)]
    fn stencils<L: Lanes>(
        &self,
        _lanes: L,
        grid: &Grid<D>,
        window: &Window<D>,
        x: &[[f64; EIGHT]; D],
        domain: impl Fn(usize) -> SMatrix<f64, D, D>,
    ) -> Self::Stencils {
        let mut stencils = [None; EIGHT];
        for (place, stencil) in stencils.iter_mut().enumerate() {
            let x = SVector::from_fn(|axis, _| x[axis][place]);
            *stencil = self.stencil(grid, window, &x, &domain(place));
        }
        OneByOne(stencils)
    }

    fn reach(&self) -> (i32, i32) {
        (1, 2)
    }

    fn band(&self, spacing: f64) -> Band {
        Band::Uniform(spacing)
    }
}

/// Which side of the centre a corner lies on along each edge.
#[inline]
fn signs<const D: usize>(corner: usize) -> SVector<f64, D> {
    SVector::from_fn(|edge, _| if corner >> edge & 1 == 1 { 1.0 } else { -1.0 })
}

/// Half-edges (in cells) cut along each grid axis so that no corner is farther than one cell from the centre.
#[inline]
fn shortened<const D: usize>(mut edges: SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
    for axis in 0..D {
        let extent = (0..D).map(|edge| edges[(axis, edge)].abs()).sum::<f64>();
        if extent > 1.0 {
            for edge in 0..D {
                edges[(axis, edge)] /= extent;
            }
        }
    }
    edges
}

impl<const D: usize> Corners<D> {
    /// Calls `f(corner, window index, linear weight of the node at the corner)`.
    #[inline]
    fn each(&self, mut f: impl FnMut(usize, usize, f64)) {
        for corner in 0..1 << D {
            let t = &self.locals[corner];
            for node in 0..1_usize << D {
                let mut window = self.bases[corner];
                let mut weight = 1.0;
                for axis in 0..D {
                    let upper = node >> axis & 1;
                    window += upper * Window::<D>::ROW.pow(axis as u32);
                    weight *= if upper == 1 { t[axis] } else { 1.0 - t[axis] };
                }
                f(corner, window, weight);
            }
        }
    }

    const SHARE: f64 = 1.0 / (1_usize << D) as f64;
}

impl<const D: usize> Stencil<D> for Corners<D> {
    #[inline]
    fn visit(&self, mut f: impl FnMut(usize, f64, SVector<f64, D>)) {
        let mut gradients = [SVector::zeros(); MOST_CORNERS];
        for (corner, gradient) in gradients.iter_mut().enumerate().take(1 << D) {
            *gradient = self.rates * signs(corner) * Self::SHARE;
        }
        self.each(|corner, window, weight| {
            f(window, weight * Self::SHARE, gradients[corner] * weight)
        });
    }

    #[inline]
    fn visit_values(&self, mut f: impl FnMut(usize, f64)) {
        self.each(|_, window, weight| f(window, weight * Self::SHARE));
    }

    #[inline]
    fn arm(&self, window: usize) -> SVector<f64, D> {
        let place = Window::<D>::place(window);
        self.arm + SVector::from_fn(|axis, _| place[axis] as f64) * self.spacing
    }
}
