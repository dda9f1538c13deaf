//! `U·X + X·U = H`.

#[path = "support/random.rs"]
mod random;

use fissure_tensor::{Sym, Vector3, rotation, solve_lyapunov};
use proptest::prelude::*;
use random::{cases, tensor, turn};

/// Residual over `|U||X|`, in units of round-off.
fn residual(u: &Sym, h: &Sym) -> f64 {
    let x = solve_lyapunov(u, h);
    let product = u.to_matrix() * x.to_matrix();
    (Sym::from_matrix(&(product + product.transpose())) - *h).norm()
        / (u.norm() * x.norm() * f64::EPSILON)
}

proptest! {
    #![proptest_config(cases(10_000))]

    #[test]
    fn general(v in prop::array::uniform3(-4.0..0.0), q in turn(), h in tensor()) {
        let v = v.map(|x: f64| 10f64.powf(x));
        let u = Sym::diagonal(v[0], v[1], v[2]).congruence(&q);
        let r = residual(&u, &h);
        prop_assert!(r <= 20.0, "{r}");
    }

    #[test]
    fn plane(v in prop::array::uniform3(-4.0..0.0), angle in -3.2..3.2, h in tensor(), mixed in prop::bool::ANY) {
        let v = v.map(|x: f64| 10f64.powf(x));
        let q = rotation(&Vector3::z(), angle);
        let u = Sym::diagonal(v[0], v[1], v[2]).congruence(&q);
        let u = Sym::new(u.xx(), u.yy(), u.zz(), 0.0, 0.0, u.xy());
        let h = if mixed { h } else { Sym::new(h.xx(), h.yy(), h.zz(), 0.0, 0.0, h.xy()) };
        let r = residual(&u, &h);
        prop_assert!(r <= 20.0, "{r}");
        let x = solve_lyapunov(&u, &h);
        if !mixed {
            prop_assert!(x.yz() == 0.0 && x.xz() == 0.0);
        }
        // Both branches are the same function.
        let q = rotation(&Vector3::new(1.0, 0.4, -0.3), 0.9);
        let turned = solve_lyapunov(&u.congruence(&q), &h.congruence(&q)).congruence(&q.transpose());
        let condition = u.norm() / u.eigenvalues()[2];
        prop_assert!((turned - x).norm() <= 4e-15 * condition * x.norm());
    }

    #[test]
    fn known_solutions(x in tensor(), c in tensor()) {
        let u = Sym::IDENTITY * 3.0 + c;
        prop_assume!(u.eigenvalues()[2] > 0.5);
        let product = u.to_matrix() * x.to_matrix();
        let h = Sym::from_matrix(&(product + product.transpose()));
        prop_assert!((solve_lyapunov(&u, &h) - x).norm() <= 4e-14 * x.norm().max(0.01));
        prop_assert!((solve_lyapunov(&u, &(u * 2.0)) - Sym::IDENTITY).norm() <= 1e-13);
    }
}
