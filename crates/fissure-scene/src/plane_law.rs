//! Plane stress: every law of the scene in its wrapper.

use fissure_materials::{Material, PlaneStress};

use crate::law::{SweepLaw, TypedLaw};

/// The law in its plane-stress wrapper, erased.
pub(crate) fn plane_stress<M: Material, const D: usize>(law: M) -> Box<dyn SweepLaw<D>> {
    Box::new(TypedLaw::new(PlaneStress::new(law)))
}
