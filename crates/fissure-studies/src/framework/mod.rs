//! What every study shares: parameters, the command line and the reporting of results.

mod nearest;
mod number_text;
mod overrides;
mod parameter;
mod parameter_error;
mod parameters;
mod permitted;
mod report;
mod row;
mod row_files;
mod simulation_row;
mod table;
mod value;

pub use overrides::Overrides;
pub use parameter::Parameter;
pub use parameter_error::ParameterError;
pub use parameters::Parameters;
pub use permitted::Permitted;
pub use report::{Delivery, Report, ReportError};
pub use row::{Field, Fields, Row};
pub use simulation_row::{Measures, SimulationRow};
pub use value::Value;
