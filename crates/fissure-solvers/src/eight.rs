//! Matrices of eight particles at once, and what eight particles give to the nodes.

use std::f64::consts::FRAC_1_SQRT_2;

use fissure_grid::simd::{EIGHT, Lanes, read_columns, read_numbers};
use fissure_grid::{FIELD, Gift};
use fissure_scene::Kinematics;
use fissure_tensor::{Matrix3, Sym};
use nalgebra::{SMatrix, SVector};

use crate::nodes::NodeSums;

/// Three columns of three numbers for eight particles.
pub(crate) type Matrix<Eight> = [[Eight; 3]; 3];

/// The positions of the first eight of these rows, axis by axis; the last one stands in for those that are not there.
#[inline(always)]
pub(crate) fn positions<L: Lanes, const D: usize>(
    lanes: L,
    rows: &[SVector<f64, D>],
) -> [[f64; EIGHT]; D] {
    let mut columns = [lanes.splat(0.0); D];
    read_columns(lanes, rows, &mut columns);
    let mut positions = [[0.0; EIGHT]; D];
    for axis in 0..D {
        lanes.store(columns[axis], &mut positions[axis]);
    }
    positions
}

/// 1.
#[inline(always)]
pub(crate) fn identity<L: Lanes>(lanes: L) -> Matrix<L::Eight> {
    let mut unit = [[lanes.splat(0.0); 3]; 3];
    for (i, column) in unit.iter_mut().enumerate() {
        column[i] = lanes.splat(1.0);
    }
    unit
}

/// The matrices of the first eight of these rows.
#[inline(always)]
pub(crate) fn read_matrices<L: Lanes>(lanes: L, rows: &[Matrix3<f64>]) -> Matrix<L::Eight> {
    let mut columns = [[lanes.splat(0.0); 3]; 3];
    read_columns(lanes, rows, columns.as_flattened_mut());
    columns
}

/// The same of symmetric ones.
#[inline(always)]
pub(crate) fn read_symmetric<L: Lanes>(lanes: L, rows: &[Sym]) -> Matrix<L::Eight> {
    let mut s = [lanes.splat(0.0); 6];
    read_columns(lanes, rows, &mut s);
    for mandel in &mut s[3..] {
        *mandel = lanes.mul(lanes.splat(FRAC_1_SQRT_2), *mandel);
    }
    let [xx, yy, zz, yz, xz, xy] = s;
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// `a b − c d`.
#[inline(always)]
fn minor<L: Lanes>(lanes: L, a: L::Eight, b: L::Eight, c: L::Eight, d: L::Eight) -> L::Eight {
    lanes.sub(lanes.mul(a, b), lanes.mul(c, d))
}

/// Determinants, rounded as those of nalgebra.
#[inline(always)]
pub(crate) fn determinant<L: Lanes>(lanes: L, m: &Matrix<L::Eight>) -> L::Eight {
    let [a, b, c] = m;
    let first = lanes.mul(a[0], minor(lanes, b[1], c[2], b[2], c[1]));
    let second = lanes.mul(b[0], minor(lanes, a[1], c[2], a[2], c[1]));
    let third = lanes.mul(c[0], minor(lanes, a[1], b[2], a[2], b[1]));
    lanes.add(lanes.sub(first, second), third)
}

/// Inverses of the upper left D×D blocks; not finite where there is none.
#[inline(always)]
pub(crate) fn inverse<L: Lanes, const D: usize>(
    lanes: L,
    m: &Matrix<L::Eight>,
) -> Matrix<L::Eight> {
    let one = lanes.splat(1.0);
    let mut unit = identity(lanes);
    unit[..D].copy_from_slice(&m[..D]);
    // Of a block with a unit beside it.
    let [a, b, c] = unit;
    let over = lanes.div(one, determinant(lanes, &unit));
    let mut inverse = [
        [
            minor(lanes, b[1], c[2], b[2], c[1]),
            minor(lanes, c[1], a[2], c[2], a[1]),
            minor(lanes, a[1], b[2], a[2], b[1]),
        ],
        [
            minor(lanes, b[2], c[0], b[0], c[2]),
            minor(lanes, c[2], a[0], c[0], a[2]),
            minor(lanes, a[2], b[0], a[0], b[2]),
        ],
        [
            minor(lanes, b[0], c[1], b[1], c[0]),
            minor(lanes, c[0], a[1], c[1], a[0]),
            minor(lanes, a[0], b[1], a[1], b[0]),
        ],
    ];
    for number in inverse.as_flattened_mut() {
        *number = lanes.mul(*number, over);
    }
    inverse
}

/// What eight particles give to the nodes, component by component.
#[derive(Clone, Copy)]
pub(crate) struct GiftColumns<Eight, const D: usize> {
    value: [Eight; FIELD + 4],
    sloped: [[Eight; FIELD + 4]; D],
}

impl<Eight: Copy, const D: usize> GiftColumns<Eight, D> {
    /// Zeros.
    #[inline(always)]
    pub(crate) fn nothing<L: Lanes<Eight = Eight>>(lanes: L) -> Self {
        let zero = lanes.splat(0.0);
        Self {
            value: [zero; FIELD + 4],
            sloped: [[zero; FIELD + 4]; D],
        }
    }

    /// Masses and momenta.
    #[inline(always)]
    pub(crate) fn momentum<L: Lanes<Eight = Eight>>(
        lanes: L,
        mass: Eight,
        velocity: &[Eight; D],
    ) -> Self {
        let mut gift = Self::nothing(lanes);
        for i in 0..D {
            gift.value[i] = lanes.mul(mass, velocity[i]);
        }
        gift.value[NodeSums::<D>::MASS] = mass;
        gift
    }

    /// Adds the momenta of affine parts.
    #[inline(always)]
    pub(crate) fn add_affine<L: Lanes<Eight = Eight>>(
        &mut self,
        lanes: L,
        mass: Eight,
        affine: &[SMatrix<f64, D, D>],
    ) {
        let mut numbers = [lanes.splat(0.0); 9];
        read_columns(lanes, affine, &mut numbers[..D * D]);
        for j in 0..D {
            for i in 0..D {
                self.sloped[j][i] = lanes.mul(mass, numbers[D * j + i]);
            }
        }
    }

    /// Adds the internal forces of stresses: `−V (σ·∇N + σ_θθ N e_r / r)`, N; with `by_arms`, a factor `D⁻¹`, that times
    /// `N (x_i − x)` in place of `∇N`.
    #[inline(always)]
    pub(crate) fn add_stress<L: Lanes<Eight = Eight>>(
        &mut self,
        lanes: L,
        kinematics: Kinematics,
        stress: &Matrix<Eight>,
        volume: Eight,
        x: &[[f64; EIGHT]; D],
        by_arms: Option<f64>,
    ) {
        let minus = lanes.mul(volume, lanes.splat(-1.0));
        let sloped = lanes.mul(minus, lanes.splat(by_arms.unwrap_or(1.0)));
        for j in 0..D {
            for i in 0..D {
                self.sloped[j][NodeSums::<D>::FORCE + i] = lanes.mul(sloped, stress[j][i]);
            }
        }
        if kinematics == Kinematics::Axisymmetric {
            let force = lanes.div(lanes.mul(minus, stress[2][2]), lanes.load(&x[0]));
            self.value[NodeSums::<D>::FORCE] = force;
        }
    }

    /// Gradients as they are at the end of a step, `f⁻ᵀ·∇N` with `f = F F_old⁻¹`, for those at its start.
    #[cfg(feature = "implicit")]
    #[inline(always)]
    pub(crate) fn move_gradients<L: Lanes<Eight = Eight>>(
        &mut self,
        lanes: L,
        f_old: &Matrix<Eight>,
        f: &Matrix<Eight>,
    ) {
        let back = inverse::<L, 3>(lanes, f);
        let at_start = self.sloped;
        for j in 0..D {
            for number in &mut self.sloped[j] {
                *number = lanes.splat(0.0);
            }
            for k in 0..D {
                // F_old F⁻¹, row j and column k.
                let mut factor = lanes.splat(0.0);
                for m in 0..3 {
                    factor = lanes.mul_add(f_old[m][j], back[k][m], factor);
                }
                for c in 0..FIELD + 4 {
                    let sum = self.sloped[j][c];
                    self.sloped[j][c] = lanes.mul_add(at_start[k][c], factor, sum);
                }
            }
        }
    }

    /// The same particle by particle.
    #[inline(always)]
    pub(crate) fn rows<L: Lanes<Eight = Eight>, const SLOPED: bool>(
        &self,
        lanes: L,
    ) -> [Gift<D>; EIGHT] {
        let mut gifts = [Gift::default(); EIGHT];
        let value = lanes.transpose(self.value);
        for (gift, row) in gifts.iter_mut().zip(value) {
            lanes.store(row, &mut gift.value);
        }
        if SLOPED {
            for axis in 0..D {
                let sloped = lanes.transpose(self.sloped[axis]);
                for (gift, row) in gifts.iter_mut().zip(sloped) {
                    lanes.store(row, &mut gift.sloped[axis]);
                }
            }
        }
        gifts
    }
}

/// Masses and momenta of the first eight particles of these columns.
#[inline(always)]
pub(crate) fn momentum_of<L: Lanes, const D: usize>(
    lanes: L,
    mass: &[f64],
    velocity: &[SVector<f64, D>],
    affine: Option<&[SMatrix<f64, D, D>]>,
) -> GiftColumns<L::Eight, D> {
    let mass = read_numbers(lanes, mass);
    let mut v = [lanes.splat(0.0); D];
    read_columns(lanes, velocity, &mut v);
    let mut gift = GiftColumns::momentum(lanes, mass, &v);
    if let Some(affine) = affine {
        gift.add_affine(lanes, mass, affine);
    }
    gift
}
