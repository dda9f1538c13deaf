//! What a point with several failure planes remembers.

use std::fmt;

use fissure_tensor::{Sym, Vector3};
use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{Error, SeqAccess, Visitor},
    ser::SerializeSeq,
};

/// One failure plane of a material point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Plane {
    /// Unit normal in the reference configuration.
    pub normal: [f64; 3],
    /// Normal part of the displacement jump now, m; ≥ 0.
    pub opening: f64,
    /// Part of the jump along the plane, reference axes, m.
    pub slip: [f64; 3],
    /// Traction on it now, reference axes (stress conjugate to the Biot strain), Pa.
    pub traction: [f64; 3],
    /// Band over which the jump is smeared, m.
    pub width: f64,
    /// Dimensionless opening `u τ/G` up to which it has softened; never falls.
    pub softened: f64,
    /// Opening at which the faces of a failed plane touch, m: what dilation under pressure has
    /// left, zero after failure in tension.
    pub seat: f64,
    /// Whether it carries no more tension.
    pub failed: bool,
    /// Whether its jump changed when last its traction did.
    pub moving: bool,
}

impl Plane {
    /// A plane that has just started.
    pub(super) fn new(normal: &Vector3<f64>, width: f64, traction: Vector3<f64>) -> Self {
        Self {
            normal: (*normal).into(),
            traction: traction.into(),
            width,
            ..Self::default()
        }
    }

    /// Unit normal.
    pub fn normal(&self) -> Vector3<f64> {
        Vector3::from(self.normal)
    }

    /// The displacement jump, reference axes, m.
    pub fn jump(&self) -> Vector3<f64> {
        self.normal() * self.opening + self.slip()
    }

    /// Part of the jump along the plane, m.
    pub fn slip(&self) -> Vector3<f64> {
        Vector3::from(self.slip)
    }

    /// The strain that the jump stands for, `sym(u ⊗ n)/L` [Sanchez 2010, eq. 4.5.14].
    pub fn strain(&self) -> Sym {
        Sym::dyad_of(&self.jump(), &self.normal()) * (1.0 / self.width)
    }
}

/// Up to `N` failure planes, in the order in which they started.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MultiCrackState<const N: usize> {
    planes: [Plane; N],
    count: usize,
}

impl<const N: usize> MultiCrackState<N> {
    /// The planes, in storage order.
    pub fn planes(&self) -> &[Plane] {
        &self.planes[..self.count]
    }

    /// All that there is room for; those not in use are all zero.
    pub(super) fn slots(&self) -> &[Plane; N] {
        &self.planes
    }

    pub(super) fn planes_mut(&mut self) -> &mut [Plane] {
        &mut self.planes[..self.count]
    }

    /// Adds a plane; `false` if there is no room.
    pub(super) fn push(&mut self, plane: Plane) -> bool {
        let Some(slot) = self.planes.get_mut(self.count) else {
            return false;
        };
        *slot = plane;
        self.count += 1;
        true
    }

    /// From planes; those beyond `N` are left out.
    pub fn from_planes(planes: &[Plane]) -> Self {
        let mut state = Self::default();
        for plane in planes {
            state.push(*plane);
        }
        state
    }
}

impl<const N: usize> Default for MultiCrackState<N> {
    fn default() -> Self {
        Self {
            planes: [Plane::default(); N],
            count: 0,
        }
    }
}

impl<const N: usize> Serialize for MultiCrackState<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut sequence = serializer.serialize_seq(Some(self.count))?;
        for plane in self.planes() {
            sequence.serialize_element(plane)?;
        }
        sequence.end()
    }
}

struct Planes<const N: usize>;

impl<'de, const N: usize> Visitor<'de> for Planes<N> {
    type Value = MultiCrackState<N>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "at most {N} failure planes")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Self::Value, A::Error> {
        let mut state = MultiCrackState::default();
        while let Some(plane) = sequence.next_element()? {
            if !state.push(plane) {
                return Err(A::Error::invalid_length(N + 1, &self));
            }
        }
        Ok(state)
    }
}

impl<'de, const N: usize> Deserialize<'de> for MultiCrackState<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Planes::<N>)
    }
}
