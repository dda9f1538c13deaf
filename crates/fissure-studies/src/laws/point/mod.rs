//! One material point: a law, a path, a table and a picture.

mod paths;
mod picture;

use fissure::materials::EventKind;
use fissure::tensor::Sym;

use fissure_laws::{Followed, Happened, OWN, POSITIVE, Reached};

use fissure_study::{Overrides, Parameter, Parameters, Permitted, Report, Row, Study, StudyError};

use super::chosen::{self, Chosen, number_or};

/// The study `point`.
pub struct PointStudy;

/// Steps of a leg: any number, or what suits the path.
const STEPS: Permitted = Permitted::Counts(
    std::ops::Bound::Included(1),
    std::ops::Bound::Included(1_000_000),
);
/// A strain of any sign.
const STRAIN: Permitted =
    Permitted::Numbers(std::ops::Bound::Unbounded, std::ops::Bound::Unbounded);

impl Study for PointStudy {
    fn name(&self) -> &'static str {
        "point"
    }

    fn about(&self) -> &'static str {
        "one material point along a path: stress, cracking strain, energies and state, row by row"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let own = |name, meaning, unit, permitted: &'static Permitted| Parameter {
            name,
            meaning,
            unit,
            default: vec![OWN.into()],
            permitted: Permitted::WordOr(OWN, permitted),
            selects: false,
        };
        let mut parameters = chosen::parameters("decohesive");
        parameters.extend([
            own(
                "band",
                "width of a crack's band; own: half the law's limit, or 10 mm",
                "m",
                &POSITIVE,
            ),
            Parameter::choice(
                "path",
                "what the point is put through; csv: the deformation gradients of a file",
                "uniaxial-stress",
                paths::NAMES,
            ),
            own(
                "to",
                "strain at the far end of the path; own: a little beyond failure",
                "1",
                &STRAIN,
            ),
            own(
                "steps",
                "of each leg; own: 200, on a walk 10, from a file 1",
                "1",
                &STEPS,
            ),
            Parameter::count(
                "legs",
                "round trips of a cycle, legs of a walk",
                5,
                Permitted::counts(1..=1_000_000),
            ),
            Parameter::count("seed", "of a walk", 1, Permitted::counts(..)),
            Parameter {
                name: "file",
                meaning: "CSV of deformation gradients, columns Fxx to Fzz; missing ones are of the identity",
                unit: "",
                default: vec!["".into()],
                permitted: Permitted::Text,
                selects: false,
            },
            Parameter::count(
                "halvings",
                "of a step that the law refuses or that finds no equilibrium",
                10,
                Permitted::counts(0..=40),
            ),
            own(
                "tolerance",
                "change of the stress on halving beyond which a step is halved; own: none",
                "Pa",
                &POSITIVE,
            ),
            Parameter::count(
                "every",
                "of so many samples a row",
                1,
                Permitted::counts(1..=1_000_000),
            ),
        ]);
        parameters
    }

    fn default_cases(&self, _: &Overrides, quick: bool) -> Vec<Overrides> {
        if quick {
            vec![Overrides::new().set("steps", 20_u64)]
        } else {
            vec![Overrides::new()]
        }
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        for (index, case) in cases.iter().enumerate() {
            let name = if cases.len() == 1 {
                "stress-strain.png".to_owned()
            } else {
                format!("stress-strain-{}.png", index + 1)
            };
            follow(case, &name, report)?;
        }
        Ok(())
    }
}

/// Follows the path of one case.
fn follow(case: &Parameters, picture: &str, report: &mut Report<'_>) -> Result<(), StudyError> {
    let chosen = Chosen::of(case)?;
    let band = number_or(case, "band", chosen.law.band())?;
    let path = paths::path(case, &chosen, band)?;
    let followed = chosen.law.follow(&path);
    report.progress(&format!(
        "{}: {}, band = {band} m",
        chosen.name(),
        chosen.values.told()
    ));
    let every = case.size("every")?;
    let last = followed.samples.len();
    for (index, reached) in followed.samples.iter().enumerate() {
        if (index + 1).is_multiple_of(every) || index + 1 == last {
            report.row(row(&chosen, case, &followed, reached))?;
        }
    }
    for event in &followed.events {
        report.row(event_row(&chosen, case, event))?;
    }
    if let (Some(folder), false) = (report.out_dir(), followed.samples.is_empty()) {
        picture::draw(&chosen.name(), &followed, &folder.join(picture))?;
    }
    match followed.stopped {
        Some(error) => Err(StudyError::failed("following the path")(error)),
        None => Ok(()),
    }
}

fn row(chosen: &Chosen<'_>, case: &Parameters, followed: &Followed, reached: &Reached) -> Row {
    let mut row = Row::other("point")
        .field("law", chosen.name())
        .field("leg", reached.leg)
        .field("step", reached.step)
        .field("time", reached.time);
    row = tensor(row, "strain", &reached.strain);
    row = tensor(row, "stress", &reached.stress);
    if let Some(crack_strain) = &reached.crack_strain {
        row = tensor(row, "cracking", crack_strain);
    }
    let [stored, dissipated, work] = reached.energies;
    row = row
        .field("stored", stored)
        .field("dissipated", dissipated)
        .field("work", work);
    for (name, value) in followed.names.iter().zip(&reached.values) {
        row = row.field(*name, *value);
    }
    row.parameters(case)
}

fn event_row(chosen: &Chosen<'_>, case: &Parameters, event: &Happened) -> Row {
    let kind = match event.kind {
        EventKind::Initiation => "initiation",
        EventKind::Failure => "failure",
        EventKind::Contact => "contact",
    };
    let mut row = Row::other("point")
        .field("law", chosen.name())
        .field("event", kind)
        .field("crack", event.crack)
        .field("leg", event.reached.leg)
        .field("fraction", event.fraction)
        .field("time", event.reached.time);
    row = tensor(row, "strain", &event.reached.strain);
    row = tensor(row, "stress", &event.reached.stress);
    row.field("dissipated", event.reached.energies[1])
        .parameters(case)
}

/// Adds the six components of a tensor.
fn tensor(mut row: Row, name: &str, tensor: &Sym) -> Row {
    for (component, value) in components(tensor) {
        row = row.field(format!("{name}_{component}"), value);
    }
    row
}

/// The six components with their names.
fn components(tensor: &Sym) -> [(&'static str, f64); 6] {
    [
        ("xx", tensor.xx()),
        ("yy", tensor.yy()),
        ("zz", tensor.zz()),
        ("yz", tensor.yz()),
        ("xz", tensor.xz()),
        ("xy", tensor.xy()),
    ]
}
