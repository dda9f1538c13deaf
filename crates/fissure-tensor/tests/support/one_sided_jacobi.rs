//! Singular value decomposition by one-sided Jacobi rotations (Hestenes), the reference for the
//! polar decomposition. nalgebra's own for 3×3 matrices goes through `FᵀF` and loses half of the
//! digits of a graded matrix.

use fissure_tensor::Matrix3;

/// The polar rotation `U·Vᵀ` of `F = U·Σ·Vᵀ`.
pub fn polar_rotation(f: &Matrix3<f64>) -> Matrix3<f64> {
    let mut a = *f;
    let mut v = Matrix3::identity();
    for _ in 0..40 {
        let mut largest: f64 = 0.0;
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let (x, y): ([f64; 3], [f64; 3]) = (
                a.column(p).into_owned().into(),
                a.column(q).into_owned().into(),
            );
            let dot = |s: &[f64; 3], t: &[f64; 3]| s[0] * t[0] + s[1] * t[1] + s[2] * t[2];
            let (alpha, beta, gamma) = (dot(&x, &x), dot(&y, &y), dot(&x, &y));
            let cosine = gamma.abs() / (alpha * beta).sqrt();
            largest = largest.max(cosine);
            if cosine <= 1e-17 {
                continue;
            }
            let zeta = (beta - alpha) / (2.0 * gamma);
            let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let s = c * t;
            for m in [&mut a, &mut v] {
                for i in 0..3 {
                    let (x, y) = (m[(i, p)], m[(i, q)]);
                    m[(i, p)] = c * x - s * y;
                    m[(i, q)] = s * x + c * y;
                }
            }
        }
        if largest <= 1e-16 {
            break;
        }
    }
    for j in 0..3 {
        let length = a.column(j).norm();
        a.column_mut(j).unscale_mut(length);
    }
    a * v.transpose()
}
