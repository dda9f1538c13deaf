//! How long an explicit step may be: the share of the time that a wave needs across a cell up to which a free block that rings
//! in all its waves, the shortest among them, makes no energy.

use std::time::Instant;

use fissure::diagnostics::EnergyGuard;
use fissure::prelude::*;

use fissure_study::{
    Overrides, Parameter, Parameters, Permitted, Report as Rows, Row, Study, StudyError,
};

use crate::method::{self, Chosen, on_threads};

/// The study `stable-step`.
pub struct StableStep;

const NAME: &str = "stable-step";

/// Spacing of the grid, m.
const H: f64 = 0.125;
/// Sides of the block, cells.
const CELLS: [f64; 2] = [8.0, 4.0];
/// Energy over that put in at which a run counts as unstable.
const GROWN: f64 = 1.5;
/// Least share that is tried.
const LEAST: f64 = 0.1;

impl Study for StableStep {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "the longest explicit step that makes no energy, by shape, transfer and stress update"
    }

    fn parameters(&self) -> Vec<Parameter> {
        // The spacing sets nothing but the unit of time, and the step is what is sought.
        let mut parameters = method::parameters(&[H], &["explicit"]);
        parameters.retain(|parameter| !["h", "cfl", "solver"].contains(&parameter.name));
        parameters.extend([
            Parameter::choice(
                "lattice",
                "of the particles: at the same places in every cell, or shifted so that particles straddle the lines of nodes",
                "aligned",
                &["aligned", "shifted"],
            ),
            Parameter::count("per_cell", "particles a cell and axis", 2, Permitted::counts(1..=6)),
            Parameter::number("poisson", "Poisson's ratio", "1", 0.3, Permitted::between(-1.0, 0.5)),
            Parameter::count("run", "steps of a run", 1000, Permitted::counts(10..=1_000_000)),
            Parameter::count("halvings", "of the interval of shares", 5, Permitted::counts(1..=20)),
        ]);
        parameters
    }

    fn default_cases(&self, _settings: &Overrides, quick: bool) -> Vec<Overrides> {
        let base = Overrides::new().sweep("update", ["musl", "last"]);
        if quick {
            return vec![base.set("run", 300_u64).set("halvings", 3_u64)];
        }
        let all = base
            .sweep("update", ["first", "last", "musl"])
            .sweep("transfer", ["flip", "apic", "xpic"])
            .sweep("shape", method::SHAPES.iter().copied());
        let by_moments = all
            .clone()
            .set("transfer", "mls")
            .sweep("shape", ["bspline2", "bspline3"]);
        let ways = |all: Overrides| {
            [
                all.clone().sweep("poisson", [0.0, 0.3]),
                all.clone().set("lattice", "shifted"),
                all.set("lattice", "shifted").set("per_cell", 3_u64),
            ]
        };
        ways(all).into_iter().chain(ways(by_moments)).collect()
    }

    fn run(&self, cases: &[Parameters], rows: &mut Rows<'_>) -> Result<(), StudyError> {
        for (number, case) in cases.iter().enumerate() {
            let (at, count) = (number + 1, cases.len());
            rows.progress(&format!("{at} of {count}: {}", case.label()));
            let start = Instant::now();
            let [stable, unstable] = on_threads(case, || sought(case))?;
            let row = Row::other(NAME)
                .field("case", case.label())
                .field("stable_cfl", stable)
                .field("unstable_cfl", unstable)
                .field("wall_s", start.elapsed().as_secs_f64());
            rows.row(row.parameters(case))?;
        }
        Ok(())
    }
}

/// The largest share found stable and the smallest found not to be; NaN where there is none between the least and 1.
fn sought(case: &Parameters) -> Result<[f64; 2], StudyError> {
    if is_stable(case, 1.0)? {
        return Ok([1.0, f64::NAN]);
    }
    if !is_stable(case, LEAST)? {
        return Ok([f64::NAN, LEAST]);
    }
    let (mut stable, mut unstable) = (LEAST, 1.0);
    for _ in 0..case.count("halvings")? {
        let middle = 0.5 * (stable + unstable);
        match is_stable(case, middle)? {
            true => stable = middle,
            false => unstable = middle,
        }
    }
    Ok([stable, unstable])
}

/// Whether a run at this share gets to its end.
fn is_stable(case: &Parameters, cfl: f64) -> Result<bool, StudyError> {
    let mut scene = block(case).map_err(StudyError::failed("building the block"))?;
    let grid = Grid::over([-1.0; 2], CELLS.map(|cells| cells * H + 1.0), H)
        .map_err(StudyError::failed("making the grid"))?;
    let settings = ExplicitSettings {
        cfl,
        ..method::explicit_settings(case)?
    };
    let mut solver = Chosen::Explicit(settings).on(grid, case.choice("shape")?)?;
    let mut guard = EnergyGuard::new(&scene).factor(GROWN);
    let until = Until::Steps(case.count("run")?);
    // Whatever ends a run early, energy, a particle off the grid or turned inside out, is growth.
    Ok(run(&mut scene, &mut *solver, until, &mut [&mut guard]).is_ok())
}

/// A free block in which neighbouring particles move every which way.
fn block(case: &Parameters) -> Result<Scene<2>, Box<dyn std::error::Error + Send + Sync>> {
    let law = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: case.number("poisson")?,
    };
    let low = match case.choice("lattice")? {
        "shifted" => [0.24 * H, 0.32 * H],
        _ => [0.0; 2],
    };
    let high = [0, 1].map(|axis| low[axis] + CELLS[axis] * H);
    let spacing = Spacing(H / case.count("per_cell")? as f64);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene.fill("block", law, &Block::new(low, high), &spacing)?;
    // Any numbers that do not repeat from place to place.
    let noise = |x: &Vector2<f64>, a: f64, b: f64| ((a * x.x + b * x.y).sin() * 43758.5).fract();
    scene.set_velocity("block", |x| {
        Vector2::new(noise(x, 1234.5, 777.7), noise(x, 234.5, 1777.7)) * 1e-3
    })?;
    Ok(scene)
}
