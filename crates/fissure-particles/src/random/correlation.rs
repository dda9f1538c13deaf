//! Correlation of a field between two places.

use super::error::{FieldError, positive};

/// Correlation of a field at two places as a function of their distance `d`: 1 at 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Correlation {
    /// `exp(−α d^1.5)`.
    Exponential {
        /// α, m^−1.5; > 0.
        alpha: f64,
    },
    /// `exp(−(d/ℓ)²)`: very smooth, and for long ℓ hard to embed.
    Gaussian {
        /// ℓ, m; > 0.
        length: f64,
    },
    /// Matérn's of order `ν = order + 1/2`, differentiable `order` times: with `x = √(2ν) d/ℓ`
    /// `exp(−x) n!/(2n)! Σ_{i=0}^n (n+i)!/(i!(n−i)!) (2x)^{n−i}`, n = `order`. Order 0 is
    /// `exp(−d/ℓ)`. Between these orders it needs a Bessel function and is not offered.
    Matern {
        /// ℓ, m; > 0.
        length: f64,
        /// ν − 1/2; at most 10.
        order: u32,
    },
}

impl Correlation {
    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// [`FieldError::Parameter`].
    pub fn check(&self) -> Result<(), FieldError> {
        match *self {
            Self::Exponential { alpha } => positive("alpha [m^-1.5]", alpha),
            Self::Gaussian { length } => positive("correlation length [m]", length),
            Self::Matern { length, order } => {
                positive("correlation length [m]", length)?;
                if order > 10 {
                    return Err(FieldError::Parameter {
                        parameter: "order of the Matérn correlation",
                        value: f64::from(order),
                        permitted: "at most 10",
                    });
                }
                Ok(())
            }
        }
    }

    /// Its value at a distance in m.
    pub fn at(&self, distance: f64) -> f64 {
        let d = distance.abs();
        match *self {
            Self::Exponential { alpha } => libm::exp(-alpha * d * d.sqrt()),
            Self::Gaussian { length } => libm::exp(-(d / length) * (d / length)),
            Self::Matern { length, order } => {
                let x = f64::from(2 * order + 1).sqrt() * d / length;
                libm::exp(-x) * matern_sum(order, 2.0 * x)
            }
        }
    }
}

/// `n!/(2n)! Σ_{i=0}^n (n+i)!/(i!(n−i)!) y^{n−i}`, as a sum over `k = n − i` whose terms follow from
/// one another: 1 at k = 0, then times `(n−k+1)/(k (2n−k+1))`.
fn matern_sum(order: u32, y: f64) -> f64 {
    let n = f64::from(order);
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..=order {
        let k = f64::from(k);
        term *= y * (n - k + 1.0) / (k * (2.0 * n - k + 1.0));
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matern_has_its_known_forms() {
        for d in [0.0, 0.01, 0.3, 1.0, 4.0] {
            let length = 0.7_f64;
            let known = |order: u32| {
                let x = f64::from(2 * order + 1).sqrt() * d / length;
                match order {
                    0 => (-x).exp(),
                    1 => (1.0 + x) * (-x).exp(),
                    2 => (1.0 + x + x * x / 3.0) * (-x).exp(),
                    _ => (1.0 + x + 0.4 * x * x + x * x * x / 15.0) * (-x).exp(),
                }
            };
            for order in 0..=3 {
                let error = Correlation::Matern { length, order }.at(d) - known(order);
                assert!(error.abs() <= 1e-15, "order {order} at {d}: {error:e}");
            }
        }
    }

    #[test]
    fn parameters_outside_their_range_are_refused() {
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            for bad in [
                Correlation::Exponential { alpha: value },
                Correlation::Gaussian { length: value },
                Correlation::Matern {
                    length: value,
                    order: 1,
                },
            ] {
                let refused = bad.check();
                assert!(
                    matches!(refused, Err(FieldError::Parameter { .. })),
                    "{bad:?}"
                );
            }
        }
        let rough = Correlation::Matern {
            length: 1.0,
            order: 11,
        };
        assert!(rough.check().is_err());
    }
}
