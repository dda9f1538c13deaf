//! Eigenvalues and eigenvectors of symmetric tensors.

use crate::{Matrix3, Sym, Vector3};

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
    /// Spectral decomposition by Jacobi rotations.
    pub fn spectrum(&self) -> Spectrum {
        let mut a = self.to_matrix();
        let mut v = Matrix3::identity();
        for _ in 0..30 {
            let off = a.m12 * a.m12 + a.m13 * a.m13 + a.m23 * a.m23;
            if off == 0.0 {
                break;
            }
            for (p, q) in [(0, 1), (0, 2), (1, 2)] {
                if a[(p, q)] == 0.0 {
                    continue;
                }
                let theta = (a[(q, q)] - a[(p, p)]) / (2.0 * a[(p, q)]);
                let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
                let c = 1.0 / t.hypot(1.0);
                let s = t * c;
                let mut g = Matrix3::identity();
                g[(p, p)] = c;
                g[(q, q)] = c;
                g[(p, q)] = s;
                g[(q, p)] = -s;
                a = g.transpose() * a * g;
                a[(p, q)] = 0.0;
                a[(q, p)] = 0.0;
                v *= g;
            }
        }
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| a[(j, j)].total_cmp(&a[(i, i)]));
        let n0: Vector3<f64> = v.column(order[0]).into();
        let n1: Vector3<f64> = v.column(order[1]).into();
        Spectrum {
            values: order.map(|i| a[(i, i)]),
            vectors: [n0, n1, n0.cross(&n1)],
        }
    }
}
