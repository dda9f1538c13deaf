//! Anisotropic damage passes the battery.

use fissure_materials::{
    AnisotropicDamage, Cracking, Isotropic, MixedMode, Mode, Onset, contract, softening::Linear,
};

fn law() -> AnisotropicDamage {
    let mode = |strength, toughness| Mode {
        strength,
        toughness,
        softening: Linear,
    };
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e9,
        poisson: 0.33,
    };
    AnisotropicDamage::new(elastic, mode(3e6, 1e3), mode(2e6, 1.5e3))
}

fn passes(law: &impl Cracking) {
    let message = match contract::check_cracking(law) {
        Ok(summary) => {
            println!("{summary:?}");
            String::new()
        }
        Err(violation) => violation.to_string(),
    };
    assert_eq!(message, "");
}

#[test]
fn uncoupled_modes_pass() {
    passes(&AnisotropicDamage {
        mixed: MixedMode::Uncoupled,
        ..law()
    });
}

#[test]
fn tension_alone_passes() {
    passes(&AnisotropicDamage {
        mixed: MixedMode::Uncoupled,
        onset: Onset::Tension,
        ..law()
    });
}

#[test]
fn mixed_mode_failure_passes() {
    passes(&law());
}
