//! Cyclic Jacobi rotations: the iterative reference for the closed-form spectral decomposition.

use fissure_tensor::{Matrix3, Sym, Vector3};

/// Eigenvalues in descending order and unit eigenvectors of a tensor of magnitude near one.
pub fn jacobi(tensor: &Sym) -> ([f64; 3], [Vector3<f64>; 3]) {
    let mut a = tensor.to_matrix();
    let mut v = Matrix3::identity();
    for _ in 0..30 {
        let off = a.m12 * a.m12 + a.m13 * a.m13 + a.m23 * a.m23;
        if off == 0.0 {
            break;
        }
        for (p, q, r) in [(0, 1, 2), (0, 2, 1), (1, 2, 0)] {
            let shear = a[(p, q)];
            if shear == 0.0 {
                continue;
            }
            let theta = (a[(q, q)] - a[(p, p)]) / (2.0 * shear);
            let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let s = t * c;
            // Updates as increments, which lose less than the triple product does.
            a[(p, p)] -= t * shear;
            a[(q, q)] += t * shear;
            let (x, y) = (a[(p, r)], a[(q, r)]);
            let (x, y) = (c * x - s * y, s * x + c * y);
            (a[(p, r)], a[(r, p)]) = (x, x);
            (a[(q, r)], a[(r, q)]) = (y, y);
            (a[(p, q)], a[(q, p)]) = (0.0, 0.0);
            for i in 0..3 {
                let (x, y) = (v[(i, p)], v[(i, q)]);
                v[(i, p)] = c * x - s * y;
                v[(i, q)] = s * x + c * y;
            }
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[(j, j)].total_cmp(&a[(i, i)]));
    let n0: Vector3<f64> = v.column(order[0]).into();
    let n1: Vector3<f64> = v.column(order[1]).into();
    (order.map(|i| a[(i, i)]), [n0, n1, n0.cross(&n1)])
}
