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
//! halving to a case small enough to paste into a test, and the message says which call of
//! [`Contract::replay`] finds it again. A property that nothing exercised is a
//! failure, not a pass.

mod case;
mod continuity;
mod cracking_bounds;
mod cracking_energy;
mod cracking_initiation;
mod cracking_kinematics;
mod cracking_tangent;
mod dissipation;
mod frames;
mod gauge;
mod generator;
mod history;
mod replay;
mod report;
mod runner;
mod shrink;
mod softening;
#[cfg(feature = "proptest")]
pub mod strategies;
mod subject;
mod substeps;
mod tangent;
mod units;
mod validation;
mod zero_increment;

use fissure_tensor::Band;

pub use case::{Case, Step};
pub use generator::Random;
pub use replay::Replay;
pub use report::{Summary, Tally, Violation};
pub use softening::{SofteningFault, check_softening};
pub use tangent::{is_difference_quotient, tangent_error};

use crate::{Cracking, Material, MaterialError, Scale};
use runner::{Property, run};
use subject::Subject;

/// Checks a law with the default [`Contract`]: P1-P3, P6, P9-P12, P19, P20, P22 and P24.
///
/// # Errors
/// The first property that does not hold, with the smallest case found.
pub fn check<M: Material>(law: &M) -> Result<Summary, Violation> {
    Contract::default().check(law)
}

/// Checks a law that cracks with the default [`Contract`]: what [`check`] does, and P4, P5, P7, P8,
/// P13-P18.
///
/// # Errors
/// The first property that does not hold, with the smallest case found; or that no crack softened.
pub fn check_cracking<M: Cracking>(law: &M) -> Result<Summary, Violation> {
    Contract::default().check_cracking(law)
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
    /// Properties that the law is known not to hold, by name ("P8 fracture energy") or number ("P8"). They are put to it
    /// all the same; their violations are kept in [`Summary::not_held`] and the others go on.
    pub not_held: &'static [&'static str],
}

impl Default for Contract {
    fn default() -> Self {
        Self {
            samples: 256,
            seed: 0x0f15_5e5e,
            strain_scale: None,
            band: None,
            step_error_steps: 1000,
            not_held: &[],
        }
    }
}

impl Contract {
    /// Checks what every law has to satisfy: P1-P3, P6, P9-P12, P19, P20, P22 and P24.
    ///
    /// # Errors
    /// The first property that does not hold, with the smallest case found; those of
    /// [`not_held`](Self::not_held) are no errors. Or one of these is no property.
    pub fn check<M: Material>(&self, law: &M) -> Result<Summary, Violation> {
        let subject = Subject::new(law, self).map_err(|error| self.refused(&error, false))?;
        let properties = general();
        self.check_not_held(&properties, false)?;
        let mut summary = Summary::default();
        self.run_all(&properties, &subject, &mut summary)?;
        Ok(summary)
    }

    /// Checks what a law that cracks has to satisfy: what [`check`](Self::check) does, and P4, P5,
    /// P7, P8, P13-P18.
    ///
    /// # Errors
    /// As [`check`](Self::check); or that no crack softened.
    pub fn check_cracking<M: Cracking>(&self, law: &M) -> Result<Summary, Violation> {
        let subject = Subject::cracking(law, self).map_err(|error| self.refused(&error, true))?;
        let properties = battery();
        self.check_not_held(&properties, true)?;
        let mut summary = Summary::default();
        self.run_all(&properties, &subject, &mut summary)?;
        let fails = law.critical_opening(&Scale::default()).is_finite();
        if summary.softened == 0 || (fails && summary.failed == 0) {
            let reason = format!(
                "{} cracks softened and {} failed, in histories drawn up to beyond the critical \
                 opening: strength or critical opening are not those of the law",
                summary.softened, summary.failed
            );
            return Err(self.without_case("P7 irreversibility", reason, true));
        }
        summary.tallies.push(Tally {
            property: "P17 order of cracks",
            exercised: 0,
            skipped: 0,
            refused: 0,
            worst: 0.0,
            note: Some("a state is opaque, its cracks cannot be exchanged; P16 judges each crack"),
        });
        Ok(summary)
    }

    fn run_all<M: Material>(
        &self,
        properties: &[Property<M>],
        subject: &Subject<M>,
        summary: &mut Summary,
    ) -> Result<(), Violation> {
        for property in properties {
            match run(property, subject, self, summary) {
                Err(violation) if self.not_held.iter().any(|name| property.is(name)) => {
                    summary.tallies.push(Tally {
                        worst: violation.measured / violation.bound,
                        note: Some("does not hold, as was said"),
                        ..runner::tally(property)
                    });
                    summary.not_held.push(violation);
                }
                outcome => outcome?,
            }
        }
        Ok(())
    }

    /// Refuses an exemption from something that is not looked at.
    fn check_not_held<M: Material>(
        &self,
        properties: &[Property<M>],
        cracking: bool,
    ) -> Result<(), Violation> {
        for name in self.not_held {
            if !properties.iter().any(|property| property.is(name)) {
                return Err(self.unknown(name, properties, cracking));
            }
        }
        Ok(())
    }

    /// There is no property of this name.
    fn unknown<M: Material>(
        &self,
        name: &str,
        properties: &[Property<M>],
        cracking: bool,
    ) -> Violation {
        let known: Vec<_> = properties.iter().map(|p| p.name).collect();
        let reason = format!("there is none named '{name}': {}", known.join(", "));
        self.without_case("a property by its name", reason, cracking)
    }

    /// The law refuses its own parameters, the band asked for, or a small strain.
    fn refused(&self, error: &MaterialError, cracking: bool) -> Violation {
        self.without_case(
            "P24 validation",
            format!("the law refuses to start: {error}"),
            cracking,
        )
    }

    /// A violation that needs no input.
    fn without_case(
        &self,
        property: &'static str,
        explanation: String,
        cracking: bool,
    ) -> Violation {
        let band = self.band.unwrap_or(Band::Uniform(1.0));
        Violation {
            property,
            measured: f64::NAN,
            bound: 0.0,
            case: Box::new(Case::straight([], band)),
            explanation,
            replay: Replay {
                contract: self.clone(),
                cracking,
                sample: None,
            },
        }
    }
}

/// Cheap and fundamental first: what a later property rests on has been checked by then.
fn general<M: Material>() -> Vec<Property<M>> {
    vec![
        zero_increment::determinism(),
        validation::validation(),
        history::history(),
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

/// Irreversibility first, since it counts the histories that cracked.
fn cracking<M: Cracking>() -> Vec<Property<M>> {
    vec![
        cracking_energy::band_validation(),
        cracking_bounds::irreversibility(),
        cracking_energy::fracture_energy(),
        cracking_bounds::consistency(),
        cracking_bounds::traction_bound(),
        cracking_initiation::initiation(),
        cracking_initiation::initiation_finely(),
        cracking_initiation::objectivity(),
        cracking_tangent::symmetry(),
        cracking_tangent::slope(),
        cracking_tangent::unloading(),
        cracking_kinematics::crack_strain(),
        cracking_kinematics::closure(),
    ]
}

/// Every property of a law that cracks.
fn battery<M: Cracking>() -> Vec<Property<M>> {
    let mut all = general();
    all.extend(cracking());
    all
}
