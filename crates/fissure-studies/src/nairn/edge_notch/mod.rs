//! A single edge notch in a plate that is pulled at both ends [Nairn 2017, sec. 3.2, figs 5 and 6].
//!
//! `mode=damage`: the crack is a row of particles that fail. The notch is a cell row that is left
//! out, one that has failed from the start, or a line. `mode=explicit`: the crack is a line that
//! grows where the J-integral, inertia included, reaches the toughness.

mod cases;
mod damage;
mod growth;
mod line;
mod pictures;
mod run;

use fissure_study::{Overrides, Parameter, Parameters, Report, Study, StudyError};

/// The study `edge-notch`.
pub struct EdgeNotch;

impl Study for EdgeNotch {
    fn name(&self) -> &'static str {
        "edge-notch"
    }

    fn about(&self) -> &'static str {
        "onset, length and speed of a crack from an edge notch as a line or under damage mechanics [Nairn 2017, sec. 3.2]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        cases::parameters()
    }

    fn default_cases(&self, settings: &Overrides, quick: bool) -> Vec<Overrides> {
        cases::default_cases(settings, quick)
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        run::run(cases, report)
    }
}
