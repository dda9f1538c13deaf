//! Runs properties over their samples, counts, and shrinks what fails.

use super::{Case, Contract, Random, Replay, Summary, Tally, Violation};
use super::{gauge::Failure, subject::Subject};
use super::{gauge::Gauge, shrink::shrink};
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

impl<M> Property<M> {
    /// Whether this is its name or number ("P9").
    pub fn is(&self, name: &str) -> bool {
        self.name == name || self.name.split(' ').next() == Some(name)
    }
}

/// Runs one property over its samples.
pub(super) fn run<M: Material>(
    property: &Property<M>,
    subject: &Subject<M>,
    contract: &Contract,
    summary: &mut Summary,
) -> Result<(), Violation> {
    let mut tally = tally(property);
    let mut random = stream(property, contract);
    let samples = ((contract.samples as f64 * property.share).ceil() as usize).max(1);
    let mut last = Case::straight([], subject.rest().band);
    for sample in 0..samples {
        last = (property.draw)(subject, &mut random);
        let (case, sample) = (last.clone(), Some(sample));
        judge(
            property, subject, contract, case, sample, &mut tally, summary,
        )?;
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
            replay: Replay {
                contract: contract.clone(),
                cracking: subject.cracking,
                sample: None,
            },
        });
    }
    summary.tallies.push(tally);
    Ok(())
}

/// A count that has not started.
pub(super) fn tally<M>(property: &Property<M>) -> Tally {
    Tally {
        property: property.name,
        exercised: 0,
        skipped: 0,
        refused: 0,
        worst: 0.0,
        note: None,
    }
}

/// The case that [`run`] draws for a sample.
pub(super) fn nth_case<M: Material>(
    property: &Property<M>,
    subject: &Subject<M>,
    contract: &Contract,
    sample: usize,
) -> Case {
    // Every draw depends on those before; they cost next to nothing.
    let mut random = stream(property, contract);
    for _ in 0..sample {
        (property.draw)(subject, &mut random);
    }
    (property.draw)(subject, &mut random)
}

/// Judges one case, counts it, and shrinks it if it fails.
pub(super) fn judge<M: Material>(
    property: &Property<M>,
    subject: &Subject<M>,
    contract: &Contract,
    case: Case,
    sample: Option<usize>,
    tally: &mut Tally,
    summary: &mut Summary,
) -> Result<(), Violation> {
    match (property.judge)(subject, &case) {
        Err(_) => tally.refused += 1,
        Ok(gauge) if gauge.count == 0 => tally.skipped += 1,
        Ok(gauge) => {
            if let Some(failure) = gauge.failure {
                let replay = Replay {
                    contract: contract.clone(),
                    cracking: subject.cracking,
                    sample,
                };
                return Err(violation(property, subject, (case, failure), replay));
            }
            tally.exercised += 1;
            tally.worst = tally.worst.max(gauge.worst);
            summary.softened += usize::from(gauge.softened);
            summary.failed += usize::from(gauge.failed);
            summary.step_error = summary.step_error.max(gauge.step_error);
            summary.asymmetry = summary.asymmetry.max(gauge.asymmetry);
        }
    }
    Ok(())
}

fn violation<M: Material>(
    property: &Property<M>,
    subject: &Subject<M>,
    (case, first): (Case, Failure),
    replay: Replay,
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
        replay,
    }
}

/// A stream per property, so that adding one does not change the others' samples.
fn stream<M: Material>(property: &Property<M>, contract: &Contract) -> Random {
    // FNV-1a of the name.
    let name = property
        .name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
    Random::new(contract.seed ^ name).in_plane(M::PLANE)
}
