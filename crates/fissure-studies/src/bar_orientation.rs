//! The bar turned against the grid: how much what a crack does depends on the grid [Sanchez 2010, sec. 5.4, 5.5].

use std::path::Path;

use fissure::io::plot::{LinePlot, ScatterPlot, Style};
use fissure::prelude::*;

use fissure_study::{
    Field, Fields, Overrides, Parameter, Parameters, Report as Rows, Row, SimulationRow, Study,
    StudyError, Value,
};

use crate::bar::drawing::{ROWS, draw_bar, sampled};
use crate::bar::{self, BODY, Bar, Finished, OFFSETS, Thinned, break_bar, row};
use crate::drawing::save;
use crate::method::on_threads;

/// The study `bar-orientation`.
pub struct BarOrientation;

const NAME: &str = "bar-orientation";

/// What an ensemble is told by: errors, then values.
const ERRORS: [&str; 2] = ["load_l2", "work"];
const VALUES: [&str; 6] = [
    "dissipated_ratio",
    "stored_end",
    "middle_load",
    "late_load",
    "failed_zone_cells",
    "opened_zone_cells",
];

impl Study for BarOrientation {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "the breaking bar turned against the grid, at eight offsets within a cell, with and without shear on the crack [Sanchez 2010, sec. 5.5]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = bar::parameters(&[0.01]);
        // As in the document: turned, the bar would else break at a grip.
        for parameter in parameters.iter_mut().filter(|p| p.name == "failing") {
            parameter.default = vec![0.5.into()];
        }
        parameters
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let base = || Overrides::new().set("solver", "quasi-static");
        if quick {
            return vec![
                base()
                    .set("h", 0.02)
                    .sweep("angle", [0.0, 45.0])
                    .sweep("law", ["prescribed", "no-shear"])
                    .sweep("offset", [0_u64, 1]),
            ];
        }
        let turned = |fills: &[&'static str]| {
            base()
                .sweep("angle", [0.0, 15.0, 30.0, 45.0])
                .sweep("fill", fills.iter().copied())
        };
        vec![
            turned(&["rotated", "cell"])
                .set("h", 0.01)
                .sweep("law", ["prescribed", "no-shear"])
                .sweep("offset", 0..OFFSETS),
            // The laws between, and finer.
            turned(&["rotated"])
                .set("h", 0.01)
                .sweep("law", ["rankine", "damaged-shear", "rotating"]),
            turned(&["rotated"])
                .set("h", 0.005)
                .sweep("angle", [0.0, 45.0])
                .sweep("law", ["prescribed", "no-shear"]),
            turned(&["rotated"])
                .sweep("h", [0.005, 0.0025])
                .sweep("angle", [15.0, 30.0, 45.0])
                .set("law", "prescribed"),
            // One strain in all of a cell.
            turned(&["rotated"])
                .set("h", 0.01)
                .set("strain", "cell")
                .sweep("law", ["prescribed", "no-shear"]),
            // Where the bar is weaker, sec. 5.4.
            base()
                .sweep("h", [0.02, 0.01, 0.005])
                .sweep("angle", [0.0, 45.0])
                .sweep("weak", ["line", "square", "point"]),
        ]
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        let mut ensembles: Vec<Vec<Run>> = Vec::new();
        for (number, case) in cases.iter().enumerate() {
            let (at, count) = (number + 1, cases.len());
            rows.progress(&format!("{at} of {count}: {}", case.label()));
            let bar = Bar::new(case)?;
            let finished = on_threads(case, || break_bar(&bar, case, None))?;
            let mut row = row(NAME, &bar, case, &finished)?;
            row.values.insert("stored_end", stored_end(&bar, &finished));
            let run = Run {
                case: case.clone(),
                row: row.clone(),
                history: finished.history.thinned(ROWS),
                name: file_name(case),
                stopped: finished.stopped.is_some(),
            };
            rows.row(row)?;
            if let Some(reason) = &finished.stopped {
                rows.note(&format!("the run above stopped early: {reason}"))?;
            }
            if let (Some(folder), 0) = (rows.out_dir(), case.count("offset")?) {
                draw_state(&bar, &finished.scene, &run, folder)?;
            }
            let same =
                |ensemble: &&mut Vec<Run>| but_offset(&ensemble[0].case).eq(but_offset(&run.case));
            match ensembles.iter_mut().find(same) {
                Some(ensemble) => ensemble.push(run),
                None => ensembles.push(vec![run]),
            }
        }
        for ensemble in ensembles.iter().filter(|ensemble| ensemble.len() > 1) {
            rows.row(ensemble_row(ensemble)?)?;
        }
        match rows.out_dir().map(Path::to_path_buf) {
            Some(folder) => {
                draw_curves(&ensembles, &folder)?;
                draw_weak_places(&ensembles, &folder)
            }
            None => Ok(()),
        }
    }
}

/// What is kept of a run.
struct Run {
    case: Parameters,
    row: SimulationRow,
    history: Thinned,
    name: String,
    /// Whether it ended before its time.
    stopped: bool,
}

/// Stored energy at the end over that at the peak of the exact curve: what has not been let go.
fn stored_end(bar: &Bar, finished: &Finished) -> f64 {
    let exact = bar.exact();
    finished.scene.energy().stored / exact.stored(exact.peak_elongation() * (1.0 - 1e-12))
}

fn but_offset(case: &Parameters) -> impl Iterator<Item = (&'static str, &Value)> {
    case.iter().filter(|(name, _)| *name != "offset")
}

/// Mean, least and greatest of each measure over the offsets at which the run reached its end.
fn ensemble_row(ensemble: &[Run]) -> Result<Row, StudyError> {
    let case = &ensemble[0].case;
    let ended: Vec<&Run> = ensemble.iter().filter(|run| !run.stopped).collect();
    let mut fields = Fields::new();
    for name in ERRORS.iter().chain(&VALUES) {
        let of = |run: &&Run| run.row.errors.get(name).or(run.row.values.get(name));
        let values: Vec<f64> = ended
            .iter()
            .map(|run| of(run).unwrap_or(f64::NAN))
            .collect();
        let end = |pick: fn(f64, f64) -> f64| {
            let end = values.iter().copied().reduce(pick);
            end.unwrap_or(f64::NAN)
        };
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        fields.insert(format!("{name}_mean"), mean);
        fields.insert(format!("{name}_least"), end(f64::min));
        fields.insert(format!("{name}_greatest"), end(f64::max));
    }
    Ok(Row::other(NAME)
        .field("case", "ensemble")
        .field("angle", case.number("angle")?)
        .field("fill", case.choice("fill")?)
        .field("law", case.choice("law")?)
        .field("weak", case.choice("weak")?)
        .field("h", case.number("h")?)
        .field("runs", Field::from(ensemble.len()))
        .field("stopped", Field::from(ensemble.len() - ended.len()))
        .field("ensemble", Field::Group(fields)))
}

/// Name of a run's files: what varies in this run of the study.
fn file_name(case: &Parameters) -> String {
    case.label().replace([' ', '='], "-")
}

/// Openings and the stress across and along the crack at the end.
fn draw_state(bar: &Bar, scene: &Scene<2>, run: &Run, folder: &Path) -> Result<(), StudyError> {
    let path = |what: &str| folder.join(format!("{what}-{}.png", run.name));
    run.history
        .write(&folder.join(format!("{}.csv", run.name)))?;
    draw_bar(bar, scene, &path("opening"))?;
    let Some(body) = scene.body(BODY) else {
        return Ok(());
    };
    let axis = bar.axis();
    let normal = Vector3::new(axis.x, axis.y, 0.0);
    let along = Vector3::new(-axis.y, axis.x, 0.0);
    let points: Vec<[f64; 2]> = body.motion().position.iter().map(|x| [x.x, x.y]).collect();
    for (name, direction, range) in [
        ("normal", normal, (0.0, 1.0)),
        ("shear", along, (-1.0, 1.0)),
    ] {
        let tractions = body.motion().stress.iter();
        let values: Vec<f64> = tractions
            .map(|stress| stress.traction(&normal).dot(&direction) / bar.strength)
            .collect();
        ScatterPlot::new(
            &format!("Traction on the crack's plane, {name}"),
            points.as_slice(),
        )
        .colour("traction over strength [1]", values)
        .range(range.0, range.1)
        .particle_size(0.5 * bar.spacing)
        .save(path(name))
        .map_err(StudyError::failed("drawing a stress"))?;
    }
    Ok(())
}

/// Load and energies over the elongation, a picture per angle.
fn draw_curves(ensembles: &[Vec<Run>], folder: &Path) -> Result<(), StudyError> {
    let mut angles: Vec<f64> = Vec::new();
    let of_line = |run: &Run| run.case.choice("weak").is_ok_and(|weak| weak == "line");
    let firsts = || ensembles.iter().map(|ensemble| &ensemble[0]);
    for run in firsts().filter(|run| of_line(run)) {
        let angle = run.case.number("angle")?;
        if !angles.contains(&angle) {
            angles.push(angle);
        }
    }
    for angle in angles {
        let chosen: Vec<&Run> = firsts()
            .filter(|run| of_line(run) && run.case.number("angle").is_ok_and(|a| a == angle))
            .collect();
        let exact = Bar::new(&chosen[0].case)?.exact();
        let mut loads = LinePlot::new(&format!("Load of the bar at {angle}°"))
            .x_label("elongation [m]")
            .y_label("load [N]");
        for run in chosen.iter().take(8) {
            let label = run.case.label_without(&["angle", "offset", "weak"]);
            let history = &run.history;
            loads = loads.series(&label, &history.elongation, &history.load, Style::Line);
        }
        let (x, y) = sampled(&exact, |exact, at| exact.load(at));
        let loads = loads.series("exact", x, y, Style::Dashed);
        save(loads, &folder.join(format!("load-{angle}-deg.png")))?;
        let history = &chosen[0].history;
        let mut energies = LinePlot::new(&format!("Energies of the bar at {angle}°"))
            .x_label("elongation [m]")
            .y_label("energy [J]");
        for (name, column) in [
            ("work of fracture", &history.work),
            ("stored", &history.stored),
            ("dissipated", &history.dissipated),
        ] {
            energies = energies.series(name, &history.elongation, column, Style::Line);
        }
        let (x, y) = sampled(&exact, |exact, at| exact.work(at));
        let energies = energies.series("exact work", x, y, Style::Dashed);
        save(energies, &folder.join(format!("energy-{angle}-deg.png")))?;
    }
    Ok(())
}

/// Loads of the bars that are weak in different places beside each other, a picture per spacing and angle.
fn draw_weak_places(ensembles: &[Vec<Run>], folder: &Path) -> Result<(), StudyError> {
    let runs: Vec<&Run> = ensembles.iter().map(|ensemble| &ensemble[0]).collect();
    let is_line = |run: &Run| run.case.choice("weak").is_ok_and(|weak| weak == "line");
    let alike = |a: &Run, b: &Run| {
        let same = |name| a.case.get(name) == b.case.get(name);
        ["h", "angle", "fill", "law", "strain"]
            .into_iter()
            .all(same)
    };
    let mut drawn: Vec<&Run> = Vec::new();
    for &first in runs.iter().filter(|run| !is_line(run)) {
        if drawn.iter().any(|run| alike(run, first)) {
            continue;
        }
        drawn.push(first);
        let bar = Bar::new(&first.case)?;
        let (h, angle) = (first.case.number("h")?, first.case.number("angle")?);
        let title = format!("Load of the bar by where it is weak, h = {h} m, {angle}°");
        let mut loads = LinePlot::new(&title)
            .x_label("elongation [m]")
            .y_label("load [N]");
        for run in runs.iter().filter(|run| alike(run, first)) {
            let history = &run.history;
            let weak = run.case.choice("weak")?;
            loads = loads.series(weak, &history.elongation, &history.load, Style::Line);
        }
        for (name, exact) in [
            ("exact, weak section", bar.exact()),
            ("exact, full strength", bar.nominal()),
        ] {
            let (x, y) = sampled(&exact, |exact, at| exact.load(at));
            loads = loads.series(name, x, y, Style::Dashed);
        }
        save(
            loads,
            &folder.join(format!("load-weak-h-{h}-{angle}-deg.png")),
        )?;
    }
    Ok(())
}
