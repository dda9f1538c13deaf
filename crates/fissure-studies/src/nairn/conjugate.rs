//! The law of the document with the stress that does the work.
//!
//! The law gives `T(U − 1)` and the document takes `σ = R·T·Rᵀ` for Cauchy's stress, which leaves
//! out the factors of stretch between the two. A crack that is smeared over half a millimetre and
//! opens by one has a stretch of 3: then the work on the particle is wrong by as much, and free
//! vibration of a broken bar gains energy from its cracks. Here σ is what is conjugate to the same
//! `T` ([`Biot::cauchy`]), so that the work is `T : dU` exactly.
//!
//! Then `J σ_nn` of a mode with the stretch `λ_n` is `λ_n T_nn`, a wave along it has the speed
//! `λ_n c₀`, and a crack that has opened carries none across it: only the stretches in its plane
//! limit the step.

use fissure::materials::AnisotropicDamageState;
use fissure::prelude::*;
use fissure_study::{Parameter, Parameters, StudyError};

/// How the Cauchy stress follows from the law's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StressMeasure {
    Conjugate,
    Rotated,
}

impl StressMeasure {
    /// The parameter `measure`.
    pub(super) fn parameter() -> Parameter {
        Parameter::choice(
            "measure",
            "Cauchy stress from that of the law: conjugate to its strain, or R·T·Rᵀ as in the document",
            "conjugate",
            &["conjugate", "rotated"],
        )
    }

    pub(super) fn of(case: &Parameters) -> Result<Self, StudyError> {
        Ok(match case.choice("measure")? {
            "rotated" => Self::Rotated,
            _ => Self::Conjugate,
        })
    }

    /// Fills a body with the law.
    pub(super) fn fill<N: Softening, T: Softening, const D: usize>(
        self,
        scene: &mut Scene<D>,
        name: &str,
        law: AnisotropicDamage<N, T>,
        region: &dyn Region<D>,
        seeding: &dyn Seeding<D>,
    ) -> Result<(), StudyError> {
        let filled = match self {
            Self::Conjugate => scene.fill(name, Conjugate(law), region, seeding),
            Self::Rotated => scene.fill(name, law, region, seeding),
        };
        filled.map_err(StudyError::failed(format!("filling '{name}'")))?;
        Ok(())
    }
}

/// Anisotropic damage with the conjugate stress.
#[derive(Clone, Copy, Debug)]
pub(super) struct Conjugate<N: Softening, T: Softening>(pub AnisotropicDamage<N, T>);

impl<N: Softening, T: Softening> Material for Conjugate<N, T> {
    type State = AnisotropicDamageState;
    const NAMES: &'static [&'static str] = AnisotropicDamage::<N, T>::NAMES;
    // The law has none for a path that is straight in U − 1; that of F is not at strains of a quarter, which are five
    // natural ones of so weak a law (measured 0.22).
    const STEP_ERROR: f64 = 0.25;

    fn check(&self) -> Result<(), MaterialError> {
        self.0.check()
    }

    fn check_band(&self, band: &Band, scale: &Scale) -> Result<(), MaterialError> {
        self.0.check_band(band, scale)
    }

    fn started_width(&self, old: &Self::State, new: &Self::State) -> f64 {
        self.0.started_width(old, new)
    }

    fn isotropic(&self) -> bool {
        self.0.isotropic()
    }

    fn continuous(&self) -> bool {
        self.0.continuous()
    }

    fn density(&self) -> f64 {
        self.0.density()
    }

    fn wave_speed(&self, f: &Matrix3<f64>, state: &Self::State, scale: &Scale) -> f64 {
        let speed = self.0.elastic.p_wave_speed() * scale.stiffness.sqrt();
        let mut bearing = *f;
        if state.width > 0.0 {
            // Without what the crack opens by: F·(1 − n⊗n) + R n⊗n has the stretches in its plane.
            let normal = Vector3::from(state.normal);
            let opened = f * normal;
            let length = opened.norm();
            if length > 1.0 {
                bearing += (opened / length - opened) * normal.transpose();
            }
        }
        speed * longest_stretch(&bearing)
    }

    fn update(
        &self,
        increment: &Increment,
        old: &Self::State,
    ) -> Result<Response<Self::State>, MaterialError> {
        let mut response = self.0.update(increment, old)?;
        let kinematics = Biot::new(&increment.f_new)?;
        let biot_stress = response.stress.rotated(&kinematics.rotation.transpose());
        response.stress = kinematics.cauchy(&biot_stress);
        Ok(response)
    }

    fn values(&self, state: &Self::State, out: &mut [f64]) {
        self.0.values(state, out);
    }
}

/// Largest principal stretch, at least 1.
fn longest_stretch(f: &Matrix3<f64>) -> f64 {
    Biot::longest_stretch(f)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fissure::materials::contract::Contract;
    use fissure::prelude::softening::Linear;

    fn law() -> Conjugate<Linear, Linear> {
        let mode = |strength, toughness| Mode {
            strength,
            toughness,
            softening: Linear,
        };
        let elastic = Isotropic {
            density: 1000.0,
            young: 1e9,
            poisson: 0.33,
        };
        Conjugate(AnisotropicDamage::new(
            elastic,
            mode(30e6, 10e3),
            mode(20e6, 10e3),
        ))
    }

    #[test]
    fn it_keeps_the_contract_of_laws() {
        let contract = Contract {
            samples: 32,
            step_error_steps: 100,
            ..Contract::default()
        };
        let message = contract.check(&law()).err().map(|v| v.to_string());
        assert_eq!(message.unwrap_or_default(), "");
    }
}
