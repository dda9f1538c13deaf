//! Hencky elasticity: quadratic in the logarithmic strain (Hencky 1928; Anand 1979).
//!
//! `ψ = λ/2 (tr h)² + μ h:h` with `h = ln V = ½ ln b`; Kirchhoff stress `τ = λ tr(h) 1 + 2μ h`,
//! Cauchy stress `τ/J`. The principal values `h_i = ½ ln(1 + e_i)` come from those of `b − 1`, so
//! they keep their relative accuracy near rest. The spatial tangent is that of `logarithmic.rs`
//! with `∂τ_i/∂h_j = λ + 2μ δ_ij`.

use fissure_tensor::{Matrix3, Sym, Tangent};

use crate::finite_strain::LeftStrain;
use crate::logarithmic::LogStrain;
use crate::sheet::{Thickening, in_sheet};
use crate::{Increment, Isotropic, Material, MaterialError, Response, Scale, SheetStep};

const NAME: &str = "Hencky elasticity";

/// Hyperelastic law that is quadratic in the logarithmic strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hencky {
    /// Elastic constants and density.
    pub elastic: Isotropic,
}

/// Logarithmic strain and Kirchhoff stress on their common axes.
struct Principal {
    strain: LogStrain,
    kirchhoff: [f64; 3],
}

impl Principal {
    fn new(elastic: &Isotropic, f: &Matrix3<f64>) -> Result<Self, MaterialError> {
        let left = LeftStrain::new(f)?;
        let strain = LogStrain::new(&left.excess, left.dilation, NAME)?;
        let (lambda, shear) = (elastic.lambda(), elastic.shear_modulus());
        let volumetric = lambda * strain.log_jacobian;
        Ok(Self {
            kirchhoff: strain.values.map(|h| volumetric + 2.0 * shear * h),
            strain,
        })
    }

    fn stress(&self) -> Sym {
        self.strain.cauchy(&self.kirchhoff)
    }

    fn stored(&self) -> f64 {
        let products = self.kirchhoff.iter().zip(&self.strain.values);
        0.5 * products.map(|(stress, h)| stress * h).sum::<f64>()
    }

    fn tangent(&self, elastic: &Isotropic) -> Tangent {
        let (lambda, shear) = (elastic.lambda(), elastic.shear_modulus());
        self.strain.spatial_tangent(&self.kirchhoff, shear, |i, j| {
            if i == j { lambda + 2.0 * shear } else { lambda }
        })
    }
}

impl Material for Hencky {
    type State = ();
    const STRESS_FROM_GRADIENT: bool = true;

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
        let modulus = Principal::new(&elastic, f)
            .map_or(rest, |p| p.strain.wave_modulus(&elastic, &p.kirchhoff));
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

    fn plane_stress(
        &self,
        increment: &Increment,
        old: &(),
        with_tangent: bool,
    ) -> Result<Option<SheetStep<()>>, MaterialError> {
        let solid = &self.elastic;
        let law = Self {
            elastic: solid.sheet(),
        };
        let measure = Thickening::Logarithm;
        in_sheet(&law, solid, measure, increment, old, with_tangent).map(Some)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vector3;
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
