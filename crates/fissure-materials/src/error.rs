//! What can be wrong with a law or a deformation handed to it.

use thiserror::Error;

use crate::Response;

/// Why a law refused its parameters, its band or a deformation.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MaterialError {
    /// A parameter is outside its permitted range.
    #[error("{law}: parameter '{parameter}' is {value}; permitted: {permitted}")]
    Parameter {
        /// The law.
        law: &'static str,
        /// The parameter's field name.
        parameter: &'static str,
        /// Its value.
        value: f64,
        /// The permitted range.
        permitted: &'static str,
    },
    /// The band is so wide that the material point would snap back [Sanchez 2010, eq. 4.5.17].
    #[error(
        "{law}: the band of {width} m is over the limit of {limit} m \
         (stiffness × toughness / (strength² × steepest slope)); refine the grid"
    )]
    Band {
        /// The law.
        law: &'static str,
        /// Width handed over, m.
        width: f64,
        /// Largest width with a unique response, m.
        limit: f64,
    },
    /// The deformation gradient is not finite or does not preserve orientation.
    #[error("deformation gradient has determinant {determinant}; permitted: finite and > 0")]
    Deformation {
        /// Its determinant.
        determinant: f64,
    },
    /// The response is not finite.
    #[error("{law}: stress is not finite")]
    NotFinite {
        /// The law.
        law: &'static str,
    },
    /// Choices that do not go together.
    #[error("{law}: {reason}")]
    Unsupported {
        /// The law.
        law: &'static str,
        /// What does not go with what, and why.
        reason: &'static str,
    },
    /// A local iteration did not converge.
    #[error("{law}: no convergence in {iterations} iterations, residual {residual}")]
    NoConvergence {
        /// The law.
        law: &'static str,
        /// Iterations done.
        iterations: usize,
        /// Last residual, relative.
        residual: f64,
    },
}

/// Refuses a parameter for which `valid` is false; NaN never is valid.
pub fn check_parameter(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    valid: bool,
    permitted: &'static str,
) -> Result<(), MaterialError> {
    if valid && value.is_finite() {
        Ok(())
    } else {
        Err(MaterialError::Parameter {
            law,
            parameter,
            value,
            permitted,
        })
    }
}

/// Refuses a toughness that its scale has made infinite or nothing. Asked where a band is judged: an
/// infinite toughness has no limit of it, and no crack.
pub(crate) fn check_scaled_toughness(
    law: &'static str,
    toughness: f64,
) -> Result<(), MaterialError> {
    let name = "toughness times its scale";
    check_parameter(law, name, toughness, toughness > 0.0, "finite and > 0")
}

/// Refuses an answer that units near the largest and the smallest numbers have made infinite or NaN.
pub(crate) fn check_finite<S>(
    law: &'static str,
    response: Response<S>,
) -> Result<Response<S>, MaterialError> {
    let energies = response.stored.is_finite() && response.dissipated.is_finite();
    if energies && response.stress.is_finite() {
        Ok(response)
    } else {
        Err(MaterialError::NotFinite { law })
    }
}

/// Refuses a band that is zero or not below its limit.
pub(crate) fn check_below(law: &'static str, width: f64, limit: f64) -> Result<(), MaterialError> {
    if width > 0.0 && width < limit {
        return Ok(());
    }
    Err(MaterialError::Band { law, width, limit })
}
