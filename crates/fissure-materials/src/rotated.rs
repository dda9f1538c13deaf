//! Small-strain laws at large rotation: Biot's strain with the stress turned as it is.
//!
//! With `F = R·U` the strain is `E = U − 1` and the Cauchy stress `R·T·Rᵀ` [Nairn 2017, app. II].
//! Unlike [`Biot::cauchy`] it leaves out the factors of stretch between `T` and the Cauchy stress,
//! so that energy and work agree to first order in the strain.

use fissure_tensor::{Matrix3, Sym, Tangent, solve_lyapunov};

use crate::Biot;

impl Biot {
    /// The stress `T` turned into space, `R·T·Rᵀ`.
    #[inline]
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
    use crate::finite_strain::LeftStrain;

    #[test]
    fn left_strain_is_the_turned_biot_strain() -> Result<(), MaterialError> {
        let mut random = Random::new(5);
        let mut taken = 0;
        for _ in 0..2000 {
            let strain = random.strain_direction(true) * random.log_uniform(1e-9, 0.06);
            let f = random.rotation() * (Matrix3::identity() + strain.to_matrix());
            let Some((left, _)) = LeftStrain::small(&f) else {
                continue;
            };
            taken += 1;
            let kinematics = Biot::new(&f)?;
            let error = (left - kinematics.turned(&kinematics.strain())).max_abs();
            assert!(error < 4e-15, "{error:e} at {:e}", strain.norm());
        }
        assert!(taken > 1000, "{taken}");
        assert!(LeftStrain::small(&Matrix3::from_diagonal_element(-1.0)).is_none());
        assert!(LeftStrain::small(&Matrix3::from_diagonal_element(f64::NAN)).is_none());
        Ok(())
    }
}
