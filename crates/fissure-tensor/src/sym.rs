//! Symmetric second-order tensors.

use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

use serde::{Deserialize, Serialize};

use crate::{Matrix3, Vector3};

/// A symmetric second-order tensor in Mandel form.
///
/// `mandel` holds `xx, yy, zz, √2·yz, √2·xz, √2·xy`, so that `A:B` is a dot product.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[repr(transparent)]
pub struct Sym {
    /// Mandel components.
    pub mandel: [f64; 6],
}

impl Sym {
    /// The zero tensor.
    pub const ZERO: Self = Self { mandel: [0.0; 6] };
    /// The second-order identity.
    pub const IDENTITY: Self = Self {
        mandel: [1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
    };

    /// From tensor components (no factor on the shears).
    #[inline]
    pub fn new(xx: f64, yy: f64, zz: f64, yz: f64, xz: f64, xy: f64) -> Self {
        Self {
            mandel: [xx, yy, zz, SQRT_2 * yz, SQRT_2 * xz, SQRT_2 * xy],
        }
    }

    /// The diagonal tensor with these components.
    #[inline]
    pub fn diagonal(xx: f64, yy: f64, zz: f64) -> Self {
        Self {
            mandel: [xx, yy, zz, 0.0, 0.0, 0.0],
        }
    }

    /// Symmetric part of a matrix.
    #[inline(always)]
    pub fn from_matrix(m: &Matrix3<f64>) -> Self {
        Self {
            mandel: [
                m.m11,
                m.m22,
                m.m33,
                FRAC_1_SQRT_2 * (m.m23 + m.m32),
                FRAC_1_SQRT_2 * (m.m13 + m.m31),
                FRAC_1_SQRT_2 * (m.m12 + m.m21),
            ],
        }
    }

    /// As a full 3×3 matrix.
    #[inline(always)]
    pub fn to_matrix(&self) -> Matrix3<f64> {
        let (yz, xz, xy) = (self.yz(), self.xz(), self.xy());
        Matrix3::new(self.xx(), xy, xz, xy, self.yy(), yz, xz, yz, self.zz())
    }

    /// Component `xx`.
    #[inline(always)]
    pub fn xx(&self) -> f64 {
        self.mandel[0]
    }
    /// Component `yy`.
    #[inline(always)]
    pub fn yy(&self) -> f64 {
        self.mandel[1]
    }
    /// Component `zz`.
    #[inline(always)]
    pub fn zz(&self) -> f64 {
        self.mandel[2]
    }
    /// Tensor component `yz`.
    #[inline(always)]
    pub fn yz(&self) -> f64 {
        FRAC_1_SQRT_2 * self.mandel[3]
    }
    /// Tensor component `xz`.
    #[inline(always)]
    pub fn xz(&self) -> f64 {
        FRAC_1_SQRT_2 * self.mandel[4]
    }
    /// Tensor component `xy`.
    #[inline(always)]
    pub fn xy(&self) -> f64 {
        FRAC_1_SQRT_2 * self.mandel[5]
    }

    /// Sum of the diagonal.
    #[inline(always)]
    pub fn trace(&self) -> f64 {
        self.mandel[0] + self.mandel[1] + self.mandel[2]
    }

    /// Mean of the diagonal; the negative pressure of a stress.
    #[inline(always)]
    pub fn mean(&self) -> f64 {
        self.trace() / 3.0
    }

    /// The tensor less its mean times the identity.
    #[inline(always)]
    pub fn deviator(&self) -> Self {
        *self - Self::IDENTITY * self.mean()
    }

    /// Double contraction `A:B`.
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> f64 {
        let (a, b) = (&self.mandel, &other.mandel);
        (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]) + (a[4] * b[4] + a[5] * b[5])
    }

    /// Frobenius norm `√(A:A)`, free of overflow and underflow.
    pub fn norm(&self) -> f64 {
        let scale = self.max_abs();
        if scale == 0.0 || !scale.is_finite() {
            return scale;
        }
        let scaled = *self / scale;
        scale * scaled.dot(&scaled).sqrt()
    }

    /// Largest absolute Mandel component; NaN if any component is.
    pub fn max_abs(&self) -> f64 {
        self.mandel.iter().fold(0.0, |largest: f64, c| {
            if c.is_nan() || largest.is_nan() {
                f64::NAN
            } else {
                largest.max(c.abs())
            }
        })
    }

    /// Whether every component is finite.
    #[inline(always)]
    pub fn is_finite(&self) -> bool {
        self.mandel.iter().all(|c| c.is_finite())
    }

    /// `n ⊗ n`.
    #[inline]
    pub fn dyad(n: &Vector3<f64>) -> Self {
        Self::new(
            n.x * n.x,
            n.y * n.y,
            n.z * n.z,
            n.y * n.z,
            n.x * n.z,
            n.x * n.y,
        )
    }

    /// Symmetric part of `a ⊗ b`.
    #[inline]
    pub fn dyad_of(a: &Vector3<f64>, b: &Vector3<f64>) -> Self {
        Self::new(
            a.x * b.x,
            a.y * b.y,
            a.z * b.z,
            0.5 * (a.y * b.z + a.z * b.y),
            0.5 * (a.x * b.z + a.z * b.x),
            0.5 * (a.x * b.y + a.y * b.x),
        )
    }

    /// `A·n`: the traction on a plane of normal `n` if `A` is a stress.
    #[inline]
    pub fn traction(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let (yz, xz, xy) = (self.yz(), self.xz(), self.xy());
        Vector3::new(
            self.xx() * n.x + xy * n.y + xz * n.z,
            xy * n.x + self.yy() * n.y + yz * n.z,
            xz * n.x + yz * n.y + self.zz() * n.z,
        )
    }

    /// `n·A·n`.
    #[inline]
    pub fn normal_component(&self, n: &Vector3<f64>) -> f64 {
        n.dot(&self.traction(n))
    }

    /// `M·A·Mᵀ`: a rotation if `M` is orthogonal, a push-forward if it is a deformation gradient.
    #[inline]
    pub fn congruence(&self, m: &Matrix3<f64>) -> Self {
        Self::from_matrix(&(m * self.to_matrix() * m.transpose()))
    }

    /// `Q·A·Qᵀ`: the tensor turned by the rotation `Q`. The congruence under the name it has there;
    /// components on the axes that are the columns of `Q` are `rotated(&Q.transpose())`.
    #[inline]
    pub fn rotated(&self, rotation: &Matrix3<f64>) -> Self {
        self.congruence(rotation)
    }
}
