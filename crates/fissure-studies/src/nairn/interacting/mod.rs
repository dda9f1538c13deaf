//! An edge crack that runs into a second one [Nairn 2017, sec. 3.2, fig. 7].
//!
//! The notched plate of `edge-notch` has a second crack across the way of the first. `mode=explicit`: both are lines that grow
//! where J reaches the toughness, by the largest hoop stress; the first is arrested at the second, whose tips start
//! later. `mode=damage`: both are lines that stay as they are, in a material that fails in tension and shear alike. The
//! document does not say where the second crack is: 20 mm, its middle on the first one's line at x = 37.5 mm by default.

mod pictures;
mod run;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, Report, Study, StudyError};

use super::conjugate::StressMeasure;
use super::numerics::Numerics;
use super::plate::Plate;
use super::tips::Tips;

/// The study `interacting-cracks`.
pub struct InteractingCracks;

impl Study for InteractingCracks {
    fn name(&self) -> &'static str {
        "interacting-cracks"
    }

    fn about(&self) -> &'static str {
        "an edge crack is arrested at a second crack, which then grows [Nairn 2017, fig. 7]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let positive = || Permitted::above(0.0);
        let mut parameters = vec![Parameter::choice(
            "mode",
            "how cracks grow",
            "explicit",
            &["explicit", "damage"],
        )];
        parameters.extend(Numerics::parameters(1e-3));
        parameters.extend(Plate::parameters());
        parameters.extend(Tips::parameters("hoop"));
        parameters.extend([
            StressMeasure::parameter(),
            Parameter::number("toughness", "in opening", "J/m2", 2000.0, positive()),
            Parameter::number(
                "second",
                "length of the second crack",
                "m",
                0.02,
                positive(),
            ),
            Parameter::number("place", "of the second crack", "m", 0.0375, positive()),
            Parameter::number("end", "of the run", "s", 3e-4, positive()),
        ]);
        parameters
    }

    fn default_cases(&self, settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let explicit = Overrides::new();
        let damage = Overrides::new()
            .set("mode", "damage")
            .set("toughness", 600.0)
            .set("end", 2e-4);
        if quick {
            // Half the plate, a coarser grid, a fast pull.
            return vec![
                explicit
                    .set("width", 0.03)
                    .set("height", 0.04)
                    .set("crack", 0.012)
                    .set("second", 0.01)
                    .set("place", 0.02)
                    .set("toughness", 600.0)
                    .set("end", 9e-5),
            ];
        }
        if settings.get("mode").is_some() {
            return vec![explicit];
        }
        vec![explicit, damage]
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        run::run(cases, report)
    }
}
