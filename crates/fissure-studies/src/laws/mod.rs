//! Studies of constitutive laws: a law of the registry ([`fissure_laws::LAWS`]) at a point, through
//! random updates, and over isoerror maps.

mod chosen;
mod isoerror;
mod point;
mod table;

use fissure_study::Study;

/// The studies of laws, in the order of `--list`.
pub fn studies() -> Vec<Box<dyn Study>> {
    vec![
        Box::new(point::PointStudy),
        Box::new(table::LawTable),
        Box::new(isoerror::Isoerror),
    ]
}
