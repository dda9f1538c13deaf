//! Does the fracture energy that a compact-tension test measures grow with the specimen? [Sanchez 2010, app. C]
//!
//! The document lets every point of the notch line crack on up to 20 planes that each may dissipate `G_f`, and finds that
//! what the planes dissipate that never fail grows with the ligament: 147, 165, 178 J/m² for 15, 30, 60 cm at 122.7 J/m².
//! `failure=ideal` allows the plane across the ligament alone.
//!
//! The document's 61.35 J/m² over a band of h/2 is 122.7 over a band of h (both columns of points in a cell fail): here the
//! band is the cell and the toughness what a crack dissipates.

mod specimen;

use std::collections::BTreeMap;
use std::time::Instant;

use fissure::diagnostics::{EnergyBalance, state_hash};
use fissure::io::plot::{LinePlot, ScatterPlot, Style};
use fissure::prelude::*;
use fissure_study::{
    Measures, Overrides, Parameter, Parameters, Permitted, Report as Rows, SimulationRow, Study,
    StudyError,
};

use self::specimen::{Failure, GRIPS, LINE, Specimen};
use crate::method::{self, Method, on_threads};
use crate::problem::Runs;

/// The study `compact-tension`.
pub struct CompactTension;

const NAME: &str = "compact-tension";

/// Ligament, m, energy over the ligament's area, J/m², and the share of failed planes [table C.2].
const TABLE: [(f64, f64, f64); 3] = [
    (0.15, 147.0, 0.82),
    (0.30, 165.0, 0.69),
    (0.60, 178.0, 0.58),
];

/// A run and what it leaves for pictures.
struct Finished {
    row: SimulationRow,
    /// mm against kN.
    curve: Vec<[f64; 2]>,
    scene: Scene<2>,
    stopped: Option<String>,
}

impl Study for CompactTension {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "a notched block of concrete pulled apart: does the energy per area grow with its size? [Sanchez 2010, app. C]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = method::parameters(&[0.015], &["explicit", "quasi-static"]);
        for parameter in &mut parameters {
            match parameter.name {
                "steps" => parameter.default = vec![400_u64.into()],
                "tolerance" => parameter.default = vec![1e-5.into()],
                _ => {}
            }
        }
        let positive = || Permitted::above(0.0);
        parameters.extend([
            Parameter::number("ligament", "length b of the ligament", "m", 0.15, positive()),
            Parameter::choice("failure", "planes on which the notch line may fail", "multiple", &["multiple", "ideal"]),
            Parameter::choice("faces", "shear along an open plane (multiple): as in sound material (the document; ideal always), none, or falling with the traction", "elastic", &["elastic", "free", "damaged"]),
            Parameter::number("threshold", "least angle between planes of a point", "degrees", 15.0, Permitted::between(0.0, 90.0)),
            Parameter::choice("grip", "where the rigid points are: on a line of the grid, about which the arms turn, or in a cell, which holds them", "line", &["line", "cell"]),
            Parameter::number("notch", "depth of the notch over b", "1", 1.0, positive()),
            Parameter::number("half", "width of either half over b", "1", 0.7, positive()),
            Parameter::number("depth", "of the specimen, out of the plane", "m", 0.12, positive()),
            Parameter::number("speed", "of either point", "m/s", 0.04, positive()),
            Parameter::number("rise", "time over which the speed rises (explicit)", "s", 2e-3, positive()),
            Parameter::number("elongation", "at the end, in critical openings", "1", 12.0, positive()),
            Parameter::number("young", "Young's modulus", "Pa", 24.9e9, positive()),
            Parameter::number("poisson", "Poisson's ratio", "1", 0.18, Permitted::between(-1.0, 0.5)),
            Parameter::number("density", "mass density", "kg/m3", 2350.0, positive()),
            Parameter::number("strength", "tensile strength", "Pa", 2.7e6, positive()),
            Parameter::number("toughness", "fracture energy of a plane", "J/m2", 122.7, positive()),
        ]);
        parameters
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        if quick {
            return vec![
                Overrides::new()
                    .set("h", 0.025)
                    .set("elongation", 6.0)
                    .set("speed", 0.1)
                    .sweep("failure", ["ideal", "multiple"]),
            ];
        }
        // Until next to nothing is carried, or all of one plane has failed; what turns with the halves opens in proportion to b.
        let sizes = [(0.15, 0.015), (0.3, 0.02), (0.6, 0.025)];
        let mut cases = Vec::new();
        for (ligament, h) in sizes {
            let to = |openings: f64| {
                Overrides::new()
                    .set("ligament", ligament)
                    .set("h", h)
                    .set("elongation", openings * ligament / 0.15)
            };
            cases.push(to(16.0).set("failure", "ideal"));
            cases.push(to(40.0).sweep("faces", ["free", "elastic"]));
        }
        cases
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        let mut curves: BTreeMap<&'static str, LinePlot<'static>> = BTreeMap::new();
        for (number, case) in cases.iter().enumerate() {
            rows.progress(&format!(
                "{} of {}: {}",
                number + 1,
                cases.len(),
                case.label()
            ));
            let finished = pull(case)?;
            rows.row(finished.row.clone())?;
            if let Some(reason) = &finished.stopped {
                rows.note(&format!("the run above stopped early: {reason}"))?;
            }
            if let Some(folder) = rows.out_dir() {
                let kind = case.choice("failure")?;
                let kind = if kind == "ideal" { "ideal" } else { "multiple" };
                let plot = curves.remove(kind).unwrap_or_else(|| {
                    LinePlot::new(&format!("Load against elongation, {kind}"))
                        .x_label("elongation [mm]")
                        .y_label("load [kN]")
                });
                let (x, y): (Vec<f64>, Vec<f64>) =
                    finished.curve.iter().map(|[x, y]| (*x, *y)).unzip();
                let label = case.label_without(&["failure", "elongation"]);
                curves.insert(kind, plot.series(&label, x, y, Style::Line));
                draw(
                    &finished,
                    case,
                    &folder.join(format!("planes-{number}.png")),
                )?;
            }
        }
        if let Some(folder) = rows.out_dir() {
            for (kind, plot) in curves {
                let path = folder.join(format!("load-{kind}.png"));
                plot.save(&path)
                    .map_err(StudyError::failed("drawing the load"))?;
            }
        }
        Ok(())
    }
}

impl Runs for CompactTension {
    fn run_case(&self, case: &Parameters) -> Result<SimulationRow, StudyError> {
        Ok(pull(case)?.row)
    }
}

fn pull(case: &Parameters) -> Result<Finished, StudyError> {
    on_threads(case, || {
        let method = Method::of(case)?;
        let specimen = Specimen::new(case, &method)?;
        let mut scene = specimen.scene()?;
        let elongation = case.number("elongation")? * specimen.critical_opening();
        let end = specimen.time_at(elongation);
        let mut solver = method.build(specimen.grid()?, BandSource::default(), end)?;
        let (mut curve, mut stopped) = (vec![[0.0, 0.0]], None);
        let start = Instant::now();
        while scene.time() < end {
            match solver.step(&mut scene, end) {
                Ok(_) => curve.push([specimen.elongation(scene.time()), load(&scene)]),
                Err(error) if scene.step() == 0 => {
                    return Err(StudyError::failed("taking the first step")(error));
                }
                Err(error) => {
                    stopped = Some(error.to_string());
                    break;
                }
            }
        }
        let wall_s = start.elapsed().as_secs_f64();
        let row = row(case, &specimen, &scene, &curve, wall_s);
        let curve = curve.iter().map(|[x, p]| [1e3 * x, 1e-3 * p]).collect();
        Ok(Finished {
            row,
            curve,
            scene,
            stopped,
        })
    })
}

/// What both points pull with, N.
fn load(scene: &Scene<2>) -> f64 {
    let [left, right] = GRIPS.map(|grip| scene.reaction(grip).map_or(f64::NAN, |force| force.x));
    0.5 * (right - left)
}

fn row(
    case: &Parameters,
    specimen: &Specimen,
    scene: &Scene<2>,
    curve: &[[f64; 2]],
    wall_s: f64,
) -> SimulationRow {
    let mut row = SimulationRow::new(NAME, case);
    if row.solver == "quasi-static" {
        row.transfer.clear();
    }
    row.particles = scene.particle_count() as u64;
    row.steps = scene.step();
    row.wall_s = wall_s;
    row.state_hash = state_hash(scene);
    let area = specimen.area();
    let balance = EnergyBalance::of(scene.energy());
    let peak = curve.iter().fold(0.0, |most: f64, [_, p]| most.max(*p));
    let last = curve[curve.len() - 1];
    let work: f64 = curve
        .windows(2)
        .map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0]))
        .sum();
    let planes = Planes::of(scene, specimen);
    row.errors = Measures::new();
    if specimen.failure == Failure::Ideal {
        // What is dissipated over what has failed, all that has opened counted by its share.
        let error = balance.dissipated / (specimen.toughness * area * planes.cracked) - 1.0;
        row.errors.insert("energy_per_area", error.abs());
    }
    row.values = Measures::new()
        .with("energy_per_area", balance.dissipated / area)
        .with("failed_per_area", planes.failed / area)
        .with("unfailed_per_area", planes.unfailed / area)
        .with(
            "failed_share",
            planes.failed / (planes.failed + planes.unfailed),
        )
        .with("failed_ligament", planes.broken)
        .with("most_planes", planes.most)
        .with("peak_load", peak)
        .with("last_load", last[1] / peak)
        .with("elongation", last[0])
        .with("work_per_area", work / area)
        .with("stored_per_area", balance.stored / area)
        .with("kinetic_per_area", balance.kinetic / area)
        .with("energy_imbalance", balance.energy_imbalance())
        .with("transfer_loss", balance.relative_transfer_loss());
    let documents = TABLE
        .iter()
        .find(|(ligament, ..)| *ligament == specimen.ligament);
    if let (Some((_, energy, share)), Failure::Multiple) = (documents, specimen.failure) {
        row.values = row
            .values
            .with("documents_energy", *energy)
            .with("documents_share", *share);
    }
    row
}

/// What the planes of the notch line have come to.
struct Planes {
    /// Energy of failed planes and of the others, J.
    failed: f64,
    unfailed: f64,
    /// Share of the ligament with a failed plane, and share cracked if half-open counts half.
    broken: f64,
    cracked: f64,
    /// Most planes of a point.
    most: f64,
}

impl Planes {
    fn of(scene: &Scene<2>, specimen: &Specimen) -> Self {
        let body = scene.body(LINE);
        let value = |name: &str| body.and_then(|body| body.value(name));
        let volumes = body.map_or(&[][..], |body| &body.particles().volume);
        let sum = |values: Option<Vec<f64>>| -> f64 {
            let values = values.unwrap_or_default();
            values
                .iter()
                .zip(volumes)
                .map(|(value, volume)| value * volume)
                .sum()
        };
        let count = volumes.len() as f64;
        let dissipated = scene.energy().dissipated;
        let full = specimen.toughness * specimen.area();
        match specimen.failure {
            Failure::Ideal => {
                let failed = value("failed").unwrap_or_default();
                let softened = value("softened").unwrap_or_default();
                // Linear softening that stays where it is on unloading has spent `s − s²/4` of the toughness.
                let spent = |s: f64| s - 0.25 * s * s;
                let broken: f64 =
                    failed.iter().filter(|failed| **failed > 0.5).count() as f64 / count;
                let cracked = softened.iter().map(|s| spent(*s)).sum::<f64>() / count;
                Self {
                    failed: broken * full,
                    unfailed: dissipated - broken * full,
                    broken,
                    cracked,
                    most: 1.0,
                }
            }
            Failure::Multiple => {
                let failed = value("failed_planes").unwrap_or_default();
                let broken = failed.iter().filter(|failed| **failed > 0.5).count() as f64 / count;
                let most = value("planes")
                    .unwrap_or_default()
                    .iter()
                    .fold(0.0, |m: f64, n| m.max(*n));
                Self {
                    failed: sum(value("failed_energy")),
                    unfailed: sum(value("unfailed_energy")),
                    broken,
                    cracked: f64::NAN,
                    most,
                }
            }
        }
    }
}

/// The specimen as it has moved, with the openings of its planes.
fn draw(finished: &Finished, case: &Parameters, path: &std::path::Path) -> Result<(), StudyError> {
    let (mut points, mut openings) = (Vec::new(), Vec::new());
    for body in finished.scene.bodies() {
        points.extend(body.motion().position.iter().map(|x| [x.x, x.y]));
        let opening = body.value("opening").unwrap_or_default();
        openings
            .extend((0..body.particles().len()).map(|i| opening.get(i).map_or(0.0, |w| 1e6 * w)));
    }
    ScatterPlot::new(&case.label(), points)
        .colour("largest opening of a point [µm]", openings)
        .particle_size(0.5 * case.number("h")?)
        .labels("x [m]", "y [m]")
        .save(path)
        .map_err(StudyError::failed("drawing the specimen"))
}
