//! Fourth-order tensors with both minor symmetries.

use std::ops::{Add, Mul, Sub};

use crate::{Matrix6, Sym, Vector6};

/// A fourth-order tensor with both minor symmetries, as the 6×6 matrix between Mandel components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent(pub Matrix6<f64>);

impl Tangent {
    /// The zero tensor.
    pub fn zero() -> Self {
        Self(Matrix6::zeros())
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
