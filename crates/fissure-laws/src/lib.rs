//! The constitutive laws by name: one registry ([`LAWS`]), and what can be asked of any law in it
//! ([`Law`]): its contract, a path at a point, random updates, its speed, its isoerror map.
//!
//! Every law is compiled here, once, behind one object; whoever looks at laws by name does not compile
//! them again.

mod curve;
mod energy;
mod fuzz;
mod isoerror;
mod law;
mod parameter;
mod registry;
mod speed;
mod subject;
mod walk;

pub use fuzz::Fuzzed;
pub use isoerror::{Cell, Map};
pub use law::{Followed, Happened, Law, Reached, Space};
pub use parameter::{LawParameter, OWN, POSITIVE, Setting, Values, study_parameters};
pub use registry::{Entry, LAWS, NAMES, entry};
pub use speed::Speed;
