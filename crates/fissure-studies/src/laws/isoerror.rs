//! Isoerror maps (P20): what one step loses against many, over a plane of increments.

use fissure::io::plot::ScatterPlot;

use fissure_laws::{Map, NAMES, OWN, POSITIVE, Space};

use fissure_study::{Overrides, Parameter, Parameters, Permitted, Report, Row, Study, StudyError};

use super::chosen::{self, Chosen, number_or};

/// The study `isoerror`.
pub struct Isoerror;

/// Errors below this are round-off, and one colour.
const LEAST: f64 = 1e-16;

/// Errors that are none of the law's.
const ROUND_OFF: f64 = 1e-9;

impl Study for Isoerror {
    fn name(&self) -> &'static str {
        "isoerror"
    }

    fn about(&self) -> &'static str {
        "stress after one step against many, over normal and shear increments of ±5 natural strains"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = chosen::parameters("decohesive");
        parameters.push(Parameter {
            name: "band",
            meaning: "width of a crack's band; the law's own is half its limit, or 10 mm",
            unit: "m",
            default: vec![OWN.into()],
            permitted: Permitted::WordOr(OWN, &POSITIVE),
            selects: false,
        });
        parameters.push(
            Parameter::number(
                "level",
                "stretch from which the increments start, in natural strains",
                "1",
                0.0,
                Permitted::numbers(-10.0..=100.0),
            )
            .sweep([0.0, 2.0]),
        );
        parameters.push(Parameter::count(
            "cells",
            "increments each way",
            41,
            Permitted::counts(3..=401),
        ));
        parameters.push(Parameter::count(
            "parts",
            "of the divided step",
            1000,
            Permitted::counts(2..),
        ));
        parameters
    }

    fn default_cases(&self, _: &Overrides, quick: bool) -> Vec<Overrides> {
        let all = Overrides::new().sweep("law", NAMES.iter().copied());
        if quick {
            vec![all.set("cells", 11_u64).set("parts", 50_u64)]
        } else {
            vec![all.sweep("space", Space::NAMES.iter().copied())]
        }
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        for case in chosen::offered(cases)? {
            let chosen = Chosen::of(case)?;
            let (cells, parts) = (case.size("cells")?, case.size("parts")?);
            let band = number_or(case, "band", chosen.law.band())?;
            let level = case.number("level")?;
            let map = chosen.law.isoerror(band, cells, parts, level);
            let row = Row::other("isoerror")
                .field("law", chosen.name())
                .field("level", level)
                .field("increments", map.cells.len())
                .field("refused", map.refused)
                .field("error_max", map.largest)
                .field("error_stated", chosen.law.step_error())
                .parameters(case);
            report.row(row)?;
            if map.largest > chosen.law.step_error() + ROUND_OFF {
                report.note(&format!(
                    "{}: one step is {:e} from many, over what the law states",
                    chosen.name(),
                    map.largest
                ))?;
            }
            if let Some(folder) = report.out_dir() {
                let name = format!("isoerror-{}-from-{level}.png", chosen.name());
                draw(&chosen.name(), level, cells, &map, &folder.join(name))?;
            }
        }
        Ok(())
    }
}

fn draw(
    law: &str,
    level: f64,
    cells: usize,
    map: &Map,
    path: &std::path::Path,
) -> Result<(), StudyError> {
    let points: Vec<[f64; 2]> = map.cells.iter().map(|c| [c.normal, c.shear]).collect();
    let errors: Vec<f64> = map
        .cells
        .iter()
        .map(|cell| cell.error.max(LEAST).log10())
        .map(|error| if error.is_finite() { error } else { f64::NAN })
        .collect();
    let side = 10.0 / (2 * (cells / 2)) as f64;
    ScatterPlot::new(
        &format!("One step against many: {law}, from {level} natural strains"),
        &points,
    )
    .colour("log10 of error [-]", errors)
    .range(LEAST.log10(), 0.0)
    .particle_size(side)
    .labels(
        "normal increment, natural strains [-]",
        "shear increment, natural strains [-]",
    )
    .save(path)
    .map_err(StudyError::failed(format!("drawing {}", path.display())))
}
