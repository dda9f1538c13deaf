//! Runs properties over their samples, counts, and shrinks what fails.

use super::{Case, Contract, Random, Summary, Tally, Violation, gauge::Gauge, shrink::shrink};
use super::{gauge::Failure, subject::Subject};
use crate::{Material, MaterialError};

/// One property: how to draw a case and how to judge it.
pub(super) struct Property<M> {
    /// Number and name.
    pub name: &'static str,
    /// What usually is wrong when it fails.
    pub hint: &'static str,
    /// Fraction of the contract's samples to draw, for costly properties.
    pub share: f64,
    /// Draws a case.
    pub draw: fn(&Subject<M>, &mut Random) -> Case,
    /// Judges it; a refusal of the law is not a failure.
    pub judge: fn(&Subject<M>, &Case) -> Result<Gauge, MaterialError>,
    /// Whether passing without a single comparison is a failure of the check.
    pub must_apply: bool,
}

/// Runs one property over its samples.
pub(super) fn run<M: Material>(
    property: &Property<M>,
    subject: &Subject<M>,
    contract: &Contract,
    summary: &mut Summary,
) -> Result<(), Violation> {
    let mut tally = Tally {
        property: property.name,
        exercised: 0,
        skipped: 0,
        refused: 0,
        worst: 0.0,
        note: None,
    };
    // A stream per property, so that adding one does not change the others' samples.
    let mut random = Random::new(contract.seed ^ stream(property.name)).in_plane(M::PLANE);
    let samples = ((contract.samples as f64 * property.share).ceil() as usize).max(1);
    let mut last = Case::straight([], subject.rest().band);
    for sample in 0..samples {
        let case = (property.draw)(subject, &mut random);
        match (property.judge)(subject, &case) {
            Err(_) => tally.refused += 1,
            Ok(gauge) if gauge.count == 0 => tally.skipped += 1,
            Ok(gauge) => {
                if let Some(failure) = gauge.failure {
                    let first = (case, failure);
                    return Err(violation(property, subject, contract, first, sample));
                }
                tally.exercised += 1;
                tally.worst = tally.worst.max(gauge.worst);
                summary.softened += usize::from(gauge.softened);
                summary.failed += usize::from(gauge.failed);
                summary.step_error = summary.step_error.max(gauge.step_error);
                summary.asymmetry = summary.asymmetry.max(gauge.asymmetry);
            }
        }
        last = case;
    }
    if property.must_apply && tally.exercised == 0 {
        return Err(Violation {
            property: property.name,
            measured: 0.0,
            bound: 1.0,
            case: Box::new(last),
            explanation: format!(
                "not one of {samples} cases exercised it ({} not applicable, {} refused by the \
                 law): the law refuses ordinary deformations, or its natural strain was not \
                 found; set Contract::strain_scale",
                tally.skipped, tally.refused
            ),
            seed: contract.seed,
            sample: samples,
        });
    }
    summary.tallies.push(tally);
    Ok(())
}

fn violation<M: Material>(
    property: &Property<M>,
    subject: &Subject<M>,
    contract: &Contract,
    (case, first): (Case, Failure),
    sample: usize,
) -> Violation {
    let failure = |case: &Case| (property.judge)(subject, case).ok()?.failure;
    let case = shrink(case, |case| failure(case).is_some());
    // A law with hidden state may pass when asked again: say so, with the first numbers.
    let Failure {
        measured,
        bound,
        what,
    } = failure(&case).unwrap_or(Failure {
        what: "failed once and passed when repeated: the law is not a pure function",
        ..first
    });
    Violation {
        property: property.name,
        measured,
        bound,
        case: Box::new(case),
        explanation: format!("{what}. {}", property.hint),
        seed: contract.seed,
        sample,
    }
}

/// FNV-1a of a name.
fn stream(name: &str) -> u64 {
    name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
