//! Bars pulled and compressed [Nairn 2017, sec. 3.1, figs 3 and 4]: one that breaks, one that necks
//! because its shear strength is low, one that shears under compression, and three in space.

mod bar;
mod cases;
mod neck;
mod pictures;
mod run;

use fissure_study::{Overrides, Parameter, Parameters, Report, Study, StudyError};

/// The study `uniaxial`.
pub struct Uniaxial;

impl Study for Uniaxial {
    fn name(&self) -> &'static str {
        "uniaxial"
    }

    fn about(&self) -> &'static str {
        "bars that break, neck and shear, in the plane and in space, under anisotropic damage [Nairn 2017, sec. 3.1]"
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
