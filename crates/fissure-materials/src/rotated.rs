//! Small-strain laws at large rotation: Biot's strain with the stress turned as it is.
//!
//! With `F = R·U` the strain is `E = U − 1` and the Cauchy stress `R·T·Rᵀ` [Nairn 2017, app. II].
//! Unlike [`Biot::cauchy`] it leaves out the factors of stretch between `T` and the Cauchy stress,
//! so that energy and work agree to first order in the strain.

use fissure_tensor::{Matrix3, Sym, Tangent, solve_lyapunov};

use crate::Biot;

/// `√(1 + x) − 1 = Σ c_k x^k`, from `c_1`.
const ROOT: [f64; 16] = [
    0.5,
    -0.125,
    0.0625,
    -0.039_062_5,
    0.027_343_75,
    -0.020_507_812_5,
    0.016_113_281_25,
    -0.013_092_041_015_625,
    0.010_910_034_179_687_5,
    -0.009_273_529_052_734_375,
    0.008_008_956_909_179_688,
    -0.007_007_837_295_532_227,
    0.006_199_240_684_509_277,
    -0.005_535_036_325_454_712,
    0.004_981_532_692_909_241,
    -0.004_514_514_002_948_999,
];

/// The left stretch less one, `V − 1 = R·(U − 1)·Rᵀ`, without a polar decomposition: of use to an
/// isotropic law, whose Cauchy stress it gives at once. `None` where `|F·Fᵀ − 1|` is over 0.1, or
/// `F` turns space inside out.
///
/// The binomial series of the root of `1 + A`, `A = F·Fᵀ − 1`, by Horner's rule with the powers of
/// `A` reduced by Cayley and Hamilton, is cut off where the terms are below round-off.
#[inline]
pub(crate) fn left_strain(f: &Matrix3<f64>) -> Option<Sym> {
    let h = f - Matrix3::identity();
    let a = Sym::from_matrix(&h) * 2.0 + Sym::from_matrix(&(h * h.transpose()));
    let squared = a.dot(&a);
    let terms = if squared <= 1e-6 {
        6
    } else if squared <= 1e-4 {
        9
    } else if squared <= 1e-2 {
        16
    } else {
        return None; // also where anything is NaN
    };
    if !(f.determinant() > 0.0) {
        return None;
    }
    let square = square(&a);
    let first = a.trace();
    let second = 0.5 * (first * first - squared);
    let third = a.determinant();
    let (mut p, mut q, mut r) = (ROOT[terms - 1], 0.0, 0.0);
    for c in ROOT[..terms - 1].iter().rev() {
        (p, q, r) = (c + third * r, p - second * r, q + first * r);
    }
    Some(Sym::IDENTITY * (third * r) + a * (p - second * r) + square * (q + first * r))
}

/// `A·A`.
#[inline]
fn square(a: &Sym) -> Sym {
    let (xx, yy, zz) = (a.xx(), a.yy(), a.zz());
    let (yz, xz, xy) = (a.yz(), a.xz(), a.xy());
    Sym::new(
        xx * xx + xy * xy + xz * xz,
        xy * xy + yy * yy + yz * yz,
        xz * xz + yz * yz + zz * zz,
        xy * xz + yy * yz + yz * zz,
        xx * xz + xy * yz + xz * zz,
        xx * xy + xy * yy + xz * yz,
    )
}

impl Biot {
    /// The stress `T` turned into space, `R·T·Rᵀ`.
    pub(crate) fn turned(&self, stress: &Sym) -> Sym {
        stress.rotated(&self.rotation)
    }

    /// Rates of strain and rotation for `F → (1 + d) F`: `U̇` from `U·U̇ + U̇·U = 2 Fᵀ·d·F`, and
    /// `Ṙ = (d·F − R·U̇)·U⁻¹`.
    pub(crate) fn rates(&self, d: &Sym) -> (Sym, Matrix3<f64>) {
        let f = &self.deformation_gradient;
        let strain_rate = d.congruence(&f.transpose()) * 2.0;
        let stretch_rate = solve_lyapunov(&self.stretch, &strain_rate);
        // U is positive definite.
        let inverse = self.stretch.inverse().map(|u| u.to_matrix());
        let rotation_rate = (d.to_matrix() * f - self.rotation * stretch_rate.to_matrix())
            * inverse.unwrap_or_else(Matrix3::zeros);
        (stretch_rate, rotation_rate)
    }

    /// Spatial tangent of the Cauchy stress `R·T·Rᵀ` from the rate of `T` with the motion,
    /// given the rates of strain and rotation.
    pub(crate) fn turned_tangent(
        &self,
        stress: &Sym,
        rate: impl Fn(&Sym, &Matrix3<f64>) -> Sym,
    ) -> Tangent {
        let spatial = self.turned(stress);
        let matrix = spatial.to_matrix();
        Tangent::from_columns(|d| {
            let (stretch_rate, rotation_rate) = self.rates(d);
            let spin = rotation_rate * self.rotation.transpose();
            // δσ = w·σ − σ·w + R·δT·Rᵀ; the Truesdell rate adds tr(d) σ − d·σ − σ·d.
            let turned = self.turned(&rate(&stretch_rate, &rotation_rate));
            turned
                + spatial * d.trace()
                + Sym::from_matrix(&((spin - d.to_matrix()) * matrix)) * 2.0
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MaterialError;
    use crate::contract::Random;

    #[test]
    fn left_strain_is_the_turned_biot_strain() -> Result<(), MaterialError> {
        let mut random = Random::new(5);
        let mut taken = 0;
        for _ in 0..2000 {
            let strain = random.strain_direction(true) * random.log_uniform(1e-9, 0.06);
            let f = random.rotation() * (Matrix3::identity() + strain.to_matrix());
            let Some(left) = left_strain(&f) else {
                continue;
            };
            taken += 1;
            let kinematics = Biot::new(&f)?;
            let error = (left - kinematics.turned(&kinematics.strain())).max_abs();
            assert!(error < 4e-15, "{error:e} at {:e}", strain.norm());
        }
        assert!(taken > 1000, "{taken}");
        assert!(left_strain(&Matrix3::from_diagonal_element(-1.0)).is_none());
        assert!(left_strain(&Matrix3::from_diagonal_element(f64::NAN)).is_none());
        Ok(())
    }
}
