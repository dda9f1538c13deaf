//! Polar decomposition against a singular value decomposition.

#[path = "support/one_sided_jacobi.rs"]
mod one_sided_jacobi;
#[path = "support/random.rs"]
mod random;

use fissure_tensor::{Matrix3, Sym, Vector3, polar, rotation};
use one_sided_jacobi::polar_rotation;
use proptest::prelude::*;
use random::{cases, turn};

/// Deviations, in units of round-off: of `R` from orthogonality, of `R·U` from `F` and of `RᵀF`
/// from symmetry, the latter relative to `F`.
fn defects(f: &Matrix3<f64>) -> [f64; 3] {
    let p = polar(f).expect("admissible");
    let r = p.rotation;
    let scale = f.norm();
    let m = r.transpose() * f;
    [
        (r.transpose() * r - Matrix3::identity()).norm() / f64::EPSILON,
        (r * p.stretch.to_matrix() - f).norm() / scale / f64::EPSILON,
        (m - m.transpose()).norm() / scale / f64::EPSILON,
    ]
}

fn graded() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-6.0..0.0).prop_map(|e: [f64; 3]| e.map(|x| 10f64.powf(x)))
}

proptest! {
    #![proptest_config(cases(10_000))]

    #[test]
    fn factors_of_any_gradient(c in prop::array::uniform9(-1.0..1.0)) {
        let mut f = Matrix3::from_row_slice(&c);
        if f.determinant() < 0.0 {
            f = -f;
        }
        let norm: f64 = f.norm();
        let condition = norm.powi(3) / f.determinant();
        prop_assume!(condition < 1e6);
        let [orthogonality, product, symmetry] = defects(&f);
        prop_assert!(orthogonality <= 10.0 && product <= 20.0 && symmetry <= 20.0, "{orthogonality} {product} {symmetry}");
        prop_assert!(polar(&f).unwrap().rotation.determinant() > 0.0);
        prop_assert!(polar(&f).unwrap().stretch.eigenvalues()[2] > 0.0);
    }

    #[test]
    fn near_the_identity(c in prop::array::uniform9(-1.0..1.0), k in -16..0) {
        let h = Matrix3::from_row_slice(&c) * (0.3 * 10f64.powi(k));
        let [orthogonality, product, symmetry] = defects(&(Matrix3::identity() + h));
        prop_assert!(orthogonality <= 10.0 && product <= 10.0 && symmetry <= 10.0, "{orthogonality} {product} {symmetry}");
    }

    #[test]
    fn known_factors_up_to_a_million(v in graded(), q in turn(), r in turn()) {
        let stretch = Sym::diagonal(v[0], v[1], v[2]).congruence(&q);
        let f = r * stretch.to_matrix();
        let mut sorted = v;
        sorted.sort_by(|a, b| b.total_cmp(a));
        prop_assume!(f.determinant() > 0.0);
        let [orthogonality, product, symmetry] = defects(&f);
        let p = polar(&f).unwrap();
        prop_assert!(orthogonality <= 10.0 && product <= 20.0 && symmetry <= 20.0, "{orthogonality} {product} {symmetry}");
        // No method can do better than the sensitivity of the problem.
        let sensitivity = sorted[0] / (sorted[1] + sorted[2]);
        prop_assert!((p.rotation - r).norm() <= 1e-14 * (1.0 + 0.2 * sensitivity));
        prop_assert!((p.stretch - stretch).norm() <= 1e-14 * stretch.norm() );

        let reference = polar_rotation(&f);
        prop_assert!((p.rotation - reference).norm() <= 1e-14 * (1.0 + 0.2 * sensitivity));
    }

    #[test]
    fn plane_gradients(c in prop::array::uniform4(-1.0..1.0), out in 0.1..2.0) {
        let mut f = Matrix3::new(c[0], c[1], 0.0, c[2], c[3], 0.0, 0.0, 0.0, out);
        if f.determinant() < 0.0 {
            f *= Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
        }
        prop_assume!(f.determinant() > 1e-6);
        let [orthogonality, product, symmetry] = defects(&f);
        prop_assert!(orthogonality <= 10.0 && product <= 10.0 && symmetry <= 10.0);
        let reference = polar_rotation(&f);
        let sensitivity = f.norm_squared() / f.determinant();
        prop_assert!((polar(&f).unwrap().rotation - reference).norm() <= 1e-14 * (1.0 + 0.2 * sensitivity));
        // The general path agrees with the plane one on the same gradient seen from turned axes.
        let q = rotation(&Vector3::new(1.0, -2.0, 0.5), 0.7);
        let turned = polar(&(q * f * q.transpose())).unwrap();
        prop_assert!((turned.stretch - polar(&f).unwrap().stretch.rotated(&q)).norm() <= 1e-14 * f.norm());
    }

    #[test]
    fn objective(c in prop::array::uniform9(-1.0..1.0), q in turn()) {
        let f = Matrix3::identity() + Matrix3::from_row_slice(&c) * 0.4;
        prop_assume!(f.determinant() > 1e-2);
        let (p, turned) = (polar(&f).unwrap(), polar(&(q * f)).unwrap());
        prop_assert!((turned.stretch - p.stretch).norm() <= 1e-14 * f.norm());
        prop_assert!((turned.rotation - q * p.rotation).norm() <= 2e-13);
    }
}

#[test]
fn worst_defects_over_many_gradients() {
    let mut next = random::sequence(7);
    let mut worst = [0.0_f64; 3];
    for _ in 0..100_000 {
        let v: [f64; 3] = std::array::from_fn(|_| 10f64.powf(3.0 * (next() - 1.0)));
        let mut turn = || rotation(&Vector3::new(next(), next(), next()), 3.0 * next());
        let f = turn() * Matrix3::from_diagonal(&Vector3::from(v)) * turn();
        for (slot, value) in worst.iter_mut().zip(defects(&f)) {
            *slot = if value.is_nan() {
                value
            } else {
                slot.max(value)
            };
        }
    }
    println!("orthogonality, R·U - F, asymmetry of RᵀF (eps): {worst:.2?}");
    assert!(worst.iter().all(|w| *w <= 30.0));
}

#[test]
fn inadmissible_gradients_have_no_factors() {
    for f in [
        Matrix3::zeros(),
        -Matrix3::identity(),
        Matrix3::repeat(1.0),
        Matrix3::repeat(f64::NAN),
        Matrix3::identity() * f64::INFINITY,
        Matrix3::identity() * f64::NAN,
        Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0)),
        Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0)),
    ] {
        assert!(polar(&f).is_none(), "{f}");
    }
    // Half a turn about x with positive determinant, which is not plane for its negative F33.
    let half = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
    assert_eq!(polar(&half).unwrap().rotation, half);
}

#[test]
fn any_magnitude() {
    let f = Matrix3::new(1.0, 0.2, -0.1, 0.3, 0.9, 0.2, 0.1, -0.2, 1.1);
    let p = polar(&f).unwrap();
    for k in [-900, -300, 300, 1000] {
        let scaled = polar(&(f * 2f64.powi(k))).unwrap();
        assert_eq!(scaled.rotation, p.rotation);
        assert_eq!(scaled.stretch, p.stretch * 2f64.powi(k));
    }
}
