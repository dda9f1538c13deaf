//! How hard the linear systems of implicit steps are: neighbours of unlike stiffness or density, near
//! incompressibility, long steps; and how iterations grow with the number of unknowns.
//!
//! A square of 1 m, its left half soft, its right half stiffer (and heavier) by a ratio, rests on a wall and a
//! floor and is drawn at the right, from rest, by a load that rises evenly over the run. Steps are so many times the time that the fastest wave needs
//! across a cell. Errors are those of the particles' displacements against a factorisation with a
//! hundredth of the tolerance.

mod growth;
mod square;

use fissure::io::plot::{LinePlot, Style};
use fissure::prelude::*;

use fissure_study::{
    Overrides, Parameter, Parameters, Permitted, Report as Rows, Study, StudyError,
};

use crate::drawing::save;
use crate::method::on_threads;

use growth::Growth;
use square::solve;

/// The study `stiff`.
pub struct Stiff;

const NAME: &str = "stiff";

/// How much more accurate the reference is.
const FINER: f64 = 100.0;
/// Refinements, at the least, from which a growth is fitted.
const REFINEMENTS: usize = 2;

impl Study for Stiff {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "iterations, time and error of each linear solver and preconditioner of an implicit step: unlike neighbours, near incompressibility, long steps, many unknowns"
    }

    fn parameters(&self) -> Vec<Parameter> {
        let ratio = || Permitted::numbers(1.0..=1e9);
        vec![
            Parameter::choice(
                "linear_solver",
                "factorisation, conjugate gradients, GMRES by the law's tangent, GMRES by differences",
                "direct",
                &["direct", "cg", "gmres", "gmres-differences"],
            ),
            Parameter::choice(
                "preconditioner",
                "of an iteration; incomplete multiplies by the assembled matrix",
                "none",
                &["none", "mass", "node-blocks", "incomplete"],
            ),
            Parameter::number(
                "ratio",
                "stiffness of the right half over the left",
                "1",
                1.0,
                ratio(),
            ),
            Parameter::number(
                "mass_ratio",
                "density of the right half over the left",
                "1",
                1.0,
                ratio(),
            ),
            Parameter::number(
                "poisson",
                "Poisson's ratio",
                "1",
                0.3,
                Permitted::between(-1.0, 0.5),
            ),
            Parameter::number(
                "dt_ratio",
                "step over the explicit limit",
                "1",
                100.0,
                ratio(),
            ),
            Parameter::number(
                "strain",
                "of the soft half under the load at rest, about",
                "1",
                1e-3,
                Permitted::numbers(1e-9..=1e-1),
            ),
            Parameter::count("cells", "along a side", 16, Permitted::counts(2..=1024)),
            Parameter::count("steps", "of the run", 3, Permitted::counts(1..=1000)),
            Parameter::number(
                "tolerance",
                "unbalanced forces over the largest force",
                "1",
                1e-6,
                Permitted::numbers(1e-12..=1e-2),
            ),
            Parameter::count(
                "restart",
                "directions that GMRES keeps",
                400,
                Permitted::counts(1..=10_000),
            ),
            Parameter::count(
                "products",
                "with the tangent, at most, in a Newton iteration",
                4000,
                Permitted::counts(1..=1_000_000),
            ),
            Parameter::count("threads", "worker threads", 1, Permitted::counts(1..=256)),
        ]
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let all: &[(&str, &str)] = &[
            ("direct", "none"),
            ("cg", "none"),
            ("cg", "mass"),
            ("cg", "node-blocks"),
            ("cg", "incomplete"),
            ("gmres", "none"),
            ("gmres", "mass"),
            ("gmres", "node-blocks"),
            ("gmres", "incomplete"),
            ("gmres-differences", "mass"),
        ];
        let few: &[(&str, &str)] = &[
            ("direct", "none"),
            ("cg", "incomplete"),
            ("gmres", "incomplete"),
        ];
        let base = |(linear, preconditioner): &(&str, &str)| {
            Overrides::new()
                .set("linear_solver", *linear)
                .set("preconditioner", *preconditioner)
        };
        let mut cases = Vec::new();
        for pair in if quick { few } else { all } {
            let base = base(pair);
            if quick {
                cases.push(base.set("cells", 8_u64).sweep("ratio", [1.0, 1e6]));
                continue;
            }
            cases.push(base.clone().sweep("ratio", [1.0, 1e2, 1e4, 1e6]));
            cases.push(base.clone().sweep("poisson", [0.49, 0.4999, 0.49999]));
            cases.push(base.clone().set("mass_ratio", 1e6));
            cases.push(base.sweep("dt_ratio", [1.0, 1e4]));
        }
        let growing: &[(&str, &str)] = match quick {
            true => &few[1..],
            false => &[
                ("direct", "none"),
                ("cg", "node-blocks"),
                ("cg", "incomplete"),
                ("gmres", "node-blocks"),
                ("gmres", "incomplete"),
            ],
        };
        let cells: &[u64] = if quick {
            &[8, 16, 32]
        } else {
            &[8, 16, 32, 64]
        };
        for pair in growing {
            let grown = base(pair).set("dt_ratio", 1e4).set("steps", 1_u64);
            cases.push(grown.sweep("cells", cells.iter().copied()));
        }
        cases
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        let mut growth: Vec<Growth> = Vec::new();
        for (number, case) in cases.iter().enumerate() {
            let (at, count) = (number + 1, cases.len());
            rows.progress(&format!("{at} of {count}: {}", case.label()));
            let run = on_threads(case, || solve(case, 1.0, linear(case)?))?;
            let finer = on_threads(case, || solve(case, FINER, LinearSolver::Direct))?;
            // At the least that round-off leaves.
            let reference = match finer.converged {
                true => finer,
                false => on_threads(case, || solve(case, 1.0, LinearSolver::Direct))?,
            };
            rows.row(run.row(case, &reference)?)?;
            Growth::note(&mut growth, case, &run)?;
        }
        let mut plot = LinePlot::new("Products with the tangent in a step")
            .x_label("unknowns")
            .y_label("products")
            .log_x()
            .log_y();
        let grown = |growth: &&Growth| growth.sizes() > REFINEMENTS && growth.products[0] > 0.0;
        let grown: Vec<&Growth> = growth.iter().filter(grown).collect();
        for growth in &grown {
            rows.row(growth.row()?)?;
            plot = plot.series(
                &growth.name,
                growth.unknowns.clone(),
                growth.products.clone(),
                Style::LineAndMarkers,
            );
        }
        match rows.out_dir() {
            Some(folder) if !grown.is_empty() => save(plot, &folder.join("growth.png")),
            _ => Ok(()),
        }
    }
}

fn linear(case: &Parameters) -> Result<LinearSolver, StudyError> {
    let preconditioner = match case.choice("preconditioner")? {
        "mass" => Preconditioning::Mass,
        "node-blocks" => Preconditioning::NodeBlocks,
        "incomplete" => Preconditioning::Incomplete,
        _ => Preconditioning::None,
    };
    let name = case.choice("linear_solver")?;
    let product = match (name, preconditioner) {
        ("gmres-differences", _) => Product::Differences,
        (_, Preconditioning::Incomplete) => Product::Assembled,
        _ => Product::Tangent,
    };
    Ok(match name {
        "direct" => LinearSolver::Direct,
        _ => LinearSolver::Iterative(Iterative {
            method: match name {
                "cg" => fissure::solvers::Method::ConjugateGradients,
                _ => fissure::solvers::Method::Gmres,
            },
            product,
            preconditioner,
            restart: case.size("restart")?,
            max_iterations: case.size("products")?,
        }),
    })
}
