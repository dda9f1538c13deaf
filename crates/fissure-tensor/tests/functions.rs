//! Exponential, logarithm, square root, inverse, signed parts.

#[path = "support/random.rs"]
mod random;

use fissure_tensor::{Matrix3, Sym, Vector3, exponential, rotation};
use proptest::prelude::*;
use random::{cases, tensor, turn};

proptest! {
    #![proptest_config(cases(2_000))]

    #[test]
    fn logarithm_undoes_the_exponential(a in tensor(), size in 1e-3..6.0) {
        let a = a * size;
        let back = a.exp().log().unwrap();
        // The small eigenvalues of exp(a) are known to round-off of the largest.
        let spread = (a.eigenvalues()[0] - a.eigenvalues()[2]).exp();
        prop_assert!((back - a).norm() <= 1e-15 * (20.0 * (1.0 + a.norm()) + 4.0 * spread));
        prop_assert!((a.exp_minus_one() + Sym::IDENTITY - a.exp()).norm() <= 1e-14 * (1.0 + a.exp().norm()));
    }

    #[test]
    fn small_strains_keep_their_digits(a in tensor(), k in -300..-3) {
        let e = a * 10f64.powi(k);
        // log(1+e) = e - e²/2 + e³/3 - …, exp(e) - 1 = e + e²/2 + e³/6 + …
        let m = a.to_matrix();
        let (square, cube) = (Sym::from_matrix(&(m * m)), Sym::from_matrix(&(m * m * m)));
        let step = 10f64.powi(k);
        let error = 4.0 * step.powi(3) * a.norm().powi(3) + 1e-15 * 4.0;
        let log = e.log_of_one_plus().unwrap() / step;
        prop_assert!((log - (a - square * (step / 2.0) + cube * (step * step / 3.0))).norm() <= error * a.norm());
        let exp = e.exp_minus_one() / step;
        prop_assert!((exp - (a + square * (step / 2.0) + cube * (step * step / 6.0))).norm() <= error * a.norm());
    }

    #[test]
    fn hencky_strain_of_tiny_stretches(v in prop::array::uniform3(-1.0..1.0), q in turn(), r in turn()) {
        // ln U = Q·diag(v)·Qᵀ exactly; H = R·U - I is formed without cancellation for R = I only,
        // so the rotation enters through E = (U² - I)/2, on which it has no effect.
        let hencky = Sym::diagonal(v[0], v[1], v[2]).congruence(&q) * 1e-12;
        prop_assume!(hencky.norm() > 0.0);
        let h = hencky.exp_minus_one().to_matrix();
        let twice = h + h.transpose() + h.transpose() * r.transpose() * r * h;
        let found = Sym::from_matrix(&twice).log_of_one_plus().unwrap() * 0.5;
        prop_assert!((found - hencky).norm() <= 4e-15 * hencky.norm());
    }

    #[test]
    fn logarithm_near_the_identity_is_that_of_the_difference(a in tensor(), k in -16..-1) {
        let near = Sym::IDENTITY + a * (0.3 * 10f64.powi(k));
        let difference = near - Sym::IDENTITY;
        prop_assert_eq!(near.log(), difference.log_of_one_plus());
        // To the relative accuracy of the difference, not of one.
        let log = near.log().unwrap();
        prop_assert!((log - difference).norm() <= difference.norm() * (difference.norm() + 4e-15));
    }

    #[test]
    fn square_root_and_inverse(v in prop::array::uniform3(-8.0..0.0), q in turn(), signs in prop::array::uniform3(prop::bool::ANY), k in -140..140) {
        let v = v.map(|x: f64| 10f64.powf(x));
        let scale = 10f64.powi(k);
        let a = Sym::diagonal(v[0], v[1], v[2]).congruence(&q) * scale;
        let root = a.sqrt().unwrap();
        let square = Sym::from_matrix(&(root.to_matrix() / scale.sqrt()).pow(2));
        prop_assert!((square - a / scale).norm() <= 4e-15 * a.norm() / scale);

        let indefinite: [f64; 3] = std::array::from_fn(|i| if signs[i] { v[i] } else { -v[i] });
        let [x, y, z] = indefinite;
        let a = Sym::diagonal(x, y, z).congruence(&q) * scale;
        let inverse = a.inverse().unwrap();
        let exact = Sym::diagonal(1.0 / x, 1.0 / y, 1.0 / z).congruence(&q) / scale;
        let condition = a.norm() * exact.norm();
        prop_assert!((inverse - exact).norm() <= 4e-16 * (4.0 + condition) * exact.norm());
    }

    #[test]
    fn signed_parts(a in tensor()) {
        let (plus, minus) = (a.positive_part(), a.negative_part());
        prop_assert!((plus + minus - a).norm() <= 1e-15);
        prop_assert!(plus.dot(&minus).abs() <= 1e-14);
        prop_assert!(plus.eigenvalues()[2] >= -4e-15 && minus.eigenvalues()[0] <= 4e-15);
        prop_assert_eq!((a + Sym::IDENTITY * 9.0).positive_part(), a + Sym::IDENTITY * 9.0);
        prop_assert_eq!((a - Sym::IDENTITY * 9.0).positive_part(), Sym::ZERO);
    }

    #[test]
    fn general_exponential(c in prop::array::uniform9(-1.0..1.0), size in 1e-8..20.0) {
        let a = Matrix3::from_row_slice(&c) * size;
        let e = exponential(&a);
        // Inverse, halves and determinant; the bounds follow the growth of the squarings.
        let half = exponential(&(a * 0.5));
        let norm: f64 = half.norm();
        prop_assert!((half * half - e).norm() <= 1e-14 * (1.0 + size) * norm * norm);
        let back = exponential(&(-a));
        prop_assert!((e * back - Matrix3::identity()).norm() <= 1e-14 * (1.0 + size) * e.norm() * back.norm());
        prop_assert!((exponential(&a.transpose()) - e.transpose()).norm() <= 1e-14 * (1.0 + size) * norm * norm);
        prop_assert!((e - a.exp()).norm() <= 1e-13 * (1.0 + size) * norm * norm);
    }

    #[test]
    fn exponential_of_symmetric_and_skew(a in tensor(), size in 1e-6..10.0, n in prop::array::uniform3(-3.0..3.0)) {
        let a = a * size;
        prop_assert!((exponential(&a.to_matrix()) - a.exp().to_matrix()).norm() <= 1e-14 * (1.0 + size) * a.exp().norm());
        let n = Vector3::from(n);
        prop_assert!((exponential(&n.cross_matrix()) - rotation(&n, n.norm())).norm() <= 4e-14);
    }
}

#[test]
fn exponential_of_a_jordan_block() {
    let a = Matrix3::new(-0.5, 1.0, 0.0, 0.0, -0.5, 1.0, 0.0, 0.0, -0.5);
    let exact = Matrix3::new(1.0, 1.0, 0.5, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0) * (-0.5_f64).exp();
    assert!((exponential(&a) - exact).norm() <= 1e-15 * 4.0);
    assert_eq!(exponential(&Matrix3::zeros()), Matrix3::identity());
}

#[test]
fn what_has_no_value_has_none() {
    let singular = Sym::diagonal(1.0, 2.0, 0.0);
    assert!(singular.log().is_none() && singular.inverse().is_none());
    assert!(singular.sqrt().is_some());
    assert!(Sym::diagonal(1.0, 2.0, -1e-3).sqrt().is_none());
    assert!(Sym::diagonal(0.0, 0.0, -1.0).log_of_one_plus().is_none());
    assert!(Sym::ZERO.inverse().is_none());
    for bad in [f64::NAN, f64::INFINITY] {
        for position in 0..6 {
            let mut a = Sym::IDENTITY;
            a.mandel[position] = bad;
            assert!(
                a.log().is_none() && a.sqrt().is_none() && a.inverse().is_none(),
                "{a:?}"
            );
            assert!(a.log_of_one_plus().is_none());
            assert!(!a.positive_part().is_finite(), "{a:?}");
            assert!(!exponential(&a.to_matrix()).iter().all(|c| c.is_finite()));
        }
    }
}
