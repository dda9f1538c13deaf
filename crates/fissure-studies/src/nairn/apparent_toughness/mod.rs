//! What a crack under damage mechanics costs, and where that goes [Nairn 2017, sec. 3.2].
//!
//! The notched plate, its notch a line, of a material that is damaged in mode I. The document lowers the toughness to 0.3 of
//! an explicit crack's to have the same onset. How much of that is the band that smears the crack, and how much the
//! resolution of its process zone of length `E G_c/σ_n²`, is asked by spacing, band and place of the crack on the grid: per
//! area of the crack's growth what failed particles took, what others took, what the transfer lost, all over the
//! toughness; and J far from the tip when the first particle fails: with inertia, the ends pulled as in the document, or
//! in equilibrium, step by step of the energy dissipated.

mod cost;
mod pictures;
mod run;

use fissure_study::{
    Overrides, Parameter, Parameters, Permitted, Report, Study, StudyError, Value,
};

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
        let mut parameters = vec![Parameter::choice(
            "solver",
            "time integration; of a quasi-static run transfer, order, stress, cfl and end say nothing",
            "explicit",
            &["explicit", "quasi-static"],
        )];
        parameters.extend(Numerics::parameters(1e-3));
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
            Parameter::number("end", "of an explicit run", "s", 1.5e-4, positive()),
            Parameter::number("growth", "at which a run ends", "m", 0.02, positive()),
            Parameter::number(
                "share",
                "energy of a quasi-static step over what one particle takes to fail",
                "1",
                2.0,
                positive(),
            ),
        ]);
        parameters
    }

    fn default_cases(&self, settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let small = |set: Overrides| {
            set.set("width", 0.02)
                .set("height", 0.04)
                .set("crack", 0.01)
        };
        if quick {
            let moving = small(Overrides::new()).set("radius", 0.005);
            let still = || still(small);
            return vec![
                moving.set("end", 6e-5).set("growth", 6e-3),
                still().set("h", 2e-3),
                physical(still()).set("strength", 20e6).set("growth", 1e-3),
            ];
        }
        let all = |spacings: &[f64], bands: &[&'static str]| {
            Overrides::new()
                .sweep("h", spacings.iter().copied())
                .sweep("band", bands.iter().copied())
                .sweep("line", ["cells", "nodes"])
        };
        let asked = settings.get("solver");
        let is_asked =
            |name: &str| asked.is_none_or(|all| all.contains(&Value::Choice(name.to_owned())));
        let mut cases = Vec::new();
        if is_asked("explicit") {
            // Cells of 2 mm are over the limit of equation 36 as a band.
            cases.push(all(&[2e-3], &["particle"]));
            cases.push(all(&[1e-3, 0.5e-3], &["particle", "discretisation"]));
        }
        if is_asked("quasi-static") {
            let still = || still(small);
            let weaker = || physical(still()).set("strength", 20e6);
            cases.extend([
                still().sweep("line", ["cells", "nodes"]),
                weaker(),
                // With shorter steps this one ends at half the growth.
                weaker().set("line", "nodes").set("share", 2.0),
                physical(still()).set("h", 0.5e-3),
            ]);
        }
        cases
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        run::run(cases, report)
    }
}

/// Growth in equilibrium, in a plate that is small enough for it. Splines, whose nodes all hold something of what has not
/// failed; and steps of one or two particles' energy: with shorter ones there are loads between at which no equilibrium is near.
fn still(small: impl Fn(Overrides) -> Overrides) -> Overrides {
    small(Overrides::new())
        .set("solver", "quasi-static")
        .set("shape", "bspline2")
        .set("radius", 8e-3)
        .set("growth", 3.6e-3)
}

/// With the toughness kept physical, where shorter steps do.
fn physical(cases: Overrides) -> Overrides {
    cases.set("band", "discretisation").set("share", 1.0)
}
