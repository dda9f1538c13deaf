//! The public battery: what any law, ours or a user's, has to satisfy, in one call.
//!
//! ```
//! use fissure_materials::{Isotropic, contract};
//! let law = Isotropic { density: 2400.0, young: 30e9, poisson: 0.2 };
//! let summary = contract::check(&law).map_err(|violation| violation.to_string())?;
//! assert!(summary.tally("P3").is_some_and(|tally| tally.exercised > 100));
//! # Ok::<(), String>(())
//! ```
//!
//! Every property states its qualification and its bound at the function that builds it. Inputs
//! come from a seeded generator: strains log-uniform between round-off and beyond failure, all
//! Lode angles and axes, histories of loading, unloading and turning. What fails is shrunk by
//! halving to a case small enough to paste into a test. A property that nothing exercised is a
//! failure, not a pass.

mod case;
mod continuity;
mod dissipation;
mod frames;
mod gauge;
mod generator;
mod report;
mod runner;
mod shrink;
mod subject;
mod substeps;
mod tangent;
mod units;
mod validation;
mod zero_increment;

use fissure_tensor::Band;

pub use case::{Case, Step};
pub use generator::Random;
pub use report::{Summary, Tally, Violation};

use crate::{Material, MaterialError};
use runner::{Property, run};
use subject::Subject;

/// Checks a law with the default [`Contract`]: P1-P3, P6, P9-P12, P19, P20, P22 and P24.
///
/// # Errors
/// The first property that does not hold, with the smallest case found.
pub fn check<M: Material>(law: &M) -> Result<Summary, Violation> {
    Contract::default().check(law)
}

/// How a law is checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Contract {
    /// Cases per property; some costly ones take a fraction.
    pub samples: usize,
    /// Seed of the generator.
    pub seed: u64,
    /// Strain at which the law leaves its linear range; measured if `None`.
    pub strain_scale: Option<f64>,
    /// Band of every case; if `None` they are drawn, of all kinds and up to the widest accepted.
    pub band: Option<Band>,
    /// Sub-steps to which P20 compares one step; 1e3 to 1e4 is telling.
    pub step_error_steps: usize,
}

impl Default for Contract {
    fn default() -> Self {
        Self {
            samples: 256,
            seed: 0x0f15_5e5e,
            strain_scale: None,
            band: None,
            step_error_steps: 1000,
        }
    }
}

impl Contract {
    /// Checks what every law has to satisfy: P1-P3, P6, P9-P12, P19, P20, P22 and P24.
    ///
    /// # Errors
    /// The first property that does not hold, with the smallest case found.
    pub fn check<M: Material>(&self, law: &M) -> Result<Summary, Violation> {
        let subject = Subject::new(law, self).map_err(|error| self.refused(&error))?;
        let mut summary = Summary::default();
        self.run_all(&general(), &subject, &mut summary)?;
        Ok(summary)
    }

    fn run_all<M: Material>(
        &self,
        properties: &[Property<M>],
        subject: &Subject<M>,
        summary: &mut Summary,
    ) -> Result<(), Violation> {
        properties
            .iter()
            .try_for_each(|property| run(property, subject, self, summary))
    }

    /// The law refuses its own parameters, the band asked for, or a small strain.
    fn refused(&self, error: &MaterialError) -> Violation {
        Violation {
            property: "P24 validation",
            measured: f64::NAN,
            bound: 0.0,
            case: Box::new(Case::straight([], self.band.unwrap_or(Band::Uniform(1.0)))),
            explanation: format!("the law refuses to start: {error}"),
            seed: self.seed,
            sample: 0,
        }
    }
}

/// Cheap and fundamental first: what a later property rests on has been checked by then.
fn general<M: Material>() -> Vec<Property<M>> {
    vec![
        zero_increment::determinism(),
        validation::validation(),
        zero_increment::zero_increment(),
        tangent::tangent(),
        frames::objectivity(),
        frames::isotropy(),
        zero_increment::path_independence(),
        dissipation::dissipation(),
        continuity::continuity(),
        substeps::convergence(),
        units::units(),
        substeps::isoerror(),
    ]
}
