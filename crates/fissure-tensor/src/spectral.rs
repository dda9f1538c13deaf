//! Eigenvalues and eigenvectors of symmetric tensors.

use crate::{Matrix3, Sym, Vector3, eigen};

/// Eigenvalues in descending order with a right-handed orthonormal set of eigenvectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// Eigenvalues, largest first.
    pub values: [f64; 3],
    /// Unit eigenvectors in the same order.
    pub vectors: [Vector3<f64>; 3],
}

impl Spectrum {
    /// The rotation whose columns are the eigenvectors.
    pub fn basis(&self) -> Matrix3<f64> {
        Matrix3::from_columns(&self.vectors)
    }

    /// `Σ g(λ_i) n_i ⊗ n_i`.
    pub fn map(&self, g: impl Fn(f64) -> f64) -> Sym {
        (0..3)
            .map(|i| Sym::dyad(&self.vectors[i]) * g(self.values[i]))
            .sum()
    }
}

impl Sym {
    /// Spectral decomposition in closed form, as accurate as an iterative one.
    ///
    /// Residuals `|A·n - λn|`, the orthonormality of the vectors and the eigenvalues are within four
    /// units of round-off (of the Frobenius norm), whatever the gaps between eigenvalues, at every
    /// magnitude. Scaling the tensor by a power of two scales the eigenvalues by it exactly and
    /// leaves the vectors as they are. A NaN or infinite component makes
    /// eigenvalues NaN or infinite: all of them but for `zz` beside a bad in-plane block.
    ///
    /// Any orthonormal set of the eigenspace solves the problem where eigenvalues coincide. What is
    /// returned then depends on the components only, never on chance: a multiple of the identity
    /// has `x, y, z`; a tensor without out-of-plane shear (`yz = xz = 0`) keeps `z` apart, puts it
    /// after those it ties with and, if the in-plane pair is equal, has `x` before `y`; any other
    /// pair is framed by a fixed formula about the third vector. Nothing is continuous there.
    ///
    /// A tensor without out-of-plane shear takes the 2×2 closed form, some five times faster.
    #[inline]
    pub fn spectrum(&self) -> Spectrum {
        eigen::spectrum(self)
    }

    /// The eigenvalues, largest first: those of [`Sym::spectrum`] to the last bit, in less time.
    #[inline]
    pub fn eigenvalues(&self) -> [f64; 3] {
        eigen::eigenvalues(self)
    }
}
