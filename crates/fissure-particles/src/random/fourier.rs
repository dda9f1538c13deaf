//! Discrete Fourier transform in `D` dimensions, axis by axis.

use rustfft::num_complex::Complex64;
use rustfft::{FftDirection, FftPlannerScalar};

/// Transforms `values` in place, without a factor; the first axis runs fastest.
pub(super) fn transform<const D: usize>(values: &mut [Complex64], size: &[usize; D]) {
    let mut planner = FftPlannerScalar::new();
    let mut stride = 1;
    for &length in size {
        let plan = planner.plan_fft(length, FftDirection::Forward);
        let mut line = vec![Complex64::default(); length];
        let mut scratch = vec![Complex64::default(); plan.get_inplace_scratch_len()];
        for block in values.chunks_exact_mut(stride * length) {
            for first in 0..stride {
                for (entry, value) in line.iter_mut().zip(block[first..].iter().step_by(stride)) {
                    *entry = *value;
                }
                plan.process_with_scratch(&mut line, &mut scratch);
                for (entry, value) in line.iter().zip(block[first..].iter_mut().step_by(stride)) {
                    *value = *entry;
                }
            }
        }
        stride *= length;
    }
}

/// The least even number from `least` on with no prime factor above 5.
pub(super) fn fast_length(least: usize) -> usize {
    let smooth = |mut n: usize| {
        for prime in [2, 3, 5] {
            while n.is_multiple_of(prime) {
                n /= prime;
            }
        }
        n == 1
    };
    let mut length = least.max(2).next_multiple_of(2);
    while !smooth(length) {
        length += 2;
    }
    length
}
