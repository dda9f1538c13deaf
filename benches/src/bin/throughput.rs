//! Particle updates per second of the explicit step: `cargo run --release -p fissure-benches --bin throughput`.
//!
//! The problems are those of `benches/peers`: a neo-Hookean block that flies and rings in an empty
//! grid, A in the plane and B in space, APIC on quadratic B-splines, with gradients of the functions and, as the peers
//! have it, by moving least squares. Then B with other shapes,
//! transfers, laws and vector units. The first six rows are medians of interleaved repetitions; a row
//! says how far the kinetic energy is from that of the same scheme in numpy, where it was run.
//!
//! A row also says what share it is of what the machine can do, which is measured first: multiply-adds per second on
//! the widest vector unit, and bytes per second to and from memory. The shares count the arithmetic and the bytes
//! that a step of that problem cannot do without (`WORK`).
//!
//! `--json` prints an object per row, `--quick` a short form. `scaling` in place of these times a step of B's block at
//! other sizes and in an emptier grid.

#![allow(clippy::print_stdout)] // A command that prints.

use std::hint::black_box;
use std::time::Instant;

use fissure::grid::simd::{EIGHT, Lanes, Simd, SimdTask};
use fissure::prelude::*;
use fissure_benches::{fill, held, thread_time};

#[global_allocator]
static HEAP: &stats_alloc::StatsAlloc<std::alloc::System> = &stats_alloc::INSTRUMENTED_SYSTEM;

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

/// Kinetic energies after the steps below by `benches/peers/run --peers numpy numpy-gradient`, J.
const KINETIC: [(&str, &str, f64); 4] = [
    ("A", "apic", 665.47080395155),
    ("B", "apic", 329.73600295658),
    ("A", "mls", 665.47062986167),
    ("B", "mls", 329.72906715693),
];

/// Multiply-adds (counted as two) and bytes of a particle's step, of problems A and B: sums over the nodes, weights,
/// law and motion; what is read (position, deformation gradient, mass, volume) and written (position, velocity,
/// deformation gradient, stress, affine part), the latter twice since a line is read before it is written.
const WORK: [(&str, f64, f64); 2] = [("A", 530.0, 472.0), ("B", 1390.0, 592.0)];

struct Row {
    case: Case,
    threads: usize,
    particles: usize,
    updates_per_s: Vec<f64>,
    updates_per_cpu_s: Vec<f64>,
    bytes_per_particle: f64,
    kinetic_error: Option<f64>,
}

/// How many of the cases come first and are repeated.
const COMPARED: usize = 6;

fn cases(quick: bool) -> Vec<(Case, usize)> {
    let a = Case {
        problem: "A",
        ..ELASTIC
    };
    let by_arms = |case| Case {
        transfer: "mls",
        ..case
    };
    let mut cases = vec![
        (a, 1),
        (ELASTIC, 1),
        (by_arms(a), 1),
        (by_arms(ELASTIC), 1),
        (a, 2),
        (ELASTIC, 2),
    ];
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
    for law in ["own", "own-by-one", "isotropic", "decohesive"] {
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
        "mls" => (Transfer::Mls, StressUpdate::Last),
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
        case.law,
        &Block::new([low; D], [high; D]),
        0.5 / grid,
    )?;
    Ok((scene, Grid::over([0.0; D], [1.0; D], 1.0 / grid)?))
}

/// What came of one run.
struct Timed {
    updates_per_s: f64,
    updates_per_cpu_s: f64,
    particles: usize,
    bytes_per_particle: f64,
    kinetic: f64,
}

fn time<const D: usize>(scene: Scene<D>, case: &Case) -> Result<Timed, Box<dyn std::error::Error>> {
    let before = held();
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
    let mut start = (Instant::now(), processor_time());
    for step in 1..=warm_up + steps {
        if step == warm_up + 1 {
            start = (Instant::now(), processor_time());
        }
        solver.step(&mut scene, f64::from(step) * dt)?;
    }
    let particles = scene.particle_count();
    let updates = f64::from(steps) * particles as f64;
    Ok(Timed {
        updates_per_s: updates / start.0.elapsed().as_secs_f64(),
        updates_per_cpu_s: updates / (processor_time() - start.1),
        particles,
        bytes_per_particle: (held() - before) / particles as f64,
        kinetic: scene.bodies()[0].kinetic_energy(),
    })
}

/// Processor time of all threads so far, s, in steps of 10 ms; NaN where the system does not tell.
fn processor_time() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // After the name, which may hold anything: user and system time are the 12th and 13th.
    let fields = stat.rsplit(')').next().unwrap_or_default();
    let ticks = fields.split_whitespace().skip(11).take(2);
    let ticks: Vec<f64> = ticks.filter_map(|n| n.parse().ok()).collect();
    if ticks.len() == 2 {
        (ticks[0] + ticks[1]) * 0.01
    } else {
        f64::NAN
    }
}

/// Multiply-adds on as many numbers as there are registers for.
struct MultiplyAdds(u32);

impl SimdTask for MultiplyAdds {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> f64 {
        let (a, b) = (lanes.splat(black_box(0.999)), lanes.splat(black_box(1e-3)));
        let mut sums = [lanes.splat(1.0); 12];
        for _ in 0..self.0 {
            for sum in &mut sums {
                *sum = lanes.mul_add(*sum, a, b);
            }
        }
        let mut out = [0.0; EIGHT];
        let mut total = 0.0;
        for sum in sums {
            lanes.store(sum, &mut out);
            total += out[0];
        }
        total
    }
}

/// Floating-point operations per second of one thread, the best of some trials.
fn fma_rate(unit: Simd) -> f64 {
    let turns = 20_000_000;
    let trial = |_| {
        let start = thread_time();
        black_box(unit.run(MultiplyAdds(turns)));
        f64::from(turns) * (12 * 2 * EIGHT) as f64 / (thread_time() - start)
    };
    (0..5).map(trial).fold(0.0, f64::max)
}

/// Bytes per second that one thread moves in `a = b + 3 c` on arrays too large for caches, the best of some trials; a
/// written line counts twice, since it is read first.
fn bandwidth() -> f64 {
    let count = 1 << 24;
    let (mut a, b, c) = (vec![0.0; count], vec![1.0; count], vec![2.0; count]);
    let mut trial = |_| {
        let start = thread_time();
        for ((a, b), c) in a.iter_mut().zip(&b).zip(&c) {
            *a = b + 3.0 * c;
        }
        black_box(&mut a);
        (4 * 8 * count) as f64 / (thread_time() - start)
    };
    (0..5).map(&mut trial).fold(0.0, f64::max)
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
    let timed = timed?;
    let same = (case.law, case.shape) == ("neo-hookean", "bspline2");
    let reference = KINETIC.iter().find(|(problem, transfer, _)| {
        same && (*problem, *transfer) == (case.problem, case.transfer)
    });
    Ok(Row {
        case: *case,
        threads,
        particles: timed.particles,
        updates_per_s: vec![timed.updates_per_s],
        updates_per_cpu_s: vec![timed.updates_per_cpu_s],
        bytes_per_particle: timed.bytes_per_particle,
        kinetic_error: reference.map(|(.., exact)| (timed.kinetic / exact - 1.0).abs()),
    })
}

/// Time and memory of B's step with so many cells of matter along an edge, on one thread, in a grid of `room` as many.
fn scale_row(matter: f64, room: f64) -> Result<(usize, f64, f64), Box<dyn std::error::Error>> {
    let before = held();
    let (h, edge) = (1.0 / 64.0, matter / 64.0);
    let mut scene = Scene::solid();
    let low = 0.5 * (room - 1.0) * edge + 4.0 * h;
    fill(
        &mut scene,
        ELASTIC.law,
        &Block::new([low; 3], [low + edge; 3]),
        0.5 * h,
    )?;
    let grid = Grid::over([0.0; 3], [room * edge + 8.0 * h; 3], h)?;
    let mut solver = Explicit::new(grid, shape::Bspline2, settings(&ELASTIC)?)?;
    let particles = scene.particle_count();
    let steps = (2_000_000 / particles).clamp(3, 400) as u32;
    // So short that the smallest, which has the most, stays in the grid.
    let (warm_up, dt) = (2, 2e-5);
    let mut start = processor_time();
    for step in 1..=warm_up + steps {
        if step == warm_up + 1 {
            start = processor_time();
        }
        solver.step(&mut scene, f64::from(step) * dt)?;
    }
    let updates = f64::from(steps) * particles as f64;
    let time = (processor_time() - start) / updates;
    Ok((particles, time, (held() - before) / particles as f64))
}

/// Time of a particle's step from 1e3 to 5e6 particles, and with up to 1e6 times as much empty space as matter.
fn print_scaling(json: bool, quick: bool) -> Result<(), Box<dyn std::error::Error>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let sizes = [5.0, 8.0, 16.0, 32.0, 64.0, 86.0];
    let sizes = &sizes[..if quick { 4 } else { sizes.len() }];
    let rooms = [1.0, 10.0, 100.0];
    let cases = sizes.iter().map(|&matter| (matter, 1.0));
    let cases = cases.chain(rooms.iter().map(|&room| (16.0, room)));
    if !json {
        println!("particles  grid over matter  ns per particle and step  bytes/particle");
    }
    for (matter, room) in cases {
        let row = pool.install(|| scale_row(matter, room).map_err(|error| error.to_string()));
        let (particles, time, bytes) = row?;
        let volume = room.powi(3);
        if json {
            let object = serde_json::json!({
                "particles": particles, "grid_over_matter": volume,
                "seconds_per_update": time, "bytes_per_particle": bytes,
            });
            println!("{object}");
        } else {
            println!(
                "{particles:9}  {volume:16.0}  {:24.1}  {bytes:14.0}",
                time * 1e9
            );
        }
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let known = ["--json", "--quick", "scaling"];
    let [json, quick, scaling] = known.map(|flag| given.iter().any(|g| g == flag));
    if let Some(other) = given.iter().find(|g| !known.contains(&g.as_str())) {
        return Err(format!("{other}: only scaling, --json and --quick are known").into());
    }
    if scaling {
        return print_scaling(json, quick);
    }
    let (fma, bandwidth) = (fma_rate(Simd::widest()), bandwidth());
    if !json {
        println!(
            "this machine, one thread: {:.1} GFLOP/s, {:.1} GB/s",
            fma * 1e-9,
            bandwidth * 1e-9
        );
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
                rows[i].updates_per_cpu_s.extend(row.updates_per_cpu_s);
            }
        }
    }
    let median = |rates: &[f64]| {
        let mut rates = rates.to_vec();
        rates.sort_by(f64::total_cmp);
        rates[rates.len() / 2]
    };
    let elastic = rows
        .iter()
        .find(|row| row.case.problem == "B" && row.threads == 1);
    let elastic = elastic.map_or(f64::NAN, |row| median(&row.updates_per_cpu_s));
    if !json {
        println!(
            "problem law          shape     transfer   simd    threads  M updates/s  M updates/cpu s  over B elastic  of fma  of bandwidth  bytes/particle  kinetic error"
        );
    }
    for row in &rows {
        let case = &row.case;
        let simd = if case.simd.is_empty() {
            Simd::widest().name()
        } else {
            case.simd
        };
        let (rate, cpu_rate) = (median(&row.updates_per_s), median(&row.updates_per_cpu_s));
        let work = WORK.iter().find(|(name, ..)| *name == case.problem);
        let share = |of: f64, limit: f64| of * cpu_rate / limit;
        let (of_fma, of_bandwidth) = work.map_or((f64::NAN, f64::NAN), |(_, flops, bytes)| {
            (share(*flops, fma), share(*bytes, bandwidth))
        });
        if json {
            let object = serde_json::json!({
                "problem": case.problem, "law": case.law, "shape": case.shape,
                "transfer": case.transfer, "simd": simd, "threads": row.threads,
                "particles": row.particles, "updates_per_s": rate,
                "updates_per_cpu_s": cpu_rate, "ratio_to_elastic_b": cpu_rate / elastic,
                "fraction_of_fma": of_fma, "fraction_of_bandwidth": of_bandwidth,
                "bytes_per_particle": row.bytes_per_particle,
                "kinetic_error": row.kinetic_error,
            });
            println!("{object}");
        } else {
            let error = row
                .kinetic_error
                .map_or("-".to_owned(), |e| format!("{e:.1e}"));
            println!(
                "{:7} {:12} {:9} {:10} {:7} {:7}  {:11.3}  {:15.3}  {:14.2}  {:6.3}  {:12.3}  {:14.0}  {error}",
                case.problem,
                case.law,
                case.shape,
                case.transfer,
                simd,
                row.threads,
                rate * 1e-6,
                cpu_rate * 1e-6,
                cpu_rate / elastic,
                of_fma,
                of_bandwidth,
                row.bytes_per_particle,
            );
        }
    }
    Ok(())
}
