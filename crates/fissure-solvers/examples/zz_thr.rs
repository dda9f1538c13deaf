#![allow(missing_docs, clippy::print_stdout)]
use fissure_grid::{Grid, shape, simd::Simd};
use fissure_materials::NeoHookean;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Plane, Scene, Solver};
use fissure_solvers::{Explicit, ExplicitSettings, StressUpdate, Transfer};
use nalgebra::vector;
use std::time::Instant;
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1).unwrap_or("avx512".into());
    let dim = std::env::args().nth(2).unwrap_or("3".into());
    let rubber = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let settings = ExplicitSettings {
        transfer: Transfer::Apic,
        stress_update: StressUpdate::Last,
        cfl: 0.3,
        simd: Simd::named(&name).ok_or("simd")?,
        ..Default::default()
    };
    if dim == "3" {
        let mut scene = Scene::solid();
        let h = 1.0 / 64.0;
        scene
            .fill(
                "block",
                rubber,
                &Block::new([12.0 * h; 3], [52.0 * h; 3]),
                &Spacing(0.5 * h),
            )?
            .set_velocity("block", |x| {
                vector![1.0, 0.0, 0.0]
                    + vector![
                        (6.28 * x[1]).sin(),
                        (6.28 * x[2]).sin(),
                        (6.28 * x[0]).sin()
                    ]
            })?;
        let mut solver = Explicit::new(
            Grid::over([0.0; 3], [1.0; 3], h)?,
            shape::Bspline2,
            settings,
        )?;
        go(&mut scene, &mut solver)
    } else {
        let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
        let h = 1.0 / 320.0;
        scene
            .fill(
                "block",
                rubber,
                &Block::new([35.0 * h; 2], [285.0 * h; 2]),
                &Spacing(0.5 * h),
            )?
            .set_velocity("block", |x| {
                vector![1.0, 0.0] + vector![(6.28 * x[1]).sin(), (6.28 * x[0]).sin()]
            })?;
        let mut solver = Explicit::new(
            Grid::over([0.0; 2], [1.0; 2], h)?,
            shape::Bspline2,
            settings,
        )?;
        go(&mut scene, &mut solver)
    }
}
fn clock() -> f64 {
    let t = Instant::now();
    let mut x: u64 = std::hint::black_box(3);
    for _ in 0..20_000_000u32 { x = x.wrapping_mul(0x9E3779B97F4A7C15) ^ 1; }
    std::hint::black_box(x);
    20e6 * 4.0 / t.elapsed().as_secs_f64() / 1e9
}
fn go<const D: usize>(
    scene: &mut Scene<D>,
    solver: &mut dyn Solver<D>,
) -> Result<(), Box<dyn std::error::Error>> {
    for _ in 0..3 {
        solver.step(scene, f64::INFINITY)?;
    }
    let ghz = clock();
    let n = 30;
    let mut best = f64::INFINITY;
    let mut all = 0.0;
    for _ in 0..n {
        let t = Instant::now();
        solver.step(scene, f64::INFINITY)?;
        let e = t.elapsed().as_secs_f64();
        best = best.min(e);
        all += e;
    }
    let c = scene.particle_count() as f64 / 1e6;
    println!(
        "~{ghz:.2}-{:.2} GHz, {} particles, mean {:.3} best {:.3} M/s, kinetic {:?}",
        clock(), scene.particle_count(),
        n as f64 * c / all,
        c / best,
        scene.bodies()[0].kinetic_energy()
    );
    Ok(())
}
