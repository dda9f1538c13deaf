//! The parts of an implicit step on an elastic block: 2D with 99,904 unknowns, 3D with 95,232. Assembling
//! runs on all threads, the rest on one.
//!
//! "Newton step" is a whole load step: two iterations, so three calls of the law. Before each block is timed a line
//! says how large the factor is and how much memory the process has held at most (Linux).
//!
//! The group `implicit against explicit` pulls a bar smoothly over twenty transits of a wave; lines before each row say how
//! far the force is from that of equilibrium then.
//!
//! `cargo bench -p fissure-benches --bench implicit`

#![allow(missing_docs)] // criterion's macros make undocumented functions
#![allow(clippy::print_stdout)] // What criterion does not measure: memory, errors.

use criterion::{Criterion, criterion_group, criterion_main};
use fissure::nalgebra::SMatrix;
use fissure::prelude::*;
use fissure::solvers::linear::{
    BlockMatrix, Direct, Elimination, Incomplete, KrylovSettings, NodeBlocks, Preconditioner,
    conjugate_gradients,
};

const STONE: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};

/// A block of unit cells, `2^D` particles in each, its lower end held and its upper one pulled.
fn block<const D: usize>(
    mut scene: Scene<D>,
    cells: [f64; D],
) -> Result<(Scene<D>, QuasiStatic<shape::Linear, D>), Error> {
    let mut lower = [0.0; D];
    let mut upper = cells;
    scene.fill("block", STONE, &Block::new(lower, cells), &Spacing(0.5))?;
    lower[0] = -1.0;
    upper[0] = 0.0;
    let along = SVector::<f64, D>::from_fn(|axis, _| if axis == 0 { 1.0 } else { 0.0 });
    let clamp = Hold::All(along);
    scene.rigid(
        "held",
        &Block::new(lower, upper),
        &Spacing(0.5),
        clamp,
        Velocity(|_| 0.0),
    )?;
    lower[0] = cells[0];
    upper[0] = cells[0] + 1.0;
    let clamp = Hold::Component(along);
    scene.rigid(
        "pulled",
        &Block::new(lower, upper),
        &Spacing(0.5),
        clamp,
        Velocity(|_| 1e-4),
    )?;
    let far = cells.map(|length| length + 4.0);
    let grid = Grid::over([-4.0; D], far, 1.0)?;
    let solver = QuasiStatic::new(grid, shape::Linear, QuasiStaticSettings::default())?;
    Ok((scene, solver))
}

/// The block's stiffness with its lower end held.
fn held<const D: usize>(matrix: &BlockMatrix<D>, positions: &[[f64; D]]) -> BlockMatrix<D> {
    let mut matrix = matrix.clone();
    for (node, place) in positions.iter().enumerate() {
        if place[0] < 0.5 {
            matrix.hold(node, &SMatrix::identity(), D);
        }
    }
    matrix
}

fn parts<const D: usize>(
    criterion: &mut Criterion,
    name: &str,
    scene: Scene<D>,
    cells: [f64; D],
) -> Result<(), Error> {
    let (mut scene, mut solver) = block(scene, cells)?;
    let mut group = criterion.benchmark_group(format!("implicit {name}"));
    group.sample_size(10);
    solver.step(&mut scene, f64::INFINITY)?;
    let peak = most_memory();
    let (matrix, positions) = solver.stiffness(&mut scene)?;
    let mut matrix = held(matrix, &positions);
    let b = vec![1.0; matrix.size()];
    for elimination in [Elimination::NestedDissection, Elimination::MinimumDegree] {
        let direct = Direct::with_elimination(matrix.pattern(), &positions, elimination);
        let entries = direct.expect("analysed").factor_entries();
        println!(
            "{name}: {} unknowns, {elimination:?}: {entries} numbers in the factor",
            b.len()
        );
    }
    println!("{name}: at most {peak} of memory after a whole load step");
    group.bench_function("law and assembly", |bencher| {
        bencher.iter(|| {
            solver
                .stiffness(&mut scene)
                .map(|(matrix, _)| matrix.size())
        });
    });
    group.bench_function("analyse", |bencher| {
        bencher.iter(|| Direct::new(matrix.pattern(), &positions));
    });
    for (title, elimination) in [
        ("factorise, minimum degree", Elimination::MinimumDegree),
        ("factorise", Elimination::NestedDissection),
    ] {
        let direct = Direct::with_elimination(matrix.pattern(), &positions, elimination);
        let mut direct = direct.expect("analysed");
        group.bench_function(title, |bencher| {
            bencher.iter(|| direct.factorise(&matrix, 0.0));
        });
    }
    let mut direct = Direct::new(matrix.pattern(), &positions).expect("analysed");
    direct.factorise(&matrix, 0.0).expect("factorised");
    group.bench_function("solve", |bencher| {
        bencher.iter(|| direct.solve(&matrix, &mut b.clone()));
    });
    let blocks = NodeBlocks::new(&matrix).expect("blocks");
    let cholesky = Incomplete::cholesky(&matrix).expect("cholesky");
    let named: [(&str, &dyn Preconditioner); 2] = [
        ("CG, node blocks", &blocks),
        ("CG, incomplete Cholesky", &cholesky),
    ];
    for (method, preconditioner) in named {
        let settings = KrylovSettings {
            max_iterations: 10_000,
            ..KrylovSettings::default()
        };
        group.bench_function(method, |bencher| {
            bencher.iter(|| {
                let mut x = vec![0.0; b.len()];
                conjugate_gradients(&mut matrix, preconditioner, &b, &mut x, &settings)
            });
        });
    }
    group.bench_function("Newton step", |bencher| {
        bencher.iter(|| {
            solver
                .step(&mut scene, f64::INFINITY)
                .expect("equilibrium")
                .iterations
        });
    });
    group.finish();
    Ok(())
}

/// The most memory that the process has held so far, as the kernel says it.
fn most_memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.map_or("an unknown amount".to_owned(), |amount| {
        amount.trim().to_owned()
    })
}

/// Cells along the bar that both solvers pull, and across it.
const BAR: [f64; 2] = [64.0, 8.0];

/// Force on the bar's lower grip after a smooth pull of twenty transits, by a solver.
fn pulled(
    make: impl FnOnce(Grid<2>, f64) -> Result<Box<dyn Solver<2>>, Error>,
) -> Result<f64, Error> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let ramp = 20.0 * BAR[0] / STONE.p_wave_speed();
    let along = || Hold::Component(Vector2::x());
    let across = |from, to| Block::new([from, 0.0], [to, BAR[1]]);
    let speed = move |t: f64| match t < ramp {
        // The speed of a smooth rise by 1e-4 of the length.
        true => 1e-4 * BAR[0] / ramp * (1.0 - (std::f64::consts::TAU * t / ramp).cos()),
        false => 0.0,
    };
    scene.fill("bar", STONE, &across(0.0, BAR[0]), &Spacing(0.5))?;
    scene.rigid(
        "held",
        &across(-1.0, 0.0),
        &Spacing(0.5),
        along(),
        Velocity(|_| 0.0),
    )?;
    let end = across(BAR[0], BAR[0] + 1.0);
    scene.rigid("pulled", &end, &Spacing(0.5), along(), Velocity(speed))?;
    let grid = Grid::over([-4.0; 2], BAR.map(|length| length + 4.0), 1.0)?;
    let mut solver = make(grid, ramp)?;
    while scene.time() < ramp {
        solver.step(&mut scene, ramp)?;
    }
    Ok(scene.reaction("held").map_or(f64::NAN, |force| force.x))
}

fn explicitly(cfl: f64) -> Result<f64, Error> {
    pulled(|grid, _| {
        let settings = ExplicitSettings {
            cfl,
            ..ExplicitSettings::default()
        };
        Ok(Box::new(Explicit::new(grid, shape::Linear, settings)?))
    })
}

fn implicitly(steps: f64) -> Result<f64, Error> {
    pulled(|grid, ramp| {
        let settings = ImplicitSettings {
            step: ramp / steps,
            ..ImplicitSettings::default()
        };
        Ok(Box::new(Implicit::new(grid, shape::Linear, settings)?))
    })
}

/// Error of the force and time of a slow pull.
fn slow_pull(criterion: &mut Criterion) -> Result<(), Error> {
    let exact = pulled(|grid, ramp| {
        let settings = QuasiStaticSettings {
            step: ramp / 10.0,
            ..QuasiStaticSettings::default()
        };
        Ok(Box::new(QuasiStatic::new(grid, shape::Linear, settings)?))
    })?;
    let mut group = criterion.benchmark_group("implicit against explicit");
    group.sample_size(10);
    let error = |found: f64| (found / exact - 1.0).abs();
    for cfl in [0.9, 0.4] {
        let name = format!("explicit, {cfl} of the limit");
        println!("{name}: force off by {:.1e}", error(explicitly(cfl)?));
        group.bench_function(name, |bencher| bencher.iter(|| explicitly(cfl)));
    }
    for steps in [10.0, 20.0, 40.0, 80.0] {
        let name = format!("implicit, {steps} steps");
        println!("{name}: force off by {:.1e}", error(implicitly(steps)?));
        group.bench_function(name, |bencher| bencher.iter(|| implicitly(steps)));
    }
    group.finish();
    Ok(())
}

fn implicit(criterion: &mut Criterion) {
    let plane = Scene::plane(Plane::Strain { thickness: 1.0 });
    parts(criterion, "2D", plane, [223.0, 222.0]).expect("2D");
    parts(criterion, "3D", Scene::solid(), [31.0, 30.0, 31.0]).expect("3D");
    slow_pull(criterion).expect("a slow pull");
}

criterion_group!(benches, implicit);
criterion_main!(benches);
