//! Instructions of a particle's step, which do not depend on what else the machine does:
//! `cargo run --release -p fissure-benches --bin instructions`; needs valgrind. `--json` prints an object per row.
//!
//! Problems A and B of `throughput`, smaller, with the law built in and with one of a user's own, which has the same
//! formulas. The program runs itself under valgrind twice, a few steps and some more, and divides the difference. Valgrind knows
//! AVX2 at most.
//!
//! `instructions time` runs them by the clock instead, interleaved; `instructions one A neo-hookean 100` that many steps
//! of one, for a profiler.

#![allow(clippy::print_stdout)] // A command that prints.

use std::process::{Command, Stdio};
use std::time::Instant;

use fissure::prelude::*;

type Failure = Box<dyn std::error::Error>;

const CASES: [(&str, &str); 4] = [
    ("A", "neo-hookean"),
    ("B", "neo-hookean"),
    ("A", "decohesive"),
    ("B", "decohesive"),
];

/// Steps that are counted, and those before.
const STEPS: [u32; 2] = [2, 6];

fn fill<const D: usize>(scene: &mut Scene<D>, law: &str, cells: f64) -> Result<(), Error> {
    let (density, young, poisson) = (1000.0, 1e6, 0.3);
    let spacing = Spacing(0.5 / cells);
    let block = &Block::new([0.25; D], [0.75; D]);
    match law {
        "decohesive" => {
            let law = Decohesive {
                elastic: Isotropic {
                    density,
                    young,
                    poisson,
                },
                strength: 1e8,
                toughness: 1e12,
                softening: softening::Linear,
                normal: Normal::Rankine,
            };
            scene.fill("block", law, block, &spacing)?
        }
        _ => {
            let law = NeoHookean {
                density,
                young,
                poisson,
            };
            scene.fill("block", law, block, &spacing)?
        }
    };
    scene.set_velocity("block", |x| {
        let wave = |axis: usize| (std::f64::consts::TAU * x[(axis + 1) % D]).sin();
        SVector::from_fn(|axis, _| wave(axis) + if axis == 0 { 1.0 } else { 0.0 })
    })?;
    Ok(())
}

/// Particles, and seconds of a step.
fn run<const D: usize>(
    mut scene: Scene<D>,
    law: &str,
    cells: f64,
    steps: u32,
) -> Result<(usize, f64), Failure> {
    fill(&mut scene, law, cells)?;
    let settings = ExplicitSettings {
        transfer: Transfer::Apic,
        stress_update: StressUpdate::Last,
        ..ExplicitSettings::default()
    };
    let grid = Grid::over([0.0; D], [1.0; D], 1.0 / cells)?;
    let mut solver = Explicit::new(grid, shape::Bspline2, settings)?;
    solver.step(&mut scene, 1e-5)?;
    let start = Instant::now();
    for step in 1..=steps {
        solver.step(&mut scene, 1e-5 * f64::from(step + 1))?;
    }
    let time = start.elapsed().as_secs_f64() / f64::from(steps);
    Ok((scene.particle_count(), time))
}

fn run_named(problem: &str, law: &str, large: bool, steps: u32) -> Result<(usize, f64), Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let ran = pool.install(|| {
        match problem {
            "A" => {
                let scene = Scene::plane(Plane::Strain { thickness: 1.0 });
                run(scene, law, if large { 320.0 } else { 96.0 }, steps)
            }
            _ => run(Scene::solid(), law, if large { 64.0 } else { 24.0 }, steps),
        }
        .map_err(|error| error.to_string())
    });
    Ok(ran?)
}

/// Instructions of this program with these steps.
fn counted(problem: &str, law: &str, steps: u32) -> Result<f64, Failure> {
    let program = std::env::current_exe()?;
    let output = Command::new("valgrind")
        .args([
            "--tool=cachegrind",
            "--cache-sim=no",
            "--cachegrind-out-file=/dev/null",
        ])
        .arg(program)
        .args(["one", problem, law, &steps.to_string()])
        .stdout(Stdio::null())
        .output()
        .map_err(|error| format!("valgrind: {error}"))?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let line = said.lines().find(|line| line.contains("I refs:"));
    let number = line.and_then(|line| line.rsplit(':').next());
    let number = number.map(|number| number.trim().replace(',', ""));
    let number = number.and_then(|number| number.parse().ok());
    Ok(number.ok_or_else(|| format!("valgrind counted nothing: {said}"))?)
}

fn count(json: bool) -> Result<(), Failure> {
    for (problem, law) in CASES {
        let [few, many] = STEPS;
        let (particles, _) = run_named(problem, law, false, 1)?;
        let more = counted(problem, law, many)? - counted(problem, law, few)?;
        let each = more / (f64::from(many - few) * particles as f64);
        if json {
            let row = serde_json::json!({
                "problem": problem, "law": law, "particles": particles,
                "instructions_per_update": each,
            });
            println!("{row}");
        } else {
            println!("{problem} {law:12} {each:8.1} instructions per particle and step");
        }
    }
    Ok(())
}

/// The best of some interleaved runs.
fn time() -> Result<(), Failure> {
    let mut best = [f64::INFINITY; CASES.len()];
    for _ in 0..5 {
        for ((problem, law), best) in CASES.iter().zip(&mut best) {
            let (particles, time) = run_named(problem, law, true, 20)?;
            *best = best.min(time / particles as f64);
        }
    }
    for ((problem, law), best) in CASES.iter().zip(best) {
        println!(
            "{problem} {law:12} {:8.1} ns per particle and step",
            best * 1e9
        );
    }
    Ok(())
}

fn main() -> Result<(), Failure> {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let given: Vec<&str> = given.iter().map(String::as_str).collect();
    match given[..] {
        [] => count(false),
        ["--json"] => count(true),
        ["time"] => time(),
        ["one", problem, law, steps] => {
            run_named(problem, law, false, steps.parse()?)?;
            Ok(())
        }
        _ => Err("only --json, time, and one PROBLEM LAW STEPS are known".into()),
    }
}
