//! Circulant embedding of a correlation on a lattice [Wood and Chan 1994; Dietrich and Newsam
//! 1997].
//!
//! The correlations of `n` lattice points are a block of a larger periodic matrix `C`, circulant in
//! each axis, whose first row is `c(k) = ρ(h |min(k, M − k)|)` with `M ≥ 2(n − 1)`. Its eigenvalues
//! `λ` are the discrete Fourier transform of `c`. If none is negative, `Re Σ_k √(λ_k/N) (ξ_k +
//! iη_k) e^{−2πi jk/M}` with independent standard normal ξ, η has exactly the covariance `C`.
//!
//! Where some are negative the period is doubled, since the correlation then dies off before it
//! repeats. If that does not help within the limit, negative eigenvalues are set to zero and the
//! others scaled so that the variance stays 1; the correlations are then wrong by at most twice the
//! share `Σ|λ⁻|/Σλ`, which is reported, and refused beyond what the caller permits.

use rustfft::num_complex::Complex64;

use super::correlation::Correlation;
use super::error::FieldError;
use super::fourier::{fast_length, transform};

/// Most points of an embedding; a point takes 24 bytes while a field is drawn.
const MOST_POINTS: usize = 1 << 25;
/// How often the period is doubled at most.
const DOUBLINGS: u32 = 3;
/// A negative share below this is round-off of the transform.
const ROUND_OFF: f64 = 1e-12;

/// How the correlation was embedded.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedding<const D: usize> {
    /// Points of the period along each axis.
    pub size: [usize; D],
    /// How often it was doubled to get rid of negative eigenvalues.
    pub doublings: u32,
    /// `Σ|λ⁻|/Σλ` of the negative eigenvalues, which were set to zero: a bound of half the error of
    /// all correlations. Below 1e-12 it is round-off.
    pub negative: f64,
}

impl<const D: usize> Embedding<D> {
    /// Number of points.
    pub fn points(&self) -> usize {
        self.size.iter().product()
    }
}

/// The embedding of a lattice of `points` with a `spacing`, and the roots of its eigenvalues over
/// the number of points.
pub(super) fn embed<const D: usize>(
    points: &[usize; D],
    spacing: f64,
    correlation: &Correlation,
    permitted: f64,
) -> Result<(Embedding<D>, Vec<f64>), FieldError> {
    let mut size = points.map(|n| fast_length(2 * (n - 1)));
    let count = size.iter().map(|&n| n as f64).product::<f64>();
    if !(count <= MOST_POINTS as f64) {
        return Err(FieldError::TooLarge {
            points: count,
            limit: MOST_POINTS,
        });
    }
    let mut doublings = 0;
    loop {
        let eigenvalues = eigenvalues(&size, spacing, correlation);
        let sum = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>();
        let positive = sum(&mut eigenvalues.iter().map(|v| v.max(0.0)));
        let negative = sum(&mut eigenvalues.iter().map(|v| (-v).max(0.0)));
        let total = positive - negative;
        let share = negative / total;
        let doubled = size.map(|n| 2 * n);
        let fits = doubled.iter().product::<usize>() <= MOST_POINTS;
        if share > ROUND_OFF && doublings < DOUBLINGS && fits {
            (size, doublings) = (doubled, doublings + 1);
            continue;
        }
        let embedding = Embedding {
            size,
            doublings,
            negative: share,
        };
        if !(share <= permitted.max(ROUND_OFF)) {
            return Err(FieldError::Negative {
                share,
                permitted,
                points: embedding.points(),
            });
        }
        let scale = total / positive / embedding.points() as f64;
        let roots = eigenvalues.iter().map(|v| (v.max(0.0) * scale).sqrt());
        return Ok((embedding, roots.collect()));
    }
}

fn eigenvalues<const D: usize>(
    size: &[usize; D],
    spacing: f64,
    correlation: &Correlation,
) -> Vec<f64> {
    let mut row = Vec::with_capacity(size.iter().product());
    let mut index = [0; D];
    for _ in 0..size.iter().product() {
        let squares = index.iter().zip(size).map(|(&k, &m)| {
            let steps = k.min(m - k) as f64;
            steps * steps
        });
        let distance = spacing * squares.sum::<f64>().sqrt();
        row.push(Complex64::new(correlation.at(distance), 0.0));
        advance(&mut index, size);
    }
    transform(&mut row, size);
    row.into_iter().map(|value| value.re).collect()
}

/// The next index of a lattice, the first axis fastest.
pub(super) fn advance<const D: usize>(index: &mut [usize; D], size: &[usize; D]) {
    for (k, &length) in index.iter_mut().zip(size) {
        *k += 1;
        if *k < length {
            return;
        }
        *k = 0;
    }
}
