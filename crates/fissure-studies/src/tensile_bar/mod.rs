//! The tensile bar of Sanchez 2010, ch. 5: an elastic-decohesive bar pulled apart on a grid that
//! may be turned against it.

mod cases;
mod elastic;
mod pictures;
mod softening;

use fissure_study::{Overrides, Parameter, Parameters, Report, SimulationRow, Study, StudyError};

use crate::bar::{Bar, break_bar, row};
use crate::method::on_threads;
use crate::problem::Runs;

const NAME: &str = "tensile-bar";

/// The study `tensile-bar`.
pub struct TensileBar;

impl Study for TensileBar {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "load, work and dissipation of a bar that breaks at a weak line, against the exact curve [Sanchez 2010, ch. 5]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        cases::parameters()
    }

    fn default_cases(&self, settings: &Overrides, quick: bool) -> Vec<Overrides> {
        cases::default_cases(settings, quick)
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        let is_elastic = |case: &&Parameters| case.choice("case").is_ok_and(|c| c == "elastic");
        let (elastic, softening): (Vec<_>, Vec<_>) = cases.iter().partition(is_elastic);
        softening::run(&softening, report)?;
        elastic::run(&elastic, report)
    }
}

impl Runs for TensileBar {
    fn run_case(&self, case: &Parameters) -> Result<SimulationRow, StudyError> {
        let bar = Bar::new(case)?;
        let finished = on_threads(case, || break_bar(&bar, case, None))?;
        row(NAME, &bar, case, &finished)
    }
}
