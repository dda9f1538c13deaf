//! The proptest strategies give what they promise.
#![cfg(feature = "proptest")]

use fissure_materials::{Increment, Material, contract::strategies};
use proptest::prelude::*;

proptest! {
    #[test]
    fn every_history_of_every_isotropic_material_is_accepted(
        law in strategies::isotropic(),
        case in strategies::history(),
    ) {
        prop_assert_eq!(law.check(), Ok(()));
        for f in case.gradients() {
            prop_assert!(f.determinant() > 0.0);
        }
        for (_, strain) in case.points() {
            // Without rotation: the law is for small strain.
            let end = fissure_materials::Matrix3::identity() + strain.to_matrix();
            let response = law.update(&Increment::to(end), &());
            prop_assert!(response.is_ok_and(|r| r.stored >= 0.0));
        }
    }

    #[test]
    fn every_increment_has_valid_ends(increment in strategies::increment()) {
        prop_assert!(increment.f_old.determinant() > 0.0 && increment.jacobian() > 0.0);
        prop_assert!(increment.band.max_width() > 0.0);
    }
}
