//! An explicit step of a neo-Hookean block that rings, per particle: linear functions and quadratic
//! B-splines, FLIP, MUSL, on all threads.

#![allow(missing_docs)] // criterion's macros make undocumented functions

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use fissure::prelude::*;

/// Cells along an edge; four particles in each.
const CELLS: f64 = 64.0;

fn block() -> Result<Scene<2>, Error> {
    let rubber = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene
        .fill(
            "block",
            rubber,
            &Block::new([0.0, 0.0], [CELLS, CELLS]),
            &Spacing(0.5),
        )?
        .set_velocity("block", |x| {
            vector![(x[1] / CELLS).sin(), (x[0] / CELLS).cos()] * 0.1
        })?;
    Ok(scene)
}

fn steps<S: Shape<2>>(criterion: &mut Criterion, name: &str, shape: S) -> Result<(), Error> {
    let mut scene = block()?;
    let grid = Grid::over([-32.0, -32.0], [CELLS + 32.0, CELLS + 32.0], 1.0)?;
    let mut solver = Explicit::new(grid, shape, ExplicitSettings::default())?;
    let mut group = criterion.benchmark_group("explicit step");
    group.throughput(Throughput::Elements(scene.particle_count() as u64));
    group.sample_size(20);
    let mut failed = None;
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            if let Err(error) = solver.step(&mut scene, f64::INFINITY) {
                failed = Some(error);
            }
        });
    });
    group.finish();
    failed.map_or(Ok(()), |error| Err(error.into()))
}

fn explicit(criterion: &mut Criterion) {
    steps(criterion, "linear", shape::Linear).expect("linear");
    steps(criterion, "bspline2", shape::Bspline2).expect("bspline2");
}

criterion_group!(benches, explicit);
criterion_main!(benches);
