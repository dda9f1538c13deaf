//! Traction laws on the faces of cracks.
//!
//! A *bond* is a cohesive law that acts between the faces of a crack: all along it or where a function of the place
//! says so. Laws are code and are given anew when a scene is built; what they remember belongs to the crack, as
//! [`FacePoint`]s, and to checkpoints. Solvers choose the points: those at which they know a jump and an area. A law's
//! history is kept as the bytes of its own state, so that a crack need not know its law.

use std::sync::Arc;

use fissure_materials::{Cohesive, Jump, MaterialError};
use nalgebra::{Matrix2, Vector2, Vector3};
use serde::{Deserialize, Serialize};

use crate::Scene;
use crate::error::SceneError;

/// What a place of a bonded crack has been through.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FacePoint {
    /// Where its jump is taken, m: beside the crack, not on it.
    pub place: Vector2<f64>,
    /// Displacement of the plus face less that of the minus face, m.
    pub jump: Vector2<f64>,
    /// Area of the crack that it stands for, m².
    pub area: f64,
    /// Energy that its law has dissipated, J/m².
    pub dissipated: f64,
    /// The law's state; empty for one to which nothing has happened.
    pub state: Vec<u8>,
}

/// What a bond answers to a jump. Energies are per area.
#[derive(Clone, Debug, PartialEq)]
pub struct BondAnswer {
    /// Pa: the plus face is pulled by its negative, the minus face by itself.
    pub traction: Vector2<f64>,
    /// Its derivative with the jump, Pa/m.
    pub tangent: Matrix2<f64>,
    /// Stored, J/m².
    pub stored: f64,
    /// Dissipated on the way from the old state, J/m².
    pub dissipated: f64,
    /// The new state.
    pub state: Vec<u8>,
}

/// Says of a place whether it is one of some.
type Places = dyn Fn(&Vector2<f64>) -> bool + Send + Sync;

/// A cohesive law between the faces of a crack.
#[derive(Clone)]
pub struct Bond {
    law: Arc<dyn ErasedLaw>,
    acts: Arc<Places>,
}

impl Bond {
    /// Whether it acts at a place of the crack, by where that was put (m).
    pub fn acts_at(&self, placed: &Vector2<f64>) -> bool {
        (self.acts)(placed)
    }

    /// The law at a jump (m) across a normal, of either sign together, from a state.
    ///
    /// # Errors
    /// What the law refuses; a state that is not of this law.
    pub fn answer(
        &self,
        jump: &Vector2<f64>,
        normal: &Vector2<f64>,
        state: &[u8],
    ) -> Result<BondAnswer, MaterialError> {
        self.law.answer(jump, normal, state)
    }
}

impl std::fmt::Debug for Bond {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Bond").finish_non_exhaustive()
    }
}

/// A cohesive law whose type is not known.
trait ErasedLaw: Send + Sync {
    fn answer(
        &self,
        jump: &Vector2<f64>,
        normal: &Vector2<f64>,
        state: &[u8],
    ) -> Result<BondAnswer, MaterialError>;
}

impl<L: Cohesive> ErasedLaw for L {
    fn answer(
        &self,
        jump: &Vector2<f64>,
        normal: &Vector2<f64>,
        state: &[u8],
    ) -> Result<BondAnswer, MaterialError> {
        const LAW: &str = "law on the faces of a crack";
        let not_its_own = |_| MaterialError::NotFinite { law: LAW };
        let old = match state {
            [] => L::State::default(),
            bytes => postcard::from_bytes(bytes).map_err(not_its_own)?,
        };
        let space = |v: &Vector2<f64>| Vector3::new(v.x, v.y, 0.0);
        let found = self.update(&Jump::new(space(jump), space(normal)), &old)?;
        Ok(BondAnswer {
            traction: found.traction.xy(),
            tangent: found.tangent.fixed_view::<2, 2>(0, 0).into_owned(),
            stored: found.stored,
            dissipated: found.dissipated,
            state: if found.state == L::State::default() {
                Vec::new()
            } else {
                postcard::to_stdvec(&found.state).map_err(not_its_own)?
            },
        })
    }
}

impl Scene<2> {
    /// Lets a cohesive law act between the faces of a crack wherever `acts` holds of a place of the crack, as it was
    /// put (m): `scene.bond("interface", law, |x| x.x > 0.03)?`. Contact of the faces stays the crack's own.
    ///
    /// # Errors
    /// No crack of this name, parameters of the law outside their range.
    pub fn bond(
        &mut self,
        crack: &str,
        law: impl Cohesive,
        acts: impl Fn(&Vector2<f64>) -> bool + Send + Sync + 'static,
    ) -> Result<&mut Self, SceneError> {
        let index = self.cracks.iter().position(|line| line.name() == crack);
        let index = index.ok_or_else(|| SceneError::UnknownCrack {
            name: crack.to_owned(),
        })?;
        law.check().map_err(|source| SceneError::Bond {
            crack: crack.to_owned(),
            source,
        })?;
        self.bonds.retain(|(of, _)| *of != index);
        let bond = Bond {
            law: Arc::new(law),
            acts: Arc::new(acts),
        };
        self.bonds.push((index, bond));
        self.edits += 1;
        Ok(self)
    }
}

impl<const D: usize> Scene<D> {
    /// The law between the faces of the crack of this number.
    pub fn bond_of(&self, crack: usize) -> Option<&Bond> {
        let mut bonds = self.bonds.iter();
        bonds.find_map(|(of, bond)| (*of == crack).then_some(bond))
    }

    /// Whether any crack has a law between its faces.
    pub fn has_bonds(&self) -> bool {
        !self.bonds.is_empty()
    }
}
