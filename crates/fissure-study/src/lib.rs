//! What every study shares: parameters, the command line and the reporting of results.
//!
//! A study implements [`Study`]; [`execute`] reads the command line, expands the parameters into the
//! combinations to run and prints the rows. One's own studies run by it as well as those of fissure.

mod combinations;
mod command_error;
mod command_line;
mod form;
mod listing;
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
mod study;
mod table;
mod value;

pub use combinations::combinations;
pub use command_line::execute;
pub use form::Form;
pub use overrides::Overrides;
pub use parameter::Parameter;
pub use parameter_error::ParameterError;
pub use parameters::Parameters;
pub use permitted::Permitted;
pub use report::{Delivery, Report, ReportError};
pub use row::{Field, Fields, Row};
pub use simulation_row::{Measures, SimulationRow};
pub use study::{Study, StudyError};
pub use value::Value;
