//! What a crack under damage mechanics costs, and where that goes [Nairn 2017, sec. 3.2].
//!
//! The notched plate, its notch a line, of a material that is damaged in mode I. The document lowers the toughness to 0.3 of
//! an explicit crack's to have the same onset. How much of that is the band that smears the crack, and how much the
//! resolution of its process zone of length `E G_c/σ_n²`, is asked by spacing, band and place of the crack on the grid: per
//! area of the crack's growth what failed particles took, what others took, what the transfer lost, all over the
//! toughness; and J far from the tip, inertia included, when the first particle fails.

mod run;

use fissure_study::{Overrides, Parameter, Parameters, Permitted, Report, Study, StudyError};

use super::conjugate::StressMeasure;
use super::numerics::Numerics;
use super::plate::Plate;

/// The study `apparent-toughness`.
pub struct ApparentToughness;

impl Study for ApparentToughness {
    fn name(&self) -> &'static str {
        "apparent-toughness"
    }

    fn about(&self) -> &'static str {
        "what the growth of a damage crack costs: failed rows, wake, transfer, J at onset [Nairn 2017, sec. 3.2]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let positive = || Permitted::above(0.0);
        let mut parameters = Numerics::parameters(1e-3);
        parameters.extend(Plate::parameters());
        parameters.extend([
            StressMeasure::parameter(),
            Parameter::number("toughness", "in opening", "J/m2", 600.0, positive()),
            Parameter::number(
                "radius",
                "of the domain of J, half of it free of weight",
                "m",
                0.01,
                positive(),
            ),
            Parameter::number("end", "of the run", "s", 1.5e-4, positive()),
        ]);
        parameters
    }

    fn default_cases(&self, _: &Overrides, quick: bool) -> Vec<Overrides> {
        if quick {
            return vec![
                Overrides::new()
                    .set("width", 0.02)
                    .set("height", 0.04)
                    .set("crack", 0.01)
                    .set("radius", 0.005)
                    .set("end", 6e-5),
            ];
        }
        let spacings = [2e-3, 1e-3, 0.5e-3];
        vec![
            Overrides::new()
                .sweep("h", spacings)
                .sweep("band", ["particle", "discretisation"])
                .sweep("line", ["cells", "nodes"]),
        ]
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        run::run(cases, report)
    }
}
