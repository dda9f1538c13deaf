//! The strength of a block under compression whose material varies from place to place
//! [Nairn 2017, sec. 3.4, figs 9 to 11]: a Monte Carlo study.

mod block;
mod cases;
mod pictures;
mod run;
mod samples;
mod statistics;

use fissure_study::{Overrides, Parameter, Parameters, Report, Study, StudyError};

/// The study `random-block`.
pub struct RandomBlock;

impl Study for RandomBlock {
    fn name(&self) -> &'static str {
        "random-block"
    }

    fn about(&self) -> &'static str {
        "mean and scatter of a block's strength from random fields of strength, with tests [Nairn 2017, sec. 3.4]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        cases::parameters()
    }

    fn default_cases(&self, settings: &Overrides, quick: bool) -> Vec<Overrides> {
        cases::default_cases(settings, quick)
    }

    fn full_cases(&self, _settings: &Overrides) -> Option<Vec<Overrides>> {
        Some(vec![cases::full_case()])
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        run::run(cases, report)
    }
}
