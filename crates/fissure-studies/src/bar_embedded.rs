//! The bar turned against the grid, with the crack embedded in the cells it crosses [Sanchez 2010, sec. 5.5.4].
//!
//! The body is elastic; the crack is a line across its middle. Both ends are clamped: once the crack is through it holds the halves no
//! more, and on rollers nothing else keeps them from drifting along it. What the clamps do to the stress and to the length
//! between the grips is left out by a gauge over the middle half of the bar, as by an extensometer. Particles are by default in the
//! middle of what the sides leave of quarter cells, so that a uniform stress is in equilibrium (`filling::cut`).

use std::path::Path;

use fissure::io::plot::{LinePlot, ScatterPlot, Style};
use fissure::materials::{TractionSeparation, softening};
use fissure::prelude::*;

use fissure_study::{
    Overrides, Parameter, Parameters, Permitted, Report as Rows, SimulationRow, Study, StudyError,
};

use crate::bar::drawing::{ROWS, sampled};
use crate::bar::{self, Bar, Exact, Gauge, OFFSETS, Pull, Thinned, measured};
use crate::drawing::save;
use crate::method::{Method, on_threads};

/// The study `bar-embedded`.
pub struct BarEmbedded;

const NAME: &str = "bar-embedded";

/// Up to where loads over the gauge are compared, over the critical opening: a bar that keeps its load strains outside of it.
const COMPARED: f64 = 1.05;

impl Study for BarEmbedded {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "the breaking bar turned against the grid, its crack a discontinuity within the cells [Sanchez 2010, sec. 5.5.4]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = bar::parameters_of(&[0.01], &["quasi-static"]);
        // Of one strain per cell, which it has not, and of inertia.
        parameters.retain(|parameter| !["hourglass", "ramp"].contains(&parameter.name));
        for parameter in &mut parameters {
            let only = |name: &'static [&'static str]| {
                Parameter::choice(parameter.name, parameter.meaning, name[0], name)
            };
            match parameter.name {
                "tolerance" => parameter.default = vec![1e-6.into()],
                "fill" => parameter.default = vec!["cut".into()],
                "ends" => parameter.default = vec!["clamped".into()],
                "gap" => parameter.default = vec![0.0.into()],
                "shape" => *parameter = only(&["linear"]),
                "strain" => *parameter = only(&["particle"]),
                "band" => *parameter = only(&["discretisation"]),
                "weak" => *parameter = only(&["line"]),
                "law" => *parameter = only(&["elastic"]),
                _ => {}
            }
        }
        parameters.push(Parameter::choice(
            "form",
            "what opens the crack of a cell: the mean traction in it, or that of a point in its middle as the document has it",
            "optimal",
            &["optimal", "local"],
        ));
        parameters.push(Parameter::number(
            "stiffness",
            "of the crack before it opens, over E/h",
            "1",
            200.0,
            Permitted::above(0.0),
        ));
        parameters.push(Parameter::number(
            "stabilisation",
            "rate of a viscous force against what nothing else holds",
            "1/s",
            0.0,
            Permitted::at_least(0.0),
        ));
        parameters
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        // The local form in cells with particles at the same places, as in the document.
        let local = || Overrides::new().set("form", "local").set("fill", "cell");
        if quick {
            return vec![
                Overrides::new().set("h", 0.02).sweep("angle", [0.0, 30.0]),
                local().set("h", 0.02).sweep("angle", [0.0, 5.0]),
            ];
        }
        let turned = || Overrides::new().sweep("angle", [0.0, 15.0, 30.0, 45.0]);
        vec![
            turned().set("h", 0.01).sweep("offset", 0..OFFSETS),
            turned().sweep("h", [0.02, 0.005]),
            turned().set("h", 0.01).sweep("fill", ["cell", "rotated"]),
            local()
                .set("h", 0.01)
                .sweep("angle", [0.0, 1.0, 3.0, 5.0, 15.0, 30.0, 45.0]),
        ]
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        let mut drawn: Vec<Drawn> = Vec::new();
        for (number, case) in cases.iter().enumerate() {
            let (at, count) = (number + 1, cases.len());
            rows.progress(&format!("{at} of {count}: {}", case.label()));
            let run = on_threads(case, || break_embedded(case))?;
            rows.row(run.row.clone())?;
            if let Some(reason) = &run.stopped {
                rows.note(&format!("the run above stopped early: {reason}"))?;
            }
            if case.count("offset")? != 0 {
                continue;
            }
            if let Some(folder) = rows.out_dir() {
                let name = case.label().replace([' ', '='], "-");
                run.history.write(&folder.join(format!("{name}.csv")))?;
                run.draw(&folder.join(format!("shear-{name}.png")))?;
            }
            drawn.push(Drawn {
                case: case.clone(),
                history: run.history,
                exact: run.exact,
            });
        }
        match rows.out_dir().map(Path::to_path_buf) {
            Some(folder) => draw_loads(&drawn, &folder),
            None => Ok(()),
        }
    }
}

/// What is kept of a run.
struct Run {
    row: SimulationRow,
    /// Over the elongation of the gauge, and the exact response of a bar of its length.
    history: Thinned,
    exact: Exact,
    spacing: f64,
    stopped: Option<String>,
    /// Places of the particles, m, and shear traction along the crack's plane over strength.
    shear: (Vec<[f64; 2]>, Vec<f64>),
}

/// A run for the pictures of loads.
struct Drawn {
    case: Parameters,
    history: Thinned,
    exact: Exact,
}

fn break_embedded(case: &Parameters) -> Result<Run, StudyError> {
    let bar = Bar::new(case)?;
    let method = Method::of(case)?;
    let pull = Pull::new(&bar, case, &method)?;
    let settings = QuasiStaticSettings {
        step: pull.end() / method.steps as f64,
        tolerance: method.tolerance,
        stabilisation: case.number("stabilisation")?,
        ..QuasiStaticSettings::default()
    };
    let crack = crack(&bar, case)?;
    let solver = QuasiStatic::new(pull.grid.clone(), shape::Linear, settings);
    let mut solver = solver
        .and_then(|solver| solver.with_embedded(crack))
        .map_err(StudyError::failed("setting up the solver"))?;
    let axis = bar.axis();
    let mut gauge = Gauge::new(&bar, &pull.scene);
    let finished = pull.break_with(&mut solver, case, &axis, Some(&mut gauge))?;
    let mut row = measured(NAME, &bar, case, &finished);
    over_gauge(&mut row, &bar, &gauge);
    let jumps = solver.embedded_jumps();
    let failed = jumps.iter().filter(|cell| cell.dissipated_fraction >= 0.5);
    let area: f64 = jumps.iter().map(|cell| cell.area).sum();
    row.values.insert("failed_cells", failed.count() as f64);
    row.values.insert("cut_cells", jumps.len() as f64);
    row.values.insert("crack_area", area / bar.exact().area);
    let shear = shears(&bar, &finished.scene);
    let greatest = shear.iter().map(|shear| shear.abs()).fold(0.0, f64::max);
    row.values.insert("greatest_shear", greatest);
    let places = finished.scene.bodies()[0].motion().position.iter();
    Ok(Run {
        row,
        history: gauge.history.thinned(ROWS),
        exact: gauge.exact(&bar),
        spacing: bar.spacing,
        stopped: finished.stopped,
        shear: (places.map(|x| [x.x, x.y]).collect(), shear),
    })
}

/// The crack in the middle of the line that is weak in the other studies of the bar.
fn crack(bar: &Bar, case: &Parameters) -> Result<EmbeddedCrack, StudyError> {
    let exact = bar.exact();
    Ok(EmbeddedCrack {
        point: bar.middle_of_line().into(),
        normal: bar.axis().into(),
        law: TractionSeparation {
            strength: exact.strength,
            toughness: exact.toughness,
            stiffness: case.number("stiffness")? * bar.elastic.young / bar.spacing,
            shear_weight: 1.0,
            softening: softening::Linear,
        },
        form: match case.choice("form")? {
            "local" => EmbeddedForm::Local(bar.elastic),
            _ => EmbeddedForm::Optimal,
        },
    })
}

/// Adds what the gauge read to a row.
fn over_gauge(row: &mut SimulationRow, bar: &Bar, gauge: &Gauge) {
    let exact = gauge.exact(bar);
    let (peak, critical) = (exact.peak_elongation(), exact.critical_opening());
    let load = |elongation| exact.load(elongation);
    // NaN for a run that stopped early.
    let curve = &gauge.history.curve;
    let error = curve.error(load, (0.0, COMPARED * critical), &[peak, critical]);
    let middle = 0.5 * (peak + critical);
    row.errors
        .insert("gauge_load_l2", error.unwrap_or(f64::NAN));
    row.values.insert("gauge_length", gauge.length);
    row.values.insert(
        "gauge_middle_load",
        gauge.history.load_at(middle) / load(middle),
    );
}

/// Shear traction along the crack's plane over strength, for each particle.
fn shears(bar: &Bar, scene: &Scene<2>) -> Vec<f64> {
    let axis = bar.axis();
    let normal = Vector3::new(axis.x, axis.y, 0.0);
    let along = Vector3::new(-axis.y, axis.x, 0.0);
    let stresses = scene.bodies()[0].motion().stress.iter();
    let shears = stresses.map(|stress| stress.traction(&normal).dot(&along));
    shears.map(|shear| shear / bar.exact().strength).collect()
}

impl Run {
    /// The shear that is left at the end.
    fn draw(&self, path: &Path) -> Result<(), StudyError> {
        let (places, shear) = &self.shear;
        ScatterPlot::new("Shear along the crack's plane", places.as_slice())
            .colour("traction over strength [1]", shear.clone())
            .range(-1.0, 1.0)
            .particle_size(0.5 * self.spacing)
            .save(path)
            .map_err(StudyError::failed("drawing a stress"))
    }
}

/// Loads over the elongation of the gauge, a picture for each form: its angles at the spacing and fill that come first.
fn draw_loads(drawn: &[Drawn], folder: &Path) -> Result<(), StudyError> {
    for form in ["optimal", "local"] {
        let of_form = |run: &&Drawn| run.case.choice("form").is_ok_and(|known| known == form);
        let Some(first) = drawn.iter().find(of_form) else {
            continue;
        };
        let like_first = |run: &&Drawn| {
            let same = |name| run.case.get(name) == first.case.get(name);
            same("form") && same("h") && same("fill")
        };
        let mut loads = LinePlot::new(&format!("Load of the bar, {form} form"))
            .x_label("elongation of the gauge [m]")
            .y_label("load [N]");
        for run in drawn.iter().filter(like_first).take(8) {
            let label = format!("{}°", run.case.number("angle")?);
            let (x, y) = (&run.history.elongation, &run.history.load);
            loads = loads.series(&label, x, y, Style::Line);
        }
        let (x, y) = sampled(&first.exact, |exact, at| exact.load(at));
        let loads = loads.series("exact", x, y, Style::Dashed);
        save(loads, &folder.join(format!("load-{form}.png")))?;
    }
    Ok(())
}
