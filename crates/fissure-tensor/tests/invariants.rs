//! Invariants, rotations and the tangent operations.

#[path = "support/random.rs"]
mod random;

use std::f64::consts::{FRAC_PI_3, FRAC_PI_6};

use fissure_tensor::{Matrix3, Matrix6, Sym, Tangent, Vector3, rotation_between};
use proptest::prelude::*;
use random::{cases, direction, tensor, turn};

fn tangent() -> impl Strategy<Value = Tangent> {
    prop::collection::vec(-1.0..1.0, 36).prop_map(|c| Tangent(Matrix6::from_row_slice(&c)))
}

proptest! {
    #![proptest_config(cases(2_000))]

    #[test]
    fn invariants_of_the_eigenvalues(a in tensor(), q in turn()) {
        let [x, y, z] = a.eigenvalues();
        prop_assert!((a.i2() - (x * y + y * z + z * x)).abs() <= 1e-14);
        prop_assert!((a.i3() - x * y * z).abs() <= 1e-14);
        prop_assert!((a.i2() - 0.5 * (a.trace().powi(2) - a.dot(&a))).abs() <= 1e-14);
        prop_assert!((a.j2() - (a.trace().powi(2) / 3.0 - a.i2())).abs() <= 1e-14);
        let turned = a.rotated(&q);
        prop_assert!((turned.i2() - a.i2()).abs() <= 1e-14);
        prop_assert!((turned.i3() - a.i3()).abs() <= 1e-14);
        prop_assert!((turned.rotated(&q.transpose()) - a).norm() <= 1e-14);
    }

    #[test]
    fn lode_angle_of_its_definition(a in tensor(), q in turn()) {
        prop_assume!(a.j2() > 1e-3);
        let angle = a.lode_angle();
        prop_assert!((0.0..=FRAC_PI_3).contains(&angle));
        let cosine = 1.5 * 3f64.sqrt() * a.j3() / a.j2().powf(1.5);
        prop_assert!(((3.0 * angle).cos() - cosine).abs() <= 1e-12);
        prop_assert!((a.rotated(&q).lode_angle() - angle).abs() <= 1e-12);
        prop_assert!(((-a).lode_angle() - (FRAC_PI_3 - angle)).abs() <= 1e-12);
        prop_assert!(((a * 7.0 + Sym::IDENTITY).lode_angle() - angle).abs() <= 1e-12);
        // s = 2√(J₂/3) (cos θ, cos(θ - 2π/3), cos(θ + 2π/3)).
        let radius = 2.0 * (a.j2() / 3.0).sqrt();
        prop_assert!((a.mean() + radius * angle.cos() - a.eigenvalues()[0]).abs() <= 1e-13);
        prop_assert!((a.mean() + radius * (angle + 2.0 * FRAC_PI_3).cos() - a.eigenvalues()[2]).abs() <= 1e-13);
    }

    #[test]
    fn turned_tangent(c in tangent(), a in tensor(), q in turn()) {
        let direct = c.apply(&a.rotated(&q.transpose())).rotated(&q);
        prop_assert!((c.rotated(&q).apply(&a) - direct).norm() <= 4e-14);
        let turn = Tangent::of_congruence(&q);
        prop_assert!((turn.apply(&a) - a.rotated(&q)).norm() <= 1e-14);
        prop_assert!((turn.0 * turn.0.transpose() - Matrix6::identity()).norm() <= 1e-14);
    }

    #[test]
    fn contraction_is_composition(b in tangent(), c in tangent(), a in tensor()) {
        let both = Tangent::double_contraction(&b, &c).apply(&a);
        prop_assert!((both - b.apply(&c.apply(&a))).norm() <= 4e-14);
        prop_assert_eq!(Tangent::double_contraction(&Tangent::identity(), &c), c);
    }

    #[test]
    fn projections(k in 0.1..10.0_f64, g in 0.1..10.0_f64, a in tensor(), q in turn()) {
        let (volumetric, deviatoric) = (Tangent::volumetric(), Tangent::deviatoric());
        prop_assert!((volumetric.apply(&a) - Sym::IDENTITY * a.mean()).norm() <= 1e-15 * 4.0);
        prop_assert!((deviatoric.apply(&a) - a.deviator()).norm() <= 1e-15 * 4.0);
        let stiffness = Tangent::isotropic(k - 2.0 / 3.0 * g, g);
        let built = volumetric * (3.0 * k) + deviatoric * (2.0 * g);
        prop_assert!((stiffness - built).max_abs() <= 1e-14 * 40.0);
        let (bulk, shear) = stiffness.bulk_and_shear();
        prop_assert!((bulk - k).abs() <= 1e-13 && (shear - g).abs() <= 1e-13);
        prop_assert!((stiffness.rotated(&q) - stiffness).max_abs() <= 1e-12);
    }

    #[test]
    fn acoustic_tensor(c in tangent(), n in direction(), m in prop::array::uniform3(-1.0..1.0), l in prop::array::uniform3(-1.0..1.0), q in turn()) {
        let (m, l) = (Vector3::from(m), Vector3::from(l));
        let acoustic = c.acoustic_tensor(&n);
        // l·Q·m = (l⊗n) : C : (m⊗n).
        let direct = Sym::dyad_of(&l, &n).dot(&c.apply(&Sym::dyad_of(&m, &n)));
        prop_assert!((l.dot(&(acoustic * m)) - direct).abs() <= 2e-14);
        let turned = c.rotated(&q).acoustic_tensor(&(q * n));
        prop_assert!((turned - q * acoustic * q.transpose()).norm() <= 4e-14);
        // Isotropic: μ across, λ + 2μ along.
        let isotropic = Tangent::isotropic(1.3, 0.7).acoustic_tensor(&n);
        let exact = Matrix3::identity() * 0.7 + n * n.transpose() * 2.0;
        prop_assert!((isotropic - exact).norm() <= 1e-14);
    }

    #[test]
    fn smallest_rotation(from in direction(), across in direction(), k in -18..1, opposite in prop::bool::ANY) {
        let base = if opposite { -from } else { from };
        let to = (base + across * 10f64.powi(k)).normalize();
        let r = rotation_between(&from, &to);
        prop_assert!((r * from - to).norm() <= 4e-15);
        prop_assert!((r.transpose() * r - Matrix3::identity()).norm() <= 4e-15);
        prop_assert!((r.determinant() - 1.0).abs() <= 4e-15);
        // tr R = 1 + 2 cos of the angle between the vectors: no other turn is mixed in.
        prop_assert!((r.trace() - 1.0 - 2.0 * from.dot(&to)).abs() <= 4e-15);
    }
}

#[test]
fn lode_angle_on_the_meridians() {
    assert_eq!(Sym::diagonal(1.0, 0.0, 0.0).lode_angle(), 0.0);
    assert!((Sym::diagonal(-1.0, 0.0, 0.0).lode_angle() - FRAC_PI_3).abs() <= 1e-15);
    assert!((Sym::new(0.0, 0.0, 0.0, 0.0, 0.0, 1.0).lode_angle() - FRAC_PI_6).abs() <= 1e-15);
    assert_eq!((Sym::IDENTITY * 5.0).lode_angle(), 0.0);
    assert!(Sym::diagonal(f64::NAN, 0.0, 0.0).lode_angle().is_nan());
    // Near a meridian the angle itself is small and still right: an arc cosine would give zero.
    let near = Sym::diagonal(1.0, 1e-12, 0.0).lode_angle();
    assert!((near / (3f64.sqrt() * 0.5e-12) - 1.0).abs() <= 1e-9);
}
