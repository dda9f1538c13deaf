//! Interleaved timing of small functions.

use std::hint::black_box;
use std::time::Instant;

use fissure_tensor::Sym;

/// Tensors with components spread over `±1`, from a fixed linear congruential sequence.
pub fn tensors(count: usize, plane: bool) -> Vec<Sym> {
    let mut state = 12_345_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..count)
        .map(|_| {
            let mut a = Sym::new(next(), next(), next(), next(), next(), next());
            if plane {
                a.mandel[3] = 0.0;
                a.mandel[4] = 0.0;
            }
            a
        })
        .collect()
}

/// Time of one call, averaged over one pass through the inputs, ns.
pub fn nanoseconds_per_call<I, T>(inputs: &[I], f: impl Fn(&I) -> T) -> f64 {
    let start = Instant::now();
    for input in inputs {
        black_box(f(black_box(input)));
    }
    start.elapsed().as_secs_f64() * 1e9 / inputs.len() as f64
}

/// The middle value.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
