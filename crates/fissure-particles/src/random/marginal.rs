//! From standard normal numbers to positive factors of mean 1.

use std::f64::consts::SQRT_2;

use super::error::{FieldError, positive};

/// The distribution of a factor at one place, of mean 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Marginal {
    /// `max(1 + deviation·z, least)`. Raising what is below `least` raises the mean a little; with
    /// `least ≤ 1 − 4 deviation` by less than 1e-5 of the deviation.
    Normal {
        /// Standard deviation, the coefficient of variation; > 0.
        deviation: f64,
        /// Least value; in (0, 1).
        least: f64,
    },
    /// `exp(s z − s²/2)` with `s² = ln(1 + deviation²)`.
    LogNormal {
        /// Standard deviation, the coefficient of variation; > 0.
        deviation: f64,
    },
    /// Weibull's with the modulus `m`: `(−ln(1 − Φ(z)))^{1/m} / Γ(1 + 1/m)`. For a strength that is
    /// to be the weakest of a volume `V` of links of `V₀`, multiply by `(V₀/V)^{1/m}`.
    Weibull {
        /// m; > 0.1. The coefficient of variation is about 1.2/m.
        modulus: f64,
    },
}

impl Marginal {
    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// [`FieldError::Parameter`].
    pub fn check(&self) -> Result<(), FieldError> {
        let refuse = |parameter, value, permitted| {
            Err(FieldError::Parameter {
                parameter,
                value,
                permitted,
            })
        };
        match *self {
            Self::Normal { deviation, least } => {
                positive("deviation", deviation)?;
                if !(least > 0.0 && least < 1.0) {
                    return refuse("least", least, "in (0, 1)");
                }
                Ok(())
            }
            Self::LogNormal { deviation } => positive("deviation", deviation),
            Self::Weibull { modulus } => {
                if !(modulus > 0.1 && modulus.is_finite()) {
                    return refuse("modulus", modulus, "finite and > 0.1");
                }
                Ok(())
            }
        }
    }

    /// The factor that belongs to a standard normal number.
    pub fn of(&self, z: f64) -> f64 {
        match *self {
            Self::Normal { deviation, least } => (1.0 + deviation * z).max(least),
            Self::LogNormal { deviation } => {
                let square = libm::log1p(deviation * deviation);
                libm::exp(square.sqrt() * z - 0.5 * square)
            }
            Self::Weibull { modulus } => {
                libm::pow(-log_survival(z), 1.0 / modulus) / libm::tgamma(1.0 + 1.0 / modulus)
            }
        }
    }
}

/// `ln(1 − Φ(z))`, to round-off in both tails.
fn log_survival(z: f64) -> f64 {
    if z > 0.0 {
        libm::log(0.5 * libm::erfc(z / SQRT_2))
    } else {
        libm::log1p(-0.5 * libm::erfc(-z / SQRT_2))
    }
}
