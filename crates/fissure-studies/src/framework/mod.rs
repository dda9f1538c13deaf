//! What every study shares: parameters, the command line and the reporting of results.

mod nearest;
mod overrides;
mod parameter;
mod parameter_error;
mod parameters;
mod permitted;
mod value;

pub use overrides::Overrides;
pub use parameter::Parameter;
pub use parameter_error::ParameterError;
pub use parameters::Parameters;
pub use permitted::Permitted;
pub use value::Value;
