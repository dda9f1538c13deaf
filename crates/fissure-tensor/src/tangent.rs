//! Fourth-order tensors with both minor symmetries.

use std::ops::{Add, Mul, Sub};

use crate::{Matrix3, Matrix6, Sym, Vector3, Vector6};

/// A fourth-order tensor with both minor symmetries, as the 6×6 matrix between Mandel components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent(pub Matrix6<f64>);

impl Tangent {
    /// The zero tensor.
    pub fn zero() -> Self {
        Self(Matrix6::zeros())
    }

    /// The identity on symmetric tensors.
    pub fn identity() -> Self {
        Self(Matrix6::identity())
    }

    /// The projection on multiples of the identity, `I⊗I/3`; `3K` times it is the bulk stiffness.
    pub fn volumetric() -> Self {
        Self::dyad(&Sym::IDENTITY, &Sym::IDENTITY) * (1.0 / 3.0)
    }

    /// The projection on deviators; `2G` times it is the shear stiffness.
    pub fn deviatoric() -> Self {
        Self::identity() - Self::volumetric()
    }

    /// The bulk modulus `K` and shear modulus `G` of the isotropic tangent nearest to this one
    /// (Frobenius norm), Pa: `3K = C::P_vol`, `10 G = C::P_dev`.
    pub fn bulk_and_shear(&self) -> (f64, f64) {
        let volumetric = self.0.fixed_view::<3, 3>(0, 0).sum() / 3.0;
        (volumetric / 3.0, (self.0.trace() - volumetric) / 10.0)
    }

    /// The tangent that maps `A` to `M·A·Mᵀ`; orthogonal if `M` is.
    pub fn of_congruence(m: &Matrix3<f64>) -> Self {
        Self::from_columns(|basis| basis.congruence(m))
    }

    /// The double contraction `a:b` of two tangents: first `b`, then `a`.
    pub fn double_contraction(a: &Self, b: &Self) -> Self {
        Self(a.0 * b.0)
    }

    /// The tangent of the turned material, `Q·(C:(Qᵀ·A·Q))·Qᵀ` for every `A`, with `Q` a rotation.
    pub fn rotated(&self, rotation: &Matrix3<f64>) -> Self {
        let turn = Self::of_congruence(rotation).0;
        Self(turn * self.0 * turn.transpose())
    }

    /// The acoustic tensor `Q_ik = n_j C_ijkl n_l` of the direction `normal` (unit, no unit of its
    /// own, so the result has that of `C`). Not symmetric unless `C` has the major symmetry;
    /// singular where a jump of the strain across a plane of that normal is possible.
    pub fn acoustic_tensor(&self, normal: &Vector3<f64>) -> Matrix3<f64> {
        let column = |axis: &Vector3<f64>| self.apply(&Sym::dyad_of(axis, normal)).traction(normal);
        Matrix3::from_columns(&[
            column(&Vector3::x()),
            column(&Vector3::y()),
            column(&Vector3::z()),
        ])
    }

    /// Isotropic elasticity with Lamé's constants, Pa.
    pub fn isotropic(lambda: f64, mu: f64) -> Self {
        let mut m = Matrix6::identity() * (2.0 * mu);
        for i in 0..3 {
            for j in 0..3 {
                m[(i, j)] += lambda;
            }
        }
        Self(m)
    }

    /// The tensor `a ⊗ b`, which maps `x` to `a (b:x)`.
    pub fn dyad(a: &Sym, b: &Sym) -> Self {
        Self(Vector6::from(a.mandel) * Vector6::from(b.mandel).transpose())
    }

    /// The tangent whose columns are its images of the six Mandel basis tensors.
    pub fn from_columns(image: impl Fn(&Sym) -> Sym) -> Self {
        let mut m = Matrix6::zeros();
        for j in 0..6 {
            let mut basis = Sym::ZERO;
            basis.mandel[j] = 1.0;
            m.set_column(j, &Vector6::from(image(&basis).mandel));
        }
        Self(m)
    }

    /// `C : x`.
    #[inline]
    pub fn apply(&self, x: &Sym) -> Sym {
        Sym {
            mandel: (self.0 * Vector6::from(x.mandel)).into(),
        }
    }

    /// Largest absolute entry; NaN if any entry is.
    pub fn max_abs(&self) -> f64 {
        self.0.iter().fold(0.0, |largest: f64, c| {
            if c.is_nan() || largest.is_nan() {
                f64::NAN
            } else {
                largest.max(c.abs())
            }
        })
    }

    /// Part with the major symmetry.
    pub fn symmetric_part(&self) -> Self {
        Self((self.0 + self.0.transpose()) * 0.5)
    }

    /// Whether every entry is finite.
    pub fn is_finite(&self) -> bool {
        self.0.iter().all(|c| c.is_finite())
    }
}

impl Add for Tangent {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self(self.0 + o.0)
    }
}
impl Sub for Tangent {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self(self.0 - o.0)
    }
}
impl Mul<f64> for Tangent {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self(self.0 * s)
    }
}
