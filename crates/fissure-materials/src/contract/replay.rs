//! Running one case of one property again.

use std::fmt;

use super::runner::{Property, judge, nth_case, tally};
use super::{Case, Contract, Summary, Violation, battery, general, subject::Subject};
use crate::{Cracking, Material};

/// Where a violation was found, and so how it is found again.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// The contract that found it; all but the number of samples and what was not held matters.
    pub contract: Contract,
    /// Whether the law was checked as one that cracks, which draws other cases.
    pub cracking: bool,
    /// Which case of the property it was, from 0; `None` if it was no single one.
    pub sample: Option<usize>,
}

impl fmt::Display for Replay {
    /// The contract as Rust, with what differs from the default.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Contract {
            samples: _,
            seed,
            strain_scale,
            band,
            step_error_steps,
            not_held: _,
        } = &self.contract;
        write!(out, "Contract {{ seed: {seed:#x}, ")?;
        if strain_scale.is_some() {
            write!(out, "strain_scale: {strain_scale:?}, ")?;
        }
        if band.is_some() {
            write!(out, "band: {band:?}, ")?;
        }
        if *step_error_steps != Contract::default().step_error_steps {
            write!(out, "step_error_steps: {step_error_steps}, ")?;
        }
        write!(out, "..Contract::default() }}")
    }
}

impl Violation {
    /// The calls that find this violation again, as Rust for a test of one's own.
    pub(super) fn how_to_replay(&self) -> String {
        let Replay {
            cracking, sample, ..
        } = &self.replay;
        let suffix = if *cracking { "_cracking" } else { "" };
        match sample {
            Some(sample) => format!(
                "replay:      {}.replay{suffix}(&law, {:?}, {sample})\n\
                 that case:   the same contract's judge{suffix}(&law, {:?}, &case)",
                self.replay, self.property, self.property
            ),
            None => format!("replay: {}.check{suffix}(&law)", self.replay),
        }
    }
}

impl Contract {
    /// Draws one case of one property again and judges it alone: what a [`Violation`] was found
    /// in. `property` is its name or number ("P3"), `sample` counts from 0.
    ///
    /// ```
    /// use fissure_materials::{Isotropic, contract::Contract};
    /// let law = Isotropic { density: 2400.0, young: 30e9, poisson: 0.2 };
    /// let contract = Contract { seed: 7, ..Contract::default() };
    /// let summary = contract.replay(&law, "P3 tangent", 17).map_err(|v| v.to_string())?;
    /// assert_eq!(summary.tallies[0].exercised, 1);
    /// # Ok::<(), String>(())
    /// ```
    ///
    /// # Errors
    /// The violation, shrunk as by [`check`](Self::check), or that there is no such property.
    pub fn replay<M: Material>(
        &self,
        law: &M,
        property: &str,
        sample: usize,
    ) -> Result<Summary, Violation> {
        let subject = Subject::new(law, self).map_err(|error| self.refused(&error, false))?;
        self.again(&subject, &general(), property, sample)
    }

    /// As [`replay`](Self::replay), for what [`check_cracking`](Self::check_cracking) found.
    ///
    /// # Errors
    /// As [`replay`](Self::replay).
    pub fn replay_cracking<M: Cracking>(
        &self,
        law: &M,
        property: &str,
        sample: usize,
    ) -> Result<Summary, Violation> {
        let subject = Subject::cracking(law, self).map_err(|error| self.refused(&error, true))?;
        self.again(&subject, &battery(), property, sample)
    }

    /// Judges one case by one property, for a case from a violation or of one's own.
    ///
    /// # Errors
    /// The violation, with the case shrunk further if that is possible, or that there is no such
    /// property.
    pub fn judge<M: Material>(
        &self,
        law: &M,
        property: &str,
        case: &Case,
    ) -> Result<Summary, Violation> {
        let subject = Subject::new(law, self).map_err(|error| self.refused(&error, false))?;
        let properties = general();
        let property = self.find(&properties, property, subject.cracking)?;
        one(property, &subject, self, case.clone(), None)
    }

    /// As [`judge`](Self::judge), for the properties of laws that crack too.
    ///
    /// # Errors
    /// As [`judge`](Self::judge).
    pub fn judge_cracking<M: Cracking>(
        &self,
        law: &M,
        property: &str,
        case: &Case,
    ) -> Result<Summary, Violation> {
        let subject = Subject::cracking(law, self).map_err(|error| self.refused(&error, true))?;
        let properties = battery();
        let property = self.find(&properties, property, subject.cracking)?;
        one(property, &subject, self, case.clone(), None)
    }

    fn again<M: Material>(
        &self,
        subject: &Subject<M>,
        properties: &[Property<M>],
        property: &str,
        sample: usize,
    ) -> Result<Summary, Violation> {
        let property = self.find(properties, property, subject.cracking)?;
        let case = nth_case(property, subject, self, sample);
        one(property, subject, self, case, Some(sample))
    }

    /// The property of a name, else the first of a number.
    fn find<'a, M: Material>(
        &self,
        properties: &'a [Property<M>],
        name: &str,
        cracking: bool,
    ) -> Result<&'a Property<M>, Violation> {
        let mut all = properties.iter();
        all.clone()
            .find(|p| p.name == name)
            .or_else(|| all.find(|p| p.is(name)))
            .ok_or_else(|| self.unknown(name, properties, cracking))
    }
}

fn one<M: Material>(
    property: &Property<M>,
    subject: &Subject<M>,
    contract: &Contract,
    case: Case,
    sample: Option<usize>,
) -> Result<Summary, Violation> {
    let (mut summary, mut tally) = (Summary::default(), tally(property));
    judge(
        property,
        subject,
        contract,
        case,
        sample,
        &mut tally,
        &mut summary,
    )?;
    summary.tallies.push(tally);
    Ok(summary)
}
