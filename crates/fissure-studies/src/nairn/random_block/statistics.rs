//! Means and variances of normal samples: intervals and tests.
//!
//! With `n` values of mean `m` and variance `s²` (of `n − 1`):
//!
//! 1. mean: `m ± t_{n−1}(1 − a/2) s/√n`;
//! 2. standard deviation: `s √((n−1)/χ²_{n−1}(1 − a/2))` to `s √((n−1)/χ²_{n−1}(a/2))`;
//! 3. equal means (Welch): `t = (m₁ − m₂)/√(s₁²/n₁ + s₂²/n₂)` with the degrees of freedom of
//!    Welch and Satterthwaite, two-sided;
//! 4. equal variances (Fisher): `F = s₁²/s₂²` on `n₁ − 1, n₂ − 1` degrees of freedom, two-sided.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor, StudentsT};

/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.95;

/// Moments of a sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments {
    pub number: f64,
    pub mean: f64,
    pub deviation: f64,
}

impl Moments {
    pub(super) fn of(values: &[f64]) -> Self {
        let number = values.len() as f64;
        let mean = values.iter().sum::<f64>() / number;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        Self {
            number,
            mean,
            deviation: (squares / (number - 1.0)).sqrt(),
        }
    }

    fn freedom(&self) -> f64 {
        self.number - 1.0
    }

    /// Half the 95 % interval of the mean.
    pub(super) fn mean_interval(&self) -> f64 {
        let quantile = StudentsT::new(0.0, 1.0, self.freedom())
            .map_or(f64::NAN, |t| t.inverse_cdf(0.5 + 0.5 * CONFIDENCE));
        quantile * self.deviation / self.number.sqrt()
    }

    /// Ends of the 95 % interval of the standard deviation.
    pub(super) fn deviation_interval(&self) -> (f64, f64) {
        let end = |p: f64| {
            let quantile =
                ChiSquared::new(self.freedom()).map_or(f64::NAN, |chi| chi.inverse_cdf(p));
            self.deviation * (self.freedom() / quantile).sqrt()
        };
        (end(0.5 + 0.5 * CONFIDENCE), end(0.5 - 0.5 * CONFIDENCE))
    }
}

/// A test of two samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Test {
    pub statistic: f64,
    /// Probability of a statistic as far out if the hypothesis holds, two-sided.
    pub p: f64,
}

/// Whether two means may be equal.
pub(super) fn welch(one: &Moments, other: &Moments) -> Test {
    let part = |m: &Moments| m.deviation * m.deviation / m.number;
    let (a, b) = (part(one), part(other));
    let statistic = (one.mean - other.mean) / (a + b).sqrt();
    let freedom = (a + b).powi(2) / (a * a / one.freedom() + b * b / other.freedom());
    let p = StudentsT::new(0.0, 1.0, freedom).map_or(f64::NAN, |t| 2.0 * t.cdf(-statistic.abs()));
    Test { statistic, p }
}

/// Whether two variances may be equal.
pub(super) fn fisher(one: &Moments, other: &Moments) -> Test {
    let statistic = (one.deviation / other.deviation).powi(2);
    let below =
        FisherSnedecor::new(one.freedom(), other.freedom()).map_or(f64::NAN, |f| f.cdf(statistic));
    Test {
        statistic,
        p: 2.0 * below.min(1.0 - below),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles as printed in tables of the distributions.
    #[test]
    fn intervals_and_tests_agree_with_tables() {
        let ten = Moments {
            number: 10.0,
            mean: 3.0,
            deviation: 2.0,
        };
        assert!((ten.mean_interval() - 2.262 * 2.0 / 10.0_f64.sqrt()).abs() < 1e-3);
        let (low, high) = ten.deviation_interval();
        assert!((low - 2.0 * (9.0_f64 / 19.023).sqrt()).abs() < 1e-3);
        assert!((high - 2.0 * (9.0_f64 / 2.700).sqrt()).abs() < 1e-3);
        // F_{9, 9}(0.975) = 4.026, t_18(0.975) = 2.101.
        let wide = Moments {
            deviation: 2.0 * 4.026_f64.sqrt(),
            ..ten
        };
        assert!((fisher(&wide, &ten).p - 0.05).abs() < 1e-3);
        assert!((fisher(&ten, &wide).p - 0.05).abs() < 1e-3);
        let apart = Moments {
            mean: 3.0 + 2.101 * (2.0 * 4.0 / 10.0_f64).sqrt(),
            ..ten
        };
        assert!((welch(&ten, &apart).p - 0.05).abs() < 1e-3);
    }

    #[test]
    fn moments_of_few_numbers() {
        let moments = Moments::of(&[1.0, 2.0, 3.0, 4.0]);
        assert_eq!(moments.mean, 2.5);
        assert!((moments.deviation - (5.0_f64 / 3.0).sqrt()).abs() < 1e-15);
    }
}
