//! The bar turned against the grid, with the crack embedded in the cells it crosses [Sanchez 2010, sec. 5.5.4].

use std::path::Path;

use fissure::io::plot::{LinePlot, ScatterPlot, Style};
use fissure::materials::{TractionSeparation, softening};
use fissure::prelude::*;

use fissure_study::{
    Overrides, Parameter, Parameters, Permitted, Report as Rows, SimulationRow, Study, StudyError,
};

use crate::bar::drawing::{ROWS, sampled, save};
use crate::bar::{self, Bar, OFFSETS, Pull, Thinned, measured};
use crate::method::{Method, on_threads};

/// The study `bar-embedded`.
pub struct BarEmbedded;

const NAME: &str = "bar-embedded";

impl Study for BarEmbedded {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "the breaking bar turned against the grid, its crack a discontinuity within the cells [Sanchez 2010, sec. 5.5.4]"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = bar::parameters_of(&[0.01], &["quasi-static"]);
        for parameter in &mut parameters {
            match parameter.name {
                "tolerance" => parameter.default = vec![1e-6.into()],
                "fill" => parameter.default = vec!["cell".into()],
                // The body is elastic; the crack is a line through its middle.
                "law" => {
                    *parameter = Parameter::choice("law", "of the body", "elastic", &["elastic"])
                }
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
            "rate of the viscous force that keeps the halves from drifting along the open crack, which nothing else holds",
            "1/s",
            1.0,
            Permitted::at_least(0.0),
        ));
        parameters
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let base = || Overrides::new().set("solver", "quasi-static");
        if quick {
            return vec![
                base()
                    .set("h", 0.02)
                    .sweep("angle", [0.0, 30.0])
                    .sweep("form", ["optimal", "local"]),
            ];
        }
        vec![
            base()
                .set("h", 0.01)
                .sweep("angle", [0.0, 15.0, 30.0, 45.0])
                .sweep("fill", ["cell", "rotated"])
                .sweep("offset", 0..OFFSETS),
            base()
                .sweep("h", [0.02, 0.005])
                .sweep("angle", [0.0, 15.0, 30.0, 45.0]),
            base()
                .sweep("h", [0.01, 0.005])
                .set("form", "local")
                .sweep("angle", [0.0, 1.0, 3.0, 5.0, 15.0, 30.0, 45.0]),
        ]
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        let mut drawn: Vec<(Parameters, Thinned)> = Vec::new();
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
            drawn.push((case.clone(), run.history));
        }
        match rows.out_dir().map(Path::to_path_buf) {
            Some(folder) => draw_loads(&drawn, &folder),
            None => Ok(()),
        }
    }
}

/// What is kept of a run.
struct Run {
    bar: Bar,
    row: SimulationRow,
    history: Thinned,
    stopped: Option<String>,
    /// Places of the particles, m, and shear traction along the crack's plane over strength.
    shear: (Vec<[f64; 2]>, Vec<f64>),
}

fn break_embedded(case: &Parameters) -> Result<Run, StudyError> {
    let bar = Bar::new(case)?;
    let method = Method::of(case)?;
    let exact = bar.exact();
    let pull = Pull::new(&bar, case, &method)?;
    let settings = QuasiStaticSettings {
        step: pull.end() / method.steps as f64,
        tolerance: method.tolerance,
        stabilisation: case.number("stabilisation")?,
        ..QuasiStaticSettings::default()
    };
    let axis = bar.axis();
    let crack = EmbeddedCrack {
        point: bar.centre().into(),
        normal: axis.into(),
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
    };
    let solver = QuasiStatic::new(pull.grid.clone(), shape::Linear, settings);
    let mut solver = solver
        .and_then(|solver| solver.with_embedded(crack))
        .map_err(StudyError::failed("setting up the solver"))?;
    let finished = pull.break_with(&mut solver, case, &axis, None)?;
    let mut row = measured(NAME, &bar, case, &finished);
    let jumps = solver.embedded_jumps();
    let failed = jumps.iter().filter(|cell| cell.dissipated_fraction >= 0.5);
    let area: f64 = jumps.iter().map(|cell| cell.area).sum();
    row.values.insert("failed_cells", failed.count() as f64);
    row.values.insert("cut_cells", jumps.len() as f64);
    row.values.insert("crack_area", area / exact.area);
    let motion = finished.scene.bodies()[0].motion();
    let (normal, along) = (
        Vector3::new(axis.x, axis.y, 0.0),
        Vector3::new(-axis.y, axis.x, 0.0),
    );
    let shear: Vec<f64> = motion
        .stress
        .iter()
        .map(|stress| stress.traction(&normal).dot(&along) / exact.strength)
        .collect();
    let most = shear
        .iter()
        .fold(0.0_f64, |most, shear| most.max(shear.abs()));
    row.values.insert("greatest_shear", most);
    Ok(Run {
        row,
        history: finished.history.thinned(ROWS),
        stopped: finished.stopped,
        shear: (motion.position.iter().map(|x| [x.x, x.y]).collect(), shear),
        bar,
    })
}

impl Run {
    /// The shear that is left at the end.
    fn draw(&self, path: &Path) -> Result<(), StudyError> {
        let (places, shear) = &self.shear;
        ScatterPlot::new("Shear along the crack's plane", places.as_slice())
            .colour("traction over strength [1]", shear.clone())
            .range(-1.0, 1.0)
            .particle_size(0.5 * self.bar.spacing)
            .save(path)
            .map_err(StudyError::failed("drawing a stress"))
    }
}

/// Loads over the elongation, a picture for each form.
fn draw_loads(drawn: &[(Parameters, Thinned)], folder: &Path) -> Result<(), StudyError> {
    for form in ["optimal", "local"] {
        let of_form = |case: &Parameters| {
            let first = drawn
                .iter()
                .find(|(case, _)| case.choice("form").is_ok_and(|f| f == form));
            let same = |name| {
                first.is_some_and(|(first, _)| first.number(name).ok() == case.number(name).ok())
            };
            case.choice("form").is_ok_and(|f| f == form)
                && case.choice("fill").is_ok_and(|fill| fill == "cell")
                && same("h")
        };
        let chosen: Vec<_> = drawn.iter().filter(|(case, _)| of_form(case)).collect();
        let Some((first, _)) = chosen.first() else {
            continue;
        };
        let exact = Bar::new(first)?.exact();
        let mut loads = LinePlot::new(&format!("Load of the bar, {form} form"))
            .x_label("elongation [m]")
            .y_label("load [N]");
        for (case, history) in chosen.iter().take(8) {
            let label = format!("{}°", case.number("angle")?);
            loads = loads.series(&label, &history.elongation, &history.load, Style::Line);
        }
        let (x, y) = sampled(&exact, |exact, at| exact.load(at));
        let loads = loads.series("exact", x, y, Style::Dashed);
        save(loads, &folder.join(format!("load-{form}.png")))?;
    }
    Ok(())
}
