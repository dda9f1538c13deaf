//! tmp
use crate::law::{SweepLaw, TypedLaw};
use fissure_materials::Material;
pub(crate) fn plane_stress<M: Material, const D: usize>(law: M) -> Box<dyn SweepLaw<D>> {
    Box::new(TypedLaw::new(law))
}
