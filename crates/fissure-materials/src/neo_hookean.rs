//! Compressible neo-Hookean elasticity (Simo and Pister 1984; Bonet and Wood 2008, sec. 6.4.3).
//!
//! `ψ = μ/2 (tr C − 3 − 2 ln J) + λ/2 (ln J)²`, Kirchhoff stress `τ = μ (b − 1) + λ ln J 1`,
//! Cauchy stress `τ/J`, spatial tangent `c = (λ 1⊗1 + 2 (μ − λ ln J) I)/J`. Polyconvex, so it
//! stays elliptic at every stretch while `λ ln J ≤ λ + μ`; at small strain it is isotropic elasticity.

use fissure_tensor::{Matrix3, Sym, Tangent};

use crate::finite_strain::{LeftStrain, log_of_one_plus, rows};
use crate::{
    EIGHT, EightPoints, EightResponses, Increment, Isotropic, Material, MaterialError, Response,
    Scale, SheetStep,
    plane_stress::{condensed, with_thickness},
};

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

    /// What is the same for all particles.
    #[inline(always)]
    fn constants(&self) -> Constants {
        // One division for both moduli.
        let shape = 1.0 - 2.0 * self.poisson;
        let unit = self.young / ((1.0 + self.poisson) * shape);
        Constants {
            lambda: unit * self.poisson,
            shear: 0.5 * unit * shape,
            specific_volume: 1.0 / self.density,
        }
    }
}

/// `λ`, `μ`, Pa, and `1/ρ`, m³/kg.
#[derive(Clone, Copy)]
struct Constants {
    lambda: f64,
    shear: f64,
    specific_volume: f64,
}

impl Constants {
    /// Those of a particle.
    #[inline(always)]
    fn scaled(&self, stiffness: f64) -> Self {
        Self {
            lambda: self.lambda * stiffness,
            shear: self.shear * stiffness,
            ..*self
        }
    }

    /// Cauchy stress, Pa, and stored energy, J/m³.
    #[inline(always)]
    fn stress(&self, strain: &LeftStrain) -> (Sym, f64) {
        let (log, excess) = log_of_one_plus(strain.dilation);
        let kirchhoff = strain.excess * self.shear + Sym::IDENTITY * (self.lambda * log);
        // tr C − 3 − 2 ln J in terms that are each of second order.
        let shape = strain.distortion + 2.0 * excess;
        (
            kirchhoff * (1.0 / strain.jacobian()),
            0.5 * (self.shear * shape + self.lambda * log * log),
        )
    }

    /// From above, in the current configuration: the acoustic tensor in direction `n` has the
    /// eigenvalues `λ + μ − λ ln J + μ n·b·n` (along `n`) and `μ n·b·n` (across), over `ρ`; both
    /// are largest along the longest stretch. That takes a spectrum and a logarithm, so bounds
    /// stand for them: `max n·b·n ≤ p + 2 q` with the mean `p` of the eigenvalues of `b` and
    /// `6 q² = |dev b|²` (equal in uniaxial stretch), and `−ln J ≤ 1/J − 1`, or `ln J ≤ J − 1`
    /// where `λ < 0`. At small strain nothing is lost.
    #[inline(always)]
    fn wave_speed(&self, strain: &LeftStrain) -> f64 {
        let mean = strain.excess.trace() * (1.0 / 3.0);
        let deviator = strain.excess - Sym::IDENTITY * mean;
        let squared = 1.0 + mean + 2.0 * (deviator.dot(&deviator) * (1.0 / 6.0)).sqrt();
        let pressure = if self.lambda > 0.0 {
            self.lambda * (1.0 / strain.jacobian() - 1.0)
        } else {
            self.lambda * -strain.dilation
        };
        let along = self.lambda + self.shear + pressure;
        let along = if along > 0.0 { along } else { 0.0 };
        ((along + self.shear * squared) * self.specific_volume).sqrt()
    }
}

impl Material for NeoHookean {
    type State = ();
    const STRESS_FROM_GRADIENT: bool = true;

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic().check_for("neo-Hookean law")
    }

    fn density(&self) -> f64 {
        self.density
    }

    /// From above; see the formula.
    #[inline(always)]
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &(), scale: &Scale) -> f64 {
        let constants = self.constants().scaled(scale.stiffness);
        let strain = LeftStrain::of_rows(rows(f));
        constants.wave_speed(&strain.0)
    }

    #[inline(always)] // A call would copy the increment, which costs as much as the law.
    fn update(&self, increment: &Increment, _old: &()) -> Result<Response<()>, MaterialError> {
        let scale = &increment.external.scale;
        let constants = self.constants().scaled(scale.stiffness);
        let (stress, stored) = constants.stress(&LeftStrain::new(&increment.f_new)?);
        Ok(Response {
            stress,
            state: (),
            stored,
            dissipated: 0.0,
        })
    }

    /// `ln F_zz` is the root of `μ (e^(2g) − 1) + λ (ln J₀ + g)` with `J₀` of the plane: convex and rising for
    /// λ ≥ 0, so that Newton's method comes down to it from wherever its first step ends.
    fn plane_stress(
        &self,
        increment: &Increment,
        old: &(),
        with_tangent: bool,
    ) -> Result<Option<SheetStep<()>>, MaterialError> {
        let Constants { lambda, shear, .. } = self.constants();
        if lambda < 0.0 {
            return Ok(None);
        }
        let flat = with_thickness(&increment.f_new, 0.0);
        let (log, _) = log_of_one_plus(LeftStrain::new(&flat)?.dilation);
        let mut root = -lambda * log / (2.0 * shear + lambda);
        for _ in 0..64 {
            let excess = (2.0 * root).exp_m1();
            let value = shear * excess + lambda * (log + root);
            let next = root - value / (2.0 * shear * (excess + 1.0) + lambda);
            let settled = (next - root).abs() <= f64::EPSILON * root.abs();
            root = next;
            if settled {
                break;
            }
        }
        let thickening = root.exp_m1();
        let end = increment.with_end(with_thickness(&flat, thickening));
        let tangent = if with_tangent {
            Some(condensed(&self.tangent(&end, old)?)?)
        } else {
            None
        };
        Ok(Some(SheetStep {
            response: self.update(&end, old)?,
            thickening,
            tangent,
        }))
    }

    #[inline(always)]
    fn update_eight(&self, points: &EightPoints) -> Option<EightResponses> {
        let constants = self.constants();
        let mut responses = EightResponses::default();
        let mut all_sound = true;
        for place in 0..EIGHT {
            let (strain, sound) = LeftStrain::of_rows(points.gradient(place));
            let constants = constants.scaled(points.stiffness[place]);
            let (stress, stored) = constants.stress(&strain);
            responses.set(place, &stress, stored, constants.wave_speed(&strain));
            all_sound &= sound;
        }
        all_sound.then_some(responses)
    }

    fn tangent(&self, increment: &Increment, _old: &()) -> Result<Tangent, MaterialError> {
        let scale = &increment.external.scale;
        let Constants { lambda, shear, .. } = self.constants().scaled(scale.stiffness);
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
