//! What a check found: a count per property, or the smallest case that fails.

use std::fmt;

use thiserror::Error;

use super::{Case, Replay};

/// How often one property was exercised and how close it came to its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    /// Name of the property, as in "P9 objectivity".
    pub property: &'static str,
    /// Cases in which something was compared.
    pub exercised: usize,
    /// Cases to which the property does not apply.
    pub skipped: usize,
    /// Cases in which the law refused a deformation.
    pub refused: usize,
    /// Largest measured value over its bound; over 1 only where the property does not hold, as was said.
    pub worst: f64,
    /// Why the property was left out, if it was.
    pub note: Option<&'static str>,
}

/// What a law that passed was put through.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// One entry per property, in the order they ran.
    pub tallies: Vec<Tally>,
    /// Histories in which a crack softened; only for laws that crack.
    pub softened: usize,
    /// Histories in which a crack failed; only for laws that crack.
    pub failed: usize,
    /// Largest difference between one step and many over the grid of P20, over stiffness times
    /// strain increment.
    pub step_error: f64,
    /// Largest departure from major symmetry of a tangent, over the stiffness; 0 if not measured.
    pub asymmetry: f64,
    /// Violations of properties that were said not to hold ([`Contract::not_held`](super::Contract::not_held)).
    pub not_held: Vec<Violation>,
}

impl Summary {
    /// The entry of the property of this name or number ("P9").
    pub fn tally(&self, property: &str) -> Option<&Tally> {
        self.tallies
            .iter()
            .find(|t| t.property == property || t.property.split(' ').next() == Some(property))
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for tally in &self.tallies {
            write!(
                out,
                "{:<34} exercised {:>6}, not applicable {:>5}, refused {:>3}, worst/bound {:.2e}",
                tally.property, tally.exercised, tally.skipped, tally.refused, tally.worst
            )?;
            if let Some(note) = tally.note {
                write!(out, "; {note}")?;
            }
            writeln!(out)?;
        }
        writeln!(out, "softened {}, failed {}", self.softened, self.failed)?;
        write!(
            out,
            "one step against many {:.2e}, asymmetry {:.2e}",
            self.step_error, self.asymmetry
        )
    }
}

/// A property that a law breaks, with the smallest case found.
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "{property} does not hold: {explanation}\n\
     measured {measured:e}, bound {bound:e}\n\
     smallest failing case (seed {}):\n{case}{}",
    replay.contract.seed, self.how_to_replay()
)]
pub struct Violation {
    /// Name of the property, as in "P9 objectivity".
    pub property: &'static str,
    /// What was measured in the smallest case.
    pub measured: f64,
    /// The bound it had to keep.
    pub bound: f64,
    /// The smallest failing input.
    pub case: Box<Case>,
    /// What was compared and what usually is wrong.
    pub explanation: String,
    /// How to find it again.
    pub replay: Replay,
}
