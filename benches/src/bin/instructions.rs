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

use fissure::prelude::*;
use fissure_benches::{fill, held, thread_time};

#[global_allocator]
static HEAP: &stats_alloc::StatsAlloc<std::alloc::System> = &stats_alloc::INSTRUMENTED_SYSTEM;

type Failure = Box<dyn std::error::Error>;

const CASES: [(&str, &str); 8] = [
    ("A", "neo-hookean"),
    ("A", "own"),
    ("A", "own-by-one"),
    ("A", "decohesive"),
    ("B", "neo-hookean"),
    ("B", "own"),
    ("B", "own-by-one"),
    ("B", "decohesive"),
];

/// Steps that are counted, and those before.
const STEPS: [u32; 2] = [2, 6];

/// What came of a run: particles, and of each the processor time of a step, s, and bytes, the grid's among them.
struct Ran {
    particles: usize,
    time: f64,
    bytes: f64,
}

fn run<const D: usize>(
    mut scene: Scene<D>,
    law: &str,
    cells: f64,
    steps: u32,
) -> Result<Ran, Failure> {
    let before = held();
    let block = Block::new([0.25; D], [0.75; D]);
    fill(&mut scene, law, &block, 0.5 / cells)?;
    let settings = ExplicitSettings {
        transfer: Transfer::Apic,
        stress_update: StressUpdate::Last,
        ..ExplicitSettings::default()
    };
    let grid = Grid::over([0.0; D], [1.0; D], 1.0 / cells)?;
    let mut solver = Explicit::new(grid, shape::Bspline2, settings)?;
    solver.step(&mut scene, 1e-5)?;
    let start = thread_time();
    for step in 1..=steps {
        solver.step(&mut scene, 1e-5 * f64::from(step + 1))?;
    }
    let particles = scene.particle_count();
    let updates = f64::from(steps) * particles as f64;
    Ok(Ran {
        particles,
        time: (thread_time() - start) / updates,
        bytes: (held() - before) / particles as f64,
    })
}

/// Runs a problem on one thread, in its `large` size or the small one.
fn run_named(problem: &str, law: &str, large: bool, steps: u32) -> Result<Ran, Failure> {
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
    let line = said.lines().find(|line| line.contains("refs:"));
    let number = line.and_then(|line| line.rsplit(':').next());
    let number = number.map(|number| number.trim().replace(',', ""));
    let number = number.and_then(|number| number.parse().ok());
    Ok(number.ok_or_else(|| format!("valgrind counted nothing: {said}"))?)
}

fn count(json: bool) -> Result<(), Failure> {
    for (problem, law) in CASES {
        let [few, many] = STEPS;
        let Ran {
            particles, bytes, ..
        } = run_named(problem, law, false, 1)?;
        let more = counted(problem, law, many)? - counted(problem, law, few)?;
        let each = more / (f64::from(many - few) * particles as f64);
        if json {
            let row = serde_json::json!({
                "problem": problem, "law": law, "particles": particles,
                "instructions_per_update": each, "bytes_per_particle": bytes,
            });
            println!("{row}");
        } else {
            println!(
                "{problem} {law:12} {each:8.1} instructions per particle and step, {bytes:4.0} bytes"
            );
        }
    }
    Ok(())
}

/// Processor time, the best of some interleaved runs, and memory.
fn time() -> Result<(), Failure> {
    let mut best = [(f64::INFINITY, 0.0); CASES.len()];
    for _ in 0..5 {
        for ((problem, law), (time, bytes)) in CASES.iter().zip(&mut best) {
            let ran = run_named(problem, law, true, 20)?;
            *time = time.min(ran.time);
            *bytes = ran.bytes;
        }
    }
    for ((problem, law), (time, bytes)) in CASES.iter().zip(best) {
        println!(
            "{problem} {law:12} {:8.1} ns per particle and step, {bytes:4.0} bytes",
            time * 1e9
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
