//! The tensile bar of Sanchez 2010, ch. 5: an elastic-decohesive bar pulled apart on a grid that
//! may be turned against it.

mod bar;
mod cases;
mod elastic;
mod exact;
mod history;
mod pictures;
mod softening;

use fissure_study::{Overrides, Parameter, Parameters, Report, Study, StudyError};

/// The study `tensile-bar`.
pub struct TensileBar;

impl Study for TensileBar {
    fn name(&self) -> &'static str {
        "tensile-bar"
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
