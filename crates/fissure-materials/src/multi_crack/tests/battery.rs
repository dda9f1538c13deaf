//! The public battery. Which property does not apply to which variant is said at the test.

use super::*;
use crate::PlaneStress;
use crate::contract::{Contract, Violation};

fn contract(samples: usize) -> Contract {
    Contract {
        samples,
        step_error_steps: 100,
        ..Contract::default()
    }
}

fn message(outcome: Result<crate::contract::Summary, Violation>) -> String {
    outcome.err().map(|v| v.to_string()).unwrap_or_default()
}

#[test]
fn one_fixed_plane_passes_for_every_unloading_and_shear() {
    for (unloading, shear) in CHOICES {
        let law = law::<1>(unloading, shear, Planes::Fixed);
        assert_eq!(message(contract(40).check_cracking(&law)), "", "{shear:?}");
    }
}

/// Without the cracking part: the tangent of sliding friction is not symmetric, and P13 asks its
/// symmetric part to be positive.
#[test]
fn friction_passes_as_any_law() {
    for (unloading, shear) in [
        (Unloading::Permanent, Shear::Coulomb(0.5)),
        (Unloading::Secant, Shear::Damaged(0.5)),
    ] {
        let law = law::<1>(unloading, shear, Planes::Fixed);
        assert_eq!(message(contract(40).check(&law)), "");
    }
}

#[test]
fn several_planes_without_shear_pass() {
    for unloading in [Unloading::Permanent, Unloading::Secant] {
        let law = law::<6>(unloading, Shear::Coulomb(0.0), Planes::Multiple(None));
        assert_eq!(message(contract(32).check_cracking(&law)), "");
    }
}

/// P9 and P10 of walks along which planes share a shear strain, or leap over a slack while they move one another: the
/// stress is the same in every frame.
#[test]
fn several_planes_without_shear_pass_whatever_the_walk() {
    for unloading in [Unloading::Permanent, Unloading::Secant] {
        let law = law::<6>(unloading, Shear::Coulomb(0.0), Planes::Multiple(None));
        for seed in 0..4 {
            let contract = Contract {
                seed,
                ..contract(40)
            };
            assert_eq!(message(contract.check(&law)), "", "{unloading:?}");
        }
        let replayed = Contract {
            seed: 8,
            ..contract(40)
        };
        assert_eq!(message(replayed.replay_cracking(&law, "P10", 9)), "");
    }
}

/// P1, P3, P6, P9, P10, P22 and P24 hold. P11 does not where, within one step, two directions ask
/// for the next plane equally: which one starts is a change of mode, and the stress jumps.
fn passes_up_to_continuity<M: Material>(law: &M) {
    if let Err(violation) = contract(40).check(law) {
        assert_eq!(violation.property, "P11 continuity", "{violation}");
    }
}

#[test]
fn several_planes_with_shear_pass_but_for_changes_of_mode() {
    for (unloading, shear) in CHOICES {
        if shear != Shear::Coulomb(0.0) {
            passes_up_to_continuity(&law::<6>(unloading, shear, Planes::Multiple(None)));
        }
    }
}

/// But for P11 where principal strains cross. In plane stress the plane follows the strains of the sheet.
#[test]
fn a_rotating_plane_passes() {
    for (unloading, shear) in CHOICES {
        let law = law::<1>(unloading, shear, Planes::Rotating);
        assert_eq!(message(contract(40).check(&law)), "");
        assert_eq!(message(contract(40).check(&PlaneStress(law))), "");
    }
}

/// In a search for the thickness it would turn into a sheet that widens when pulled; and what opens by shear, or by the stress
/// along it, has no energy as it turns.
#[test]
fn a_plane_that_cannot_rotate_is_refused() {
    let mut widening = law::<1>(Unloading::Secant, Shear::Elastic, Planes::Rotating);
    widening.elastic.poisson = -0.1;
    assert_eq!(widening.check(), Ok(()));
    let refused = |outcome| matches!(outcome, Err(MaterialError::Unsupported { .. }));
    assert!(refused(PlaneStress(widening).check()));
    assert!(refused(geological::<1>(None, Planes::Rotating).check()));
}

/// At the check and at every use; a single one, or one place for several, is welcome.
#[test]
fn several_geological_planes_are_refused_in_plane_stress() {
    let several = PlaneStress(geological::<6>(None, Planes::Multiple(None)));
    let refused = |error| matches!(error, MaterialError::Unsupported { .. });
    assert!(several.check().is_err_and(refused));
    let stretched = Increment::to(Matrix3::identity() * 1.00001);
    assert!(
        several
            .update(&stretched, &several.initial())
            .is_err_and(refused)
    );
    assert!(
        several
            .tangent(&stretched, &several.initial())
            .is_err_and(refused)
    );
    for single in [Planes::Fixed, Planes::Multiple(None)] {
        let single = PlaneStress(geological::<1>(None, single));
        assert_eq!(single.check(), Ok(()));
        assert!(single.update(&stretched, &single.initial()).is_ok());
    }
}

#[test]
fn geological_flow_passes() {
    for friction in [None, Some(0.6)] {
        for seed in 0..8 {
            let contract = Contract {
                seed,
                ..contract(40)
            };
            let law = geological::<1>(friction, Planes::Fixed);
            assert_eq!(message(contract.check(&law)), "", "{friction:?}");
        }
    }
}

/// In plane stress too, where the first step of a plane takes the differences of the whole.
#[test]
fn planes_pass_in_plane_stress() {
    for (unloading, shear) in CHOICES {
        let law = PlaneStress(law::<1>(unloading, shear, Planes::Fixed));
        assert_eq!(message(contract(40).check_cracking(&law)), "", "{shear:?}");
    }
    let free = Shear::Coulomb(0.0);
    let law = PlaneStress(law::<6>(Unloading::Secant, free, Planes::Multiple(None)));
    assert_eq!(message(contract(32).check_cracking(&law)), "");
}

/// Strong compression starts several in one step: at corners of two cones, and up to edges of the surface.
#[test]
fn several_geological_planes_pass() {
    for friction in [None, Some(0.6)] {
        let law = geological::<6>(friction, Planes::Multiple(None));
        for seed in 0..6 {
            let contract = Contract {
                seed,
                ..contract(40)
            };
            assert_eq!(message(contract.check(&law)), "", "{friction:?}");
        }
    }
}
