//! Hencky elasticity: quadratic in the logarithmic strain (Hencky 1928; Anand 1979).
//!
//! `ψ = λ/2 (tr h)² + μ h:h` with `h = ln V = ½ ln b`; Kirchhoff stress `τ = λ tr(h) 1 + 2μ h`,
//! Cauchy stress `τ/J`. The principal values `h_i = ½ ln(1 + e_i)` come from those of `b − 1`, so
//! they keep their relative accuracy near rest. On the principal axes `n_i` the spatial tangent is
//! `J c_iijj = λ + 2μ δ_ij − 2 τ_i δ_ij` and `J c_ijij = μ x coth x − (τ_i + τ_j)/2` with
//! `x = h_i − h_j`, smooth where principal strains coincide (Ogden 1997, sec. 6.1.4).

use fissure_tensor::{Matrix3, Sym, Tangent, Vector3};

use crate::finite_strain::LeftStrain;
use crate::{Increment, Isotropic, Material, MaterialError, Response, Scale};

const NAME: &str = "Hencky elasticity";

/// Hyperelastic law that is quadratic in the logarithmic strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hencky {
    /// Elastic constants and density.
    pub elastic: Isotropic,
}

/// Logarithmic strain and Kirchhoff stress on their common axes.
struct Principal {
    axes: [Vector3<f64>; 3],
    log: [f64; 3],
    kirchhoff: [f64; 3],
    jacobian: f64,
}

impl Principal {
    fn new(elastic: &Isotropic, f: &Matrix3<f64>) -> Result<Self, MaterialError> {
        let strain = LeftStrain::new(f)?;
        let spectrum = strain.excess.spectrum();
        let log = spectrum.values.map(|excess| 0.5 * excess.ln_1p());
        if !log.iter().all(|h| h.is_finite()) {
            return Err(MaterialError::NotFinite { law: NAME });
        }
        let trace = strain.log_jacobian();
        let (lambda, shear) = (elastic.lambda(), elastic.shear_modulus());
        Ok(Self {
            axes: spectrum.vectors,
            log,
            kirchhoff: log.map(|h| lambda * trace + 2.0 * shear * h),
            jacobian: strain.jacobian(),
        })
    }

    fn stress(&self) -> Sym {
        (0..3)
            .map(|i| Sym::dyad(&self.axes[i]) * (self.kirchhoff[i] / self.jacobian))
            .sum()
    }

    fn stored(&self) -> f64 {
        0.5 * (0..3).map(|i| self.kirchhoff[i] * self.log[i]).sum::<f64>()
    }

    fn tangent(&self, elastic: &Isotropic) -> Tangent {
        let (lambda, shear) = (elastic.lambda(), elastic.shear_modulus());
        let mut tangent = Tangent::isotropic(lambda, 0.0);
        for i in 0..3 {
            let normal = Sym::dyad(&self.axes[i]);
            let modulus = 2.0 * shear - 2.0 * self.kirchhoff[i];
            tangent = tangent + Tangent::dyad(&normal, &normal) * modulus;
            for j in 0..i {
                let mixed = Sym::dyad_of(&self.axes[i], &self.axes[j]);
                let modulus = shear * x_coth_x(self.log[i] - self.log[j])
                    - 0.5 * (self.kirchhoff[i] + self.kirchhoff[j]);
                tangent = tangent + Tangent::dyad(&mixed, &mixed) * (4.0 * modulus);
            }
        }
        tangent * (1.0 / self.jacobian)
    }

    /// Largest `ρc²` of the waves that run along a principal axis: `λ + 2μ − τ_i` for the
    /// longitudinal one, `μ x (coth x + 1)` with `x = h_i − h_j` for those across.
    fn wave_modulus(&self, elastic: &Isotropic) -> f64 {
        let shear = elastic.shear_modulus();
        let mut largest: f64 = 0.0;
        for i in 0..3 {
            largest = largest.max(elastic.p_wave_modulus() - self.kirchhoff[i]);
            for j in 0..3 {
                let x = self.log[i] - self.log[j];
                largest = largest.max(shear * (x_coth_x(x) + x));
            }
        }
        largest
    }
}

/// `x coth x`, 1 at 0.
fn x_coth_x(x: f64) -> f64 {
    if x.abs() < 1e-4 {
        1.0 + x * x / 3.0
    } else {
        x / x.tanh()
    }
}

impl Material for Hencky {
    type State = ();

    fn check(&self) -> Result<(), MaterialError> {
        self.elastic.check_for(NAME)
    }

    fn density(&self) -> f64 {
        self.elastic.density
    }

    /// In the current configuration, over the waves along the principal axes; never below the
    /// speed at rest, which bounds the oblique ones where the law is elliptic.
    fn wave_speed(&self, f: &Matrix3<f64>, _state: &(), scale: &Scale) -> f64 {
        let elastic = self.elastic.scaled(scale);
        let rest = elastic.p_wave_modulus();
        let modulus = Principal::new(&elastic, f).map_or(rest, |p| p.wave_modulus(&elastic));
        (modulus.max(rest) / elastic.density).sqrt()
    }

    fn update(&self, increment: &Increment, _old: &()) -> Result<Response<()>, MaterialError> {
        let elastic = self.elastic.scaled(&increment.external.scale);
        let principal = Principal::new(&elastic, &increment.f_new)?;
        Ok(Response {
            stress: principal.stress(),
            state: (),
            stored: principal.stored(),
            dissipated: 0.0,
        })
    }

    fn tangent(&self, increment: &Increment, _old: &()) -> Result<Tangent, MaterialError> {
        let elastic = self.elastic.scaled(&increment.external.scale);
        Ok(Principal::new(&elastic, &increment.f_new)?.tangent(&elastic))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{assert_tangent, assert_wave_speed, gradients};

    const LAW: Hencky = Hencky {
        elastic: Isotropic {
            density: 2500.0,
            young: 70e9,
            poisson: 0.25,
        },
    };

    #[test]
    fn uniaxial_strain_is_the_logarithm() -> Result<(), MaterialError> {
        for strain in [1e-12_f64, -1e-12, 1e-6, 0.5, -0.5, 20.0] {
            let mut f = Matrix3::identity();
            f.m11 += strain;
            let log = f64::ln_1p(f.m11 - 1.0);
            let response = LAW.update(&Increment::to(f), &())?;
            let modulus = LAW.elastic.p_wave_modulus();
            assert!((response.stress.xx() / (modulus * log / f.m11) - 1.0).abs() < 1e-11);
            assert!((response.stored / (0.5 * modulus * log * log) - 1.0).abs() < 1e-11);
        }
        Ok(())
    }

    #[test]
    fn a_rotation_on_top_only_turns_the_stress() -> Result<(), MaterialError> {
        let turn = fissure_tensor::rotation(&Vector3::new(1.0, -2.0, 0.5), 2.1);
        for f in gradients() {
            let plain = LAW.update(&Increment::to(f), &())?;
            let turned = LAW.update(&Increment::to(turn * f), &())?;
            let gap = turned.stress - plain.stress.congruence(&turn);
            assert!(gap.max_abs() <= 1e-13 * (plain.stress.max_abs() + LAW.elastic.young));
            assert!((turned.stored - plain.stored).abs() <= 1e-13 * LAW.elastic.young);
        }
        Ok(())
    }

    #[test]
    fn tangent_and_wave_speed_hold_at_large_strain() -> Result<(), MaterialError> {
        for f in gradients() {
            assert_tangent(&LAW, &Increment::to(f), &(), 1e-8)?;
            assert_wave_speed(&LAW, &f, &(), f64::INFINITY)?;
        }
        Ok(())
    }
}
