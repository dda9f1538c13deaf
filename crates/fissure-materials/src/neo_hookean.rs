//! Compressible neo-Hookean elasticity (Simo and Pister 1984; Bonet and Wood 2008, sec. 6.4.3).
//!
//! `ψ = μ/2 (tr C − 3 − 2 ln J) + λ/2 (ln J)²`, Kirchhoff stress `τ = μ (b − 1) + λ ln J 1`,
//! Cauchy stress `τ/J`, spatial tangent `c = (λ 1⊗1 + 2 (μ − λ ln J) I)/J`. Polyconvex, so it
//! stays elliptic at every stretch while `λ ln J ≤ λ + μ`; at small strain it is isotropic elasticity.

use fissure_tensor::{Matrix3, Sym, Tangent};

use crate::finite_strain::{LeftStrain, excess_over_log};
use crate::{Increment, Isotropic, Material, MaterialError, Response, Scale};

/// Parameters of the compressible neo-Hookean law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean {
    /// Reference mass density ρ, kg/m³; > 0.
    pub density: f64,
    /// Young's modulus at rest E, Pa; > 0.
    pub young: f64,
    /// Poisson's ratio at rest ν; in (−1, 0.5).
    pub poisson: f64,
}

impl NeoHookean {
    /// The constants of its small-strain limit.
    pub fn elastic(&self) -> Isotropic {
        Isotropic {
            density: self.density,
            young: self.young,
            poisson: self.poisson,
        }
    }

    /// `λ`, `μ` of one particle, Pa.
    #[inline(always)]
    fn constants(&self, scale: &Scale) -> (f64, f64) {
        // One division for both: this is most of the time of a small law.
        let shape = 1.0 - 2.0 * self.poisson;
        let unit = self.young * scale.stiffness / ((1.0 + self.poisson) * shape);
        (unit * self.poisson, 0.5 * unit * shape)
    }
}

impl Material for NeoHookean {
    type State = ();

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic().check_for("neo-Hookean law")
    }

    fn density(&self) -> f64 {
        self.density
    }

    /// From above, in the current configuration: the acoustic tensor in direction `n` has the
    /// eigenvalues `λ + μ − λ ln J + μ n·b·n` (along `n`) and `μ n·b·n` (across), over `ρ`; both
    /// are largest along the longest stretch. That takes a spectrum and a logarithm, so bounds
    /// stand for them: `max n·b·n ≤ p + 2 q` with the mean `p` of the eigenvalues of `b` and
    /// `6 q² = |dev b|²` (equal in uniaxial stretch), and `−ln J ≤ 1/J − 1`, or `ln J ≤ J − 1`
    /// where `λ < 0`. At small strain nothing is lost.
    #[inline(always)]
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &(), scale: &Scale) -> f64 {
        let (lambda, shear) = self.constants(scale);
        let b = Sym::from_matrix(&(f * f.transpose()));
        let jacobian = f.determinant();
        let deviator = b.deviator();
        let squared = b.mean() + 2.0 * (deviator.dot(&deviator) / 6.0).sqrt();
        let pressure = if lambda > 0.0 {
            lambda * (1.0 / jacobian - 1.0)
        } else {
            lambda * (1.0 - jacobian)
        };
        let along = lambda + shear + pressure;
        ((along.max(0.0) + shear * squared) / self.density).sqrt()
    }

    #[inline(always)] // A call would copy the increment, which costs as much as the law.
    fn update(&self, increment: &Increment, _old: &()) -> Result<Response<()>, MaterialError> {
        let (lambda, shear) = self.constants(&increment.external.scale);
        let strain = LeftStrain::new(&increment.f_new)?;
        let log = strain.log_jacobian();
        let kirchhoff = strain.excess * shear + Sym::IDENTITY * (lambda * log);
        // tr C − 3 − 2 ln J in terms that are each of second order.
        let shape = strain.distortion + 2.0 * excess_over_log(strain.dilation);
        Ok(Response {
            stress: kirchhoff * (1.0 / strain.jacobian()),
            state: (),
            stored: 0.5 * (shear * shape + lambda * log * log),
            dissipated: 0.0,
        })
    }

    fn tangent(&self, increment: &Increment, _old: &()) -> Result<Tangent, MaterialError> {
        let (lambda, shear) = self.constants(&increment.external.scale);
        let strain = LeftStrain::new(&increment.f_new)?;
        let shear_now = shear - lambda * strain.log_jacobian();
        Ok(Tangent::isotropic(lambda, shear_now) * (1.0 / strain.jacobian()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{assert_tangent, assert_wave_speed, gradients};

    const RUBBER: NeoHookean = NeoHookean {
        density: 1100.0,
        young: 2e6,
        poisson: 0.3,
    };

    #[test]
    fn small_strains_are_isotropic_elasticity() -> Result<(), MaterialError> {
        let mut f = Matrix3::identity();
        f.m11 += 1e-12;
        let strain = f.m11 - 1.0;
        let response = RUBBER.update(&Increment::to(f), &())?;
        let modulus = RUBBER.elastic().p_wave_modulus();
        assert!((response.stress.xx() / (modulus * strain) - 1.0).abs() < 1e-10);
        assert!((response.stress.yy() / (RUBBER.elastic().lambda() * strain) - 1.0).abs() < 1e-10);
        assert!((response.stored / (0.5 * modulus * strain * strain) - 1.0).abs() < 1e-10);
        Ok(())
    }

    #[test]
    fn energy_matches_its_definition_at_large_strain() -> Result<(), MaterialError> {
        for f in gradients() {
            let log = f.determinant().ln();
            let elastic = RUBBER.elastic();
            let exact = 0.5 * elastic.shear_modulus() * (f.norm_squared() - 3.0 - 2.0 * log)
                + 0.5 * elastic.lambda() * log * log;
            let stored = RUBBER.update(&Increment::to(f), &())?.stored;
            assert!((stored - exact).abs() <= 1e-14 * (exact + RUBBER.young));
        }
        Ok(())
    }

    #[test]
    fn tangent_and_wave_speed_hold_at_large_strain() -> Result<(), MaterialError> {
        for f in gradients() {
            assert_tangent(&RUBBER, &Increment::to(f), &(), 1e-8)?;
            // Never below the largest of many directions, and near it unless J is far from 1.
            assert_wave_speed(&RUBBER, &f, &(), 1.25)?;
        }
        Ok(())
    }
}
