//! Fake studies and a command line that is read back as text.

use std::error::Error;
use std::fmt;

use fissure_study::{
    Overrides, Parameter, Parameters, Permitted, Report, Row, SimulationRow, Study, StudyError,
    execute,
};

/// A study with a default run that is not a plain product.
pub struct Pull;

impl Study for Pull {
    fn name(&self) -> &'static str {
        "pull-bar"
    }

    fn about(&self) -> &'static str {
        "a bar that nobody pulls"
    }

    fn parameters(&self) -> Vec<Parameter> {
        vec![
            Parameter::choice(
                "shape",
                "shape functions",
                "linear",
                &["linear", "quadratic"],
            ),
            Parameter::number("h", "grid spacing", "m", 0.02, Permitted::above(0.0))
                .sweep([0.02, 0.01]),
            Parameter::choice(
                "solver",
                "time integration",
                "explicit",
                &["explicit", "implicit"],
            ),
            Parameter::number(
                "poisson",
                "Poisson's ratio",
                "1",
                0.3,
                Permitted::between(-1.0, 0.5),
            ),
            Parameter::number(
                "angle",
                "grid rotation",
                "deg",
                0.0,
                Permitted::numbers(-90.0..=90.0),
            ),
            Parameter::count("threads", "worker threads", 1, Permitted::counts(1..=64)),
        ]
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        if quick {
            return vec![Overrides::new().set("h", 0.02)];
        }
        vec![
            Overrides::new()
                .sweep("h", [0.02, 0.01, 0.005, 0.0025])
                .sweep("solver", ["explicit", "implicit"]),
            Overrides::new()
                .set("shape", "quadratic")
                .sweep("h", [0.02, 0.01]),
        ]
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        for (number, case) in cases.iter().enumerate() {
            report.progress(&format!("case {} of {}", number + 1, cases.len()));
            if case.number("angle")? == 90.0 && case.choice("solver")? == "implicit" {
                let reason = "the bar would lie on its side";
                return Err(StudyError::combination(case, &["solver", "angle"], reason));
            }
            let h = case.number("h")?;
            let mut row = SimulationRow::new(self.name(), case);
            row.transfer = "flip".to_owned();
            row.particles = 400;
            row.steps = 12;
            row.wall_s = 1.25;
            row.errors.insert("displacement", h * h);
            row.errors.insert("energy", f64::NAN);
            row.values.insert("peak", f64::INFINITY);
            row.state_hash = 0xabc;
            report.row(row)?;
        }
        report.note("order of convergence: 2")?;
        Ok(())
    }
}

/// Why [`Broken`] fails.
#[derive(Debug)]
pub struct Snapped;

impl fmt::Display for Snapped {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the bar snapped")
    }
}

impl Error for Snapped {}

/// A study that reports one row and then fails.
pub struct Broken;

impl Study for Broken {
    fn name(&self) -> &'static str {
        "broken"
    }

    fn about(&self) -> &'static str {
        "a study that fails"
    }

    fn parameters(&self) -> Vec<Parameter> {
        vec![Parameter::number(
            "young",
            "Young's modulus",
            "Pa",
            2.1e11,
            Permitted::above(0.0),
        )]
    }

    fn default_cases(&self, _settings: &Overrides, _quick: bool) -> Vec<Overrides> {
        vec![Overrides::new()]
    }

    fn full_cases(&self, _settings: &Overrides) -> Option<Vec<Overrides>> {
        Some(vec![Overrides::new().sweep("young", [1e11, 2e11, 3e11])])
    }

    fn run(&self, cases: &[Parameters], report: &mut Report<'_>) -> Result<(), StudyError> {
        for case in cases {
            report.row(
                Row::other(self.name())
                    .field("load", 0.5)
                    .field("profile", vec![0.1, f64::NAN])
                    .field("converged", true)
                    .parameters(case),
            )?;
        }
        Err(StudyError::failed("cannot pull the bar")(Snapped))
    }
}

/// What a command line led to.
pub struct Outcome {
    pub code: u8,
    pub output: String,
    pub messages: String,
}

impl Outcome {
    /// Every line of standard output as JSON; fails the test where one is not.
    pub fn json(&self) -> Vec<serde_json::Value> {
        self.output
            .lines()
            .map(|line| serde_json::from_str(line).unwrap())
            .collect()
    }
}

/// Obeys a command line, given as words separated by spaces.
pub fn obey(line: &str) -> Outcome {
    let studies: Vec<Box<dyn Study>> = vec![Box::new(Pull), Box::new(Broken)];
    let arguments = ["fissure-studies"]
        .into_iter()
        .chain(line.split_whitespace());
    let mut output = Vec::new();
    let mut messages = Vec::new();
    let code = execute(&studies, arguments, &mut output, &mut messages);
    Outcome {
        code,
        output: String::from_utf8(output).unwrap(),
        messages: String::from_utf8(messages).unwrap(),
    }
}
