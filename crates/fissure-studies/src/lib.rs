//! The experiments of the source documents, one sub-command each.
//!
//! A study implements [`framework::Study`] and is listed in [`studies`]; the framework
//! reads the command line, expands the parameters into the combinations to run and
//! prints the rows.

pub mod framework;
pub mod isoerror;
pub mod law_table;
pub mod laws;
pub mod point;
pub mod tensile_bar;

use framework::Study;

/// Every study of the binary, in the order of `--list`.
pub fn studies() -> Vec<Box<dyn Study>> {
    vec![
        Box::new(tensile_bar::TensileBar),
        Box::new(point::PointStudy),
        Box::new(law_table::LawTable),
        Box::new(isoerror::Isoerror),
    ]
}
