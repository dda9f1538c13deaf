//! The parts of an implicit step on an elastic block: 2D with 99,904 unknowns, 3D with 95,232. Assembling
//! runs on all threads, the rest on one.
//!
//! "Newton step" is a whole load step: two iterations, so three calls of the law.
//!
//! `cargo bench -p fissure-benches --bench implicit`

#![allow(missing_docs)] // criterion's macros make undocumented functions

use criterion::{Criterion, criterion_group, criterion_main};
use fissure::nalgebra::SMatrix;
use fissure::prelude::*;
use fissure::solvers::linear::{
    BlockMatrix, Direct, Incomplete, KrylovSettings, NodeBlocks, Preconditioner,
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
    let (matrix, positions) = solver.stiffness(&mut scene)?;
    let mut matrix = held(matrix, &positions);
    let b = vec![1.0; matrix.size()];
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
    let mut direct = Direct::new(matrix.pattern(), &positions).expect("analysed");
    group.bench_function("factorise", |bencher| {
        bencher.iter(|| direct.factorise(&matrix, 0.0));
    });
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

fn implicit(criterion: &mut Criterion) {
    let plane = Scene::plane(Plane::Strain { thickness: 1.0 });
    parts(criterion, "2D", plane, [223.0, 222.0]).expect("2D");
    parts(criterion, "3D", Scene::solid(), [31.0, 30.0, 31.0]).expect("3D");
}

criterion_group!(benches, implicit);
criterion_main!(benches);
