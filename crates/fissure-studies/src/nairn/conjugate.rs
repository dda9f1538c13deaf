//! Which Cauchy stress the law of the document gives: `ConjugateDamage` says why it matters.

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

    /// Fills a body with the law, of one crack or two.
    pub(super) fn fill<L: Cracking, const D: usize>(
        self,
        scene: &mut Scene<D>,
        name: &str,
        law: L,
        region: &dyn Region<D>,
        seeding: &dyn Seeding<D>,
    ) -> Result<(), StudyError>
    where
        ConjugateDamage<L>: Material,
    {
        let filled = match self {
            Self::Conjugate => scene.fill(name, ConjugateDamage(law), region, seeding),
            Self::Rotated => scene.fill(name, law, region, seeding),
        };
        filled.map_err(StudyError::failed(format!("filling '{name}'")))?;
        Ok(())
    }
}
