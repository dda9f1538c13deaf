//! Cohesive laws: the traction that a crack still carries across a jump of the displacement.
//!
//! One small trait for every representation of a crack that knows its jump: two fields at the nodes,
//! particles cracked in two, interfaces. It asks for a jump and a normal and gives the traction, its
//! derivative and the energies per area. It knows no particle, no node and no area.
//!
//! **Contact is the caller's.** A jump that closes the crack, `δ·n < 0`, meets no normal traction
//! here: the caller adds a penalty, a contact force, or returns to the continuum as
//! [Rabczuk 2007, sec. 4.3.2] does. The law remembers what the crack has been through meanwhile.

mod traction_separation;

use std::fmt::Debug;

use fissure_tensor::{Matrix3, Vector3};
use serde::{Serialize, de::DeserializeOwned};

use crate::{MaterialError, Scale};

pub use traction_separation::{TractionSeparation, TractionSeparationState};

/// What a crack's two faces have done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Displacement of the + side less that of the − side, m.
    pub opening: Vector3<f64>,
    /// Normal of the crack, from the − side to the + side; need not be of unit length.
    pub normal: Vector3<f64>,
    /// Factors on the law's parameters.
    pub scale: Scale,
}

impl Jump {
    /// This jump across this normal, with the law's own parameters.
    pub fn new(opening: Vector3<f64>, normal: Vector3<f64>) -> Self {
        Self {
            opening,
            normal,
            scale: Scale::default(),
        }
    }
}

/// What a cohesive law returns. Energies are per crack area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traction<S> {
    /// Traction, Pa: the + side is pulled by its negative, the − side by itself.
    pub traction: Vector3<f64>,
    /// Its derivative with the jump, Pa/m.
    pub tangent: Matrix3<f64>,
    /// New state.
    pub state: S,
    /// Stored energy (total), J/m².
    pub stored: f64,
    /// Energy dissipated in this step, J/m².
    pub dissipated: f64,
}

/// A law between the jump across a crack and the traction; a pure function of jump and old state.
pub trait Cohesive: Send + Sync + 'static {
    /// History of one place of the crack. Serde keeps it in checkpoints.
    type State: Copy
        + Default
        + PartialEq
        + Debug
        + Send
        + Sync
        + Serialize
        + DeserializeOwned
        + 'static;

    /// Refuses parameters outside their range.
    ///
    /// # Errors
    /// [`MaterialError::Parameter`] with the field, the value and the rule.
    fn check(&self) -> Result<(), MaterialError>;

    /// Largest normal traction, Pa.
    fn strength(&self, scale: &Scale) -> f64;

    /// Energy per crack area to failure, J/m².
    fn toughness(&self, scale: &Scale) -> f64;

    /// Normal opening at which nothing is carried any more, m; may be infinite.
    fn critical_opening(&self, scale: &Scale) -> f64;

    /// Largest eigenvalue of the tangent over all states, Pa/m; bounds an explicit step.
    fn stiffness(&self, scale: &Scale) -> f64;

    /// Traction, tangent, state and energies at a jump.
    ///
    /// # Errors
    /// A jump or a normal that is not finite, or no normal at all; a scale that puts the parameters
    /// outside their range.
    fn update(
        &self,
        jump: &Jump,
        old: &Self::State,
    ) -> Result<Traction<Self::State>, MaterialError>;
}
