//! Studies of constitutive laws: every law of the library by name, with its parameters.
//!
//! [`laws::LAWS`] is the registry; the studies drive a law of it at a point, through random updates and over
//! isoerror maps.

pub mod isoerror;
pub mod law_table;
pub mod laws;
pub mod point;

use fissure_study::Study;

/// The studies of laws, in the order of `--list`.
pub fn studies() -> Vec<Box<dyn Study>> {
    vec![
        Box::new(point::PointStudy),
        Box::new(law_table::LawTable),
        Box::new(isoerror::Isoerror),
    ]
}
