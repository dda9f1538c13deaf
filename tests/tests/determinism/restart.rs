//! P22, X18: a run that is saved in the middle of softening and restored into a new scene with a
//! new solver ends with the bits of one that was not interrupted.

use fissure_tests::bits;

use crate::fragments::{SETTINGS, advance, scene, softening, solver, sorted_anew};

#[test]
fn x18_restart_in_mid_softening_gives_the_same_bits() {
    for setting in &SETTINGS {
        let mut whole = scene(0.0);
        let mut first = solver(setting, 0.0);
        advance(&mut whole, &mut *first, 130);
        assert!(
            softening(&whole) > 0 && sorted_anew(&whole),
            "{setting:?} {}",
            softening(&whole)
        );
        let (saved, memory) = (whole.save().unwrap(), first.memory());
        advance(&mut whole, &mut *first, 60);

        let mut restored = scene(0.0);
        restored.restore(&saved).unwrap();
        assert!(
            restored.save().unwrap() == saved,
            "{setting:?}: restoring changes bits"
        );
        let mut second = solver(setting, 0.0);
        second.recall(&memory);
        advance(&mut restored, &mut *second, 60);
        assert!(
            bits(&restored).unwrap() == bits(&whole).unwrap(),
            "{setting:?}"
        );
    }
}
