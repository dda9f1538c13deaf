//! Particle updates per second of the explicit step: `cargo run --release -p fissure-benches --bin throughput`.
//!
//! The problems are those of `benches/peers`: a neo-Hookean block that flies and rings in an empty
//! grid, A in the plane and B in space, APIC on quadratic B-splines. Then B with other shapes,
//! transfers, laws and vector units. The first four rows are medians of interleaved repetitions; a row
//! says how far the kinetic energy is from that of the same scheme in numpy, where it was run.
//!
//! `--json` prints an object per row, `--quick` a short form.

#![allow(clippy::print_stdout)] // A command that prints.

use std::time::Instant;

use fissure::grid::simd::Simd;
use fissure::prelude::*;

/// What is run: everything that makes a row but the number of threads.
#[derive(Clone, Copy)]
struct Case {
    problem: &'static str,
    law: &'static str,
    shape: &'static str,
    transfer: &'static str,
    simd: &'static str,
}

const ELASTIC: Case = Case {
    problem: "B",
    law: "neo-hookean",
    shape: "bspline2",
    transfer: "apic",
    simd: "",
};

/// Kinetic energies after the steps below by `benches/peers/run --peers numpy-gradient`, J.
const KINETIC: [(&str, f64); 2] = [("A", 665.47080395155), ("B", 329.73600295658)];

struct Row {
    case: Case,
    threads: usize,
    particles: usize,
    updates_per_s: Vec<f64>,
    bytes_per_particle: f64,
    kinetic_error: Option<f64>,
}

/// How many of the cases come first and are repeated.
const COMPARED: usize = 4;

fn cases(quick: bool) -> Vec<(Case, usize)> {
    let a = Case {
        problem: "A",
        ..ELASTIC
    };
    let mut cases = vec![(a, 1), (ELASTIC, 1), (a, 2), (ELASTIC, 2)];
    if quick {
        return cases;
    }
    for simd in ["avx2", "plain"] {
        cases.push((Case { simd, ..ELASTIC }, 1));
    }
    for shape in ["linear", "gimp", "cpdi", "bspline3"] {
        cases.push((Case { shape, ..ELASTIC }, 1));
    }
    for transfer in ["flip", "flip-musl", "xpic5"] {
        cases.push((
            Case {
                transfer,
                ..ELASTIC
            },
            1,
        ));
    }
    for law in ["isotropic", "decohesive"] {
        cases.push((Case { law, ..ELASTIC }, 1));
    }
    cases
}

fn settings(case: &Case) -> Result<ExplicitSettings, String> {
    let unit = match case.simd {
        "" => Some(Simd::widest()),
        name => Simd::named(name),
    };
    let (transfer, stress_update) = match case.transfer {
        "apic" => (Transfer::Apic, StressUpdate::Last),
        "flip" => (Transfer::Flip { pic: 0.0 }, StressUpdate::Last),
        "flip-musl" => (Transfer::Flip { pic: 0.0 }, StressUpdate::Musl),
        _ => (Transfer::Xpic { order: 5 }, StressUpdate::Last),
    };
    Ok(ExplicitSettings {
        transfer,
        stress_update,
        simd: unit.ok_or(format!("this machine has no {}", case.simd))?,
        ..ExplicitSettings::default()
    })
}

/// Fills a block with the case's law.
fn fill<const D: usize>(
    scene: &mut Scene<D>,
    case: &Case,
    block: &Block<D>,
    spacing: f64,
) -> Result<(), Error> {
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let spacing = Spacing(spacing);
    match case.law {
        "isotropic" => scene.fill("block", elastic, block, &spacing)?,
        "decohesive" => {
            let law = Decohesive {
                elastic,
                strength: 1e8,
                toughness: 1e12,
                softening: softening::Linear,
                normal: Normal::Rankine,
            };
            scene.fill("block", law, block, &spacing)?
        }
        _ => {
            let law = NeoHookean {
                density: 1000.0,
                young: 1e6,
                poisson: 0.3,
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

/// Sizes of a problem: cells of the grid along an axis, cells of matter, step, warm-up and timed
/// steps.
fn sizes(problem: &str) -> (f64, f64, f64, u32, u32) {
    match problem {
        "A" => (320.0, 250.0, 2e-5, 10, 50),
        _ => (64.0, 40.0, 1e-4, 5, 15),
    }
}

fn prepare<const D: usize>(
    mut scene: Scene<D>,
    case: &Case,
) -> Result<(Scene<D>, Grid<D>), Box<dyn std::error::Error>> {
    let (grid, matter, ..) = sizes(case.problem);
    let (low, high) = (0.5 * (grid - matter) / grid, 0.5 * (grid + matter) / grid);
    fill(
        &mut scene,
        case,
        &Block::new([low; D], [high; D]),
        0.5 / grid,
    )?;
    Ok((scene, Grid::over([0.0; D], [1.0; D], 1.0 / grid)?))
}

/// Updates per second, particles, bytes per particle and kinetic energy of one run.
fn time<const D: usize>(
    scene: Scene<D>,
    case: &Case,
) -> Result<(f64, usize, f64, f64), Box<dyn std::error::Error>> {
    let before = resident();
    let (mut scene, grid) = prepare(scene, case)?;
    let settings = settings(case)?;
    let mut solver: Box<dyn Solver<D>> = match case.shape {
        "linear" => Box::new(Explicit::new(grid, shape::Linear, settings)?),
        "gimp" => Box::new(Explicit::new(grid, shape::Gimp, settings)?),
        "cpdi" => Box::new(Explicit::new(grid, shape::Cpdi, settings)?),
        "bspline3" => Box::new(Explicit::new(grid, shape::Bspline3, settings)?),
        _ => Box::new(Explicit::new(grid, shape::Bspline2, settings)?),
    };
    let (.., dt, warm_up, steps) = sizes(case.problem);
    let mut start = Instant::now();
    for step in 1..=warm_up + steps {
        if step == warm_up + 1 {
            start = Instant::now();
        }
        solver.step(&mut scene, f64::from(step) * dt)?;
    }
    let count = scene.particle_count();
    let rate = f64::from(steps) * count as f64 / start.elapsed().as_secs_f64();
    let bytes = (resident() - before) / count as f64;
    Ok((rate, count, bytes, scene.bodies()[0].kinetic_energy()))
}

/// Resident memory, bytes; NaN where the system does not tell.
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages = status.split_whitespace().nth(1);
    pages.and_then(|n| n.parse().ok()).unwrap_or(f64::NAN) * 4096.0
}

fn run(case: &Case, threads: usize) -> Result<Row, Box<dyn std::error::Error>> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    let timed = pool.install(|| {
        match case.problem {
            "A" => time(Scene::plane(Plane::Strain { thickness: 1.0 }), case),
            _ => time(Scene::solid(), case),
        }
        .map_err(|error| error.to_string())
    });
    let (rate, particles, bytes_per_particle, kinetic) = timed?;
    let same = (case.law, case.shape, case.transfer) == ("neo-hookean", "bspline2", "apic");
    let reference = KINETIC
        .iter()
        .find(|(name, _)| same && *name == case.problem);
    Ok(Row {
        case: *case,
        threads,
        particles,
        updates_per_s: vec![rate],
        bytes_per_particle,
        kinetic_error: reference.map(|(_, exact)| (kinetic / exact - 1.0).abs()),
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let [json, quick] = ["--json", "--quick"].map(|flag| given.iter().any(|g| g == flag));
    if let Some(other) = given
        .iter()
        .find(|g| !["--json", "--quick"].contains(&g.as_str()))
    {
        return Err(format!("{other}: only --json and --quick are known").into());
    }
    let cases = cases(quick);
    let mut rows: Vec<Row> = Vec::new();
    for repetition in 0..if quick { 1 } else { 3 } {
        // The rows of A and B are compared with other codes; the rest only with B.
        let repeated = if repetition == 0 {
            cases.len()
        } else {
            COMPARED
        };
        for (i, (case, threads)) in cases.iter().enumerate().take(repeated) {
            let row = run(case, *threads)?;
            if repetition == 0 {
                rows.push(row);
            } else {
                rows[i].updates_per_s.extend(row.updates_per_s);
            }
        }
    }
    let median = |row: &Row| {
        let mut rates = row.updates_per_s.clone();
        rates.sort_by(f64::total_cmp);
        rates[rates.len() / 2]
    };
    let elastic = rows
        .iter()
        .find(|row| row.case.problem == "B" && row.threads == 1);
    let elastic = elastic.map_or(f64::NAN, median);
    if !json {
        println!(
            "problem law          shape     transfer   simd    threads  M updates/s  over B elastic  bytes/particle  kinetic error"
        );
    }
    for row in &rows {
        let case = &row.case;
        let simd = if case.simd.is_empty() {
            Simd::widest().name()
        } else {
            case.simd
        };
        let rate = median(row);
        if json {
            let object = serde_json::json!({
                "problem": case.problem, "law": case.law, "shape": case.shape,
                "transfer": case.transfer, "simd": simd, "threads": row.threads,
                "particles": row.particles, "updates_per_s": rate,
                "ratio_to_elastic_b": rate / elastic,
                "bytes_per_particle": row.bytes_per_particle,
                "kinetic_error": row.kinetic_error,
            });
            println!("{object}");
        } else {
            let error = row
                .kinetic_error
                .map_or("-".to_owned(), |e| format!("{e:.1e}"));
            println!(
                "{:7} {:12} {:9} {:10} {:7} {:7}  {:11.3}  {:14.2}  {:14.0}  {error}",
                case.problem,
                case.law,
                case.shape,
                case.transfer,
                simd,
                row.threads,
                rate * 1e-6,
                rate / elastic,
                row.bytes_per_particle,
            );
        }
    }
    Ok(())
}
