//! Contact between bodies.
//!
//! Bodies share one velocity field unless a contact is declared between two of them: where they
//! meet they then move as one, which is a perfect bond. Each body named in a contact has a velocity
//! field of its own. Two such bodies without a contact between them, or one of them and a body in
//! no contact, are bonded as before.

use crate::error::SceneError;
use crate::scene::Scene;
use nalgebra::SVector;
use serde::{Deserialize, Serialize};

/// What two bodies, or the faces of a crack, do to each other where they touch. In all cases they may part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum ContactLaw {
    /// No tangential force.
    #[default]
    Frictionless,
    /// Tangential force up to `friction` (≥ 0) times the normal one.
    Coulomb {
        /// Coefficient of friction.
        friction: f64,
    },
    /// No sliding while they touch.
    Stick,
}

impl ContactLaw {
    /// The coefficient of friction, if it is outside its range (finite and ≥ 0).
    pub(crate) fn refused(&self) -> Option<f64> {
        match *self {
            Self::Coulomb { friction } if !(friction >= 0.0 && friction.is_finite()) => {
                Some(friction)
            }
            _ => None,
        }
    }

    /// The tangential over the normal force at which they slide.
    pub fn friction(&self) -> f64 {
        match *self {
            Self::Frictionless => 0.0,
            Self::Coulomb { friction } => friction,
            Self::Stick => f64::INFINITY,
        }
    }
}

/// A contact between two bodies of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    pub(crate) name: String,
    pub(crate) bodies: [usize; 2],
    pub(crate) law: ContactLaw,
}

impl Contact {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The two bodies, as indices into the scene's.
    pub fn bodies(&self) -> [usize; 2] {
        self.bodies
    }

    /// What they do to each other.
    pub fn law(&self) -> ContactLaw {
        self.law
    }
}

impl<const D: usize> Scene<D> {
    /// Lets two bodies touch, slide and part instead of moving as one where they meet. Its force on
    /// the second body is [`contact_force`](Self::contact_force).
    ///
    /// # Errors
    /// An unknown body, a body with itself, a pair that has a contact, a name that is taken, a
    /// friction that is negative.
    pub fn contact(
        &mut self,
        name: &str,
        first: &str,
        second: &str,
        law: ContactLaw,
    ) -> Result<&mut Self, SceneError> {
        self.free_name(name)?;
        let bodies = [self.body_index(first)?, self.body_index(second)?];
        let [a, b] = bodies;
        if a == b || self.contact_between(a, b).is_some() {
            return Err(SceneError::ContactTaken {
                name: name.to_owned(),
                first: first.to_owned(),
                second: second.to_owned(),
            });
        }
        if let Some(value) = law.refused() {
            return Err(SceneError::Parameter {
                parameter: "friction",
                value,
                permitted: "finite and >= 0",
            });
        }
        self.contacts.push(Contact {
            name: name.to_owned(),
            bodies,
            law,
        });
        self.edits += 1;
        Ok(self)
    }

    /// Its contacts, in the order they were declared.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// The contact between two bodies, by index: its own index.
    pub fn contact_between(&self, a: usize, b: usize) -> Option<usize> {
        let pairs = [[a, b], [b, a]];
        self.contacts.iter().position(|c| pairs.contains(&c.bodies))
    }

    /// The velocity field of a body: 0, which bodies in no contact share, or one more than its index.
    pub fn velocity_field(&self, body: usize) -> usize {
        let named = |contact: &Contact| contact.bodies.contains(&body);
        if self.contacts.iter().any(named) {
            body + 1
        } else {
            0
        }
    }

    /// Force that the contact of this name exerted on its second body in the last step, N.
    pub fn contact_force(&self, name: &str) -> Option<SVector<f64, D>> {
        let index = self.contacts.iter().position(|c| c.name == name)?;
        let force = self.contact_forces.get(index).copied();
        Some(force.unwrap_or_else(SVector::zeros))
    }
}
