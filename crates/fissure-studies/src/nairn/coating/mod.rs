//! Microcracks in a brittle coating on a soft substrate [Nairn 2017, sec. 3.3, fig. 8].

mod cases;
mod count;
mod pictures;
mod run;

use fissure_study::{Overrides, Parameter, Parameters, Report, Study, StudyError};

/// The study `coating`.
pub struct Coating;

impl Study for Coating {
    fn name(&self) -> &'static str {
        "coating"
    }

    fn about(&self) -> &'static str {
        "cracks of a brittle coating on a soft substrate against strain, and what the transfer does to them [Nairn 2017, sec. 3.3]"
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
