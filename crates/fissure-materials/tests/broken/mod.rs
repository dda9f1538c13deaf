//! Laws that are broken on purpose, each in one way.

mod faulty;
mod hidden_state;
mod negative_dissipation;
mod not_objective;
mod wrong_fracture_energy;
mod wrong_tangent;

pub use faulty::{Fault, Faulty};
pub use hidden_state::HiddenState;
pub use negative_dissipation::NegativeDissipation;
pub use not_objective::NotObjective;
pub use wrong_fracture_energy::WrongFractureEnergy;
pub use wrong_tangent::WrongTangent;
