//! A steady step allocates nothing.

#![allow(clippy::unwrap_used)]

use std::alloc::System;

use fissure_grid::{Grid, Shape, shape};
use fissure_materials::{Isotropic, Material, NeoHookean};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Plane, Scene, Solver};
use fissure_solvers::{Explicit, ExplicitSettings, StressUpdate, Transfer};
use nalgebra::Vector2;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Allocations of twenty steps after ten of a block that rings in the middle of an empty grid, on so many threads.
fn allocations(
    law: impl Material,
    shape: impl Shape<2>,
    settings: ExplicitSettings,
    threads: usize,
) -> usize {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| {
        let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
        let block = Block::new([1.0, 1.0], [3.0, 3.0]);
        scene
            .fill("block", law, &block, &Spacing(1.0 / 32.0))
            .unwrap();
        let ringing = |x: &Vector2<f64>| Vector2::new(x[1].sin(), x[0].cos()) * 0.1;
        scene.set_velocity("block", ringing).unwrap();
        let grid = Grid::over([0.0, 0.0], [4.0, 4.0], 1.0 / 16.0).unwrap();
        let mut solver = Explicit::new(grid, shape, settings).unwrap();
        let mut run = |steps| {
            for _ in 0..steps {
                solver.step(&mut scene, f64::INFINITY).unwrap();
            }
        };
        run(10);
        let region = Region::new(HEAP);
        run(20);
        let change = region.change();
        change.allocations + change.reallocations
    })
}

/// One test, since the allocator counts what all tests do.
#[test]
fn a_steady_step_allocates_nothing() {
    let rubber = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let stone = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: 0.2,
    };
    let apic = ExplicitSettings {
        transfer: Transfer::Apic,
        stress_update: StressUpdate::Last,
        ..ExplicitSettings::default()
    };
    let musl = ExplicitSettings::default();
    assert_eq!(allocations(rubber, shape::Bspline2, apic, 1), 0, "apic");
    assert_eq!(
        allocations(rubber, shape::Bspline2, apic, 2),
        0,
        "two threads"
    );
    assert_eq!(
        allocations(stone, shape::Bspline2, musl, 1),
        0,
        "flip, musl"
    );
    assert_eq!(allocations(stone, shape::Linear, musl, 1), 0, "linear");
}
