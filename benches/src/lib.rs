//! Time per step and per call of a law: `cargo bench -p fissure-benches`.
//!
//! `cargo run --release -p fissure-benches --bin throughput` prints particle updates per second, `--bin instructions` how
//! many instructions an update takes, and `benches/peers/run` updates of other codes on the same problems.
//!
//! The benchmarks are in `benches/benches`; here is what the programs share.

mod own_law;

use fissure::prelude::*;

pub use own_law::{OneByOne, OwnLaw};

/// Fills a block with a law by its name: `isotropic`, `decohesive` (that stays sound), `own` ([`OwnLaw`]) and
/// `own-by-one` (the same without its answers by eights), or neo-Hookean for any other; sets it in motion.
///
/// # Errors
/// What the scene refuses.
pub fn fill<const D: usize>(
    scene: &mut Scene<D>,
    law: &str,
    block: &Block<D>,
    spacing: f64,
) -> Result<(), Error> {
    let spacing = Spacing(spacing);
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let own = Hyperelastic(OwnLaw {
        density: elastic.density,
        lambda: elastic.lambda(),
        shear: elastic.shear_modulus(),
    });
    match law {
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
        "own" => scene.fill("block", own, block, &spacing)?,
        "own-by-one" => scene.fill("block", OneByOne(own), block, &spacing)?,
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

/// Bytes that the program holds on its heap; it has to have `stats_alloc`'s allocator.
pub fn held() -> f64 {
    // What a reallocation adds or gives back is in both numbers already.
    let stats = stats_alloc::INSTRUMENTED_SYSTEM.stats();
    stats.bytes_allocated as f64 - stats.bytes_deallocated as f64
}

/// Processor time of this thread so far, s; NaN where the system does not tell.
pub fn thread_time() -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let first = stat.split_whitespace().next();
    first.and_then(|n| n.parse().ok()).unwrap_or(f64::NAN) * 1e-9
}
