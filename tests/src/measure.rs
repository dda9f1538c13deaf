//! Exact sums, bits and observed orders.

use fissure::nalgebra::SVector;
use fissure::prelude::*;

/// Neumaier's compensated sum.
pub fn compensated(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut lost) = (0.0_f64, 0.0);
    for value in values {
        let next = sum + value;
        lost += if sum.abs() >= value.abs() {
            (sum - next) + value
        } else {
            (value - next) + sum
        };
        sum = next;
    }
    sum + lost
}

/// Momentum of all particles, kg·m/s.
pub fn momentum<const D: usize>(scene: &Scene<D>) -> SVector<f64, D> {
    SVector::from_fn(|axis, _| compensated(each(scene).map(|(m, v)| m * v[axis])))
}

/// `Σ m|v|`, kg·m/s.
pub fn momentum_scale<const D: usize>(scene: &Scene<D>) -> f64 {
    compensated(each(scene).map(|(m, v)| m * v.norm()))
}

fn each<const D: usize>(scene: &Scene<D>) -> impl Iterator<Item = (f64, &SVector<f64, D>)> {
    scene.bodies().iter().flat_map(|body| {
        let particles = body.particles();
        let velocity = &particles.motion.velocity;
        particles.mass.iter().copied().zip(velocity)
    })
}

/// Everything that steps have changed, in bytes: floats keep their bits.
///
/// # Errors
/// A state that does not encode.
pub fn bits<const D: usize>(scene: &Scene<D>) -> Result<Vec<Section>, PersistError> {
    scene.save()
}

/// Largest component of the difference of two lists of vectors; NaN if any is.
pub fn largest_difference<const D: usize>(a: &[SVector<f64, D>], b: &[SVector<f64, D>]) -> f64 {
    let mut largest = if a.len() == b.len() { 0.0 } else { f64::NAN };
    for (a, b) in a.iter().zip(b) {
        for difference in (a - b).iter() {
            // `max` would drop a NaN.
            if !(difference.abs() <= largest) {
                largest = difference.abs();
            }
        }
    }
    largest
}

/// The order in which an error falls when its cause is halved.
pub type Order = f64;

/// `log₂` of the ratios of consecutive errors.
pub fn observed_orders(errors: &[f64]) -> Vec<Order> {
    errors
        .windows(2)
        .map(|pair| (pair[0] / pair[1]).abs().log2())
        .collect()
}
