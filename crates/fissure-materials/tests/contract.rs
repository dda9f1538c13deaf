//! Every law passes the battery; deliberately broken ones fail it by the right name.

mod broken;

use std::sync::atomic::AtomicU64;

use fissure_materials::{
    Band, Cracking, Decohesive, Hencky, Increment, Isotropic, Material, MaterialError, Matrix3,
    NeoHookean, Normal, PlaneStress, Vector3,
    contract::{self, Contract, Summary, Violation},
    softening::Linear,
};
use fissure_tensor::rotation;

const CONCRETE: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};

fn decohesive(normal: Normal) -> Decohesive {
    Decohesive {
        elastic: CONCRETE,
        strength: 2.7e6,
        toughness: 61.35,
        softening: Linear,
        normal,
    }
}

fn passes(law: &impl Material) {
    let message = contract::check(law).err().map(|v| v.to_string());
    assert_eq!(message.unwrap_or_default(), "");
}

fn passes_cracking(law: &impl Cracking) {
    let message = contract::check_cracking(law).err().map(|v| v.to_string());
    assert_eq!(message.unwrap_or_default(), "");
}

/// The law broke this property, and the message has what a user needs to act on it.
fn breaks(outcome: Result<Summary, Violation>, property: &str) {
    let violation = outcome.expect_err("a broken law passed");
    assert_eq!(violation.property, property, "{violation}");
    let message = violation.to_string();
    for part in [
        property,
        "measured",
        "bound",
        "smallest failing case",
        "seed",
        "step 1",
        ".replay",
    ] {
        assert!(message.contains(part), "'{part}' is missing in: {message}");
    }
    assert!(violation.case.steps.len() <= 3, "{violation}");
}

#[test]
fn isotropic_elasticity_passes() {
    passes(&CONCRETE);
}

#[test]
fn finite_elasticity_passes() {
    passes(&Hencky { elastic: CONCRETE });
    passes(&NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    });
}

#[test]
fn elasticity_in_plane_stress_passes() {
    passes(&PlaneStress(CONCRETE));
    passes(&PlaneStress(Hencky { elastic: CONCRETE }));
    passes(&PlaneStress(NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    }));
}

#[test]
fn decohesive_in_plane_stress_passes() {
    passes_cracking(&PlaneStress(decohesive(Normal::Rankine)));
    let normal = Vector3::new(1.0, 2.0, 0.0);
    passes_cracking(&PlaneStress(decohesive(Normal::Prescribed(normal))));
}

#[test]
fn decohesive_passes_as_any_law() {
    passes(&decohesive(Normal::Rankine));
}

#[test]
fn decohesive_with_rankine_passes() {
    passes_cracking(&decohesive(Normal::Rankine));
}

#[test]
fn decohesive_with_prescribed_normals_passes() {
    for normal in [Vector3::x(), Vector3::new(1.0, 2.0, -0.5)] {
        passes_cracking(&decohesive(Normal::Prescribed(normal)));
    }
}

#[test]
fn decohesive_passes_for_given_bands() {
    let law = decohesive(Normal::Rankine);
    let limit = law.band_limit(&Default::default());
    for band in [
        Band::Uniform(0.99 * limit),
        Band::Uniform(0.5 * limit),
        Band::Projected([0.01, 0.01, 0.0]),
        Band::Section([0.02, 0.01, 0.0]),
    ] {
        let contract = Contract {
            band: Some(band),
            samples: 64,
            ..Contract::default()
        };
        let message = contract.check_cracking(&law).err().map(|v| v.to_string());
        assert_eq!(message.unwrap_or_default(), "");
    }
}

#[test]
fn any_seed_passes() {
    for seed in 0..3 {
        let contract = Contract {
            seed,
            step_error_steps: 100,
            ..Contract::default()
        };
        let laws = [
            Normal::Rankine,
            Normal::Prescribed(Vector3::new(0.3, -1.0, 2.0)),
        ];
        for law in laws.map(decohesive) {
            let message = contract.check_cracking(&law).err().map(|v| v.to_string());
            assert_eq!(message.unwrap_or_default(), "");
        }
    }
}

#[test]
fn cracking_is_exercised() {
    exercised(&decohesive(Normal::Rankine));
    exercised(&PlaneStress(decohesive(Normal::Rankine)));
}

fn exercised(law: &impl Cracking) {
    let summary = contract::check_cracking(law).expect("the law passes");
    assert!(
        summary.softened > 50 && summary.failed > 20,
        "{} softened, {} failed",
        summary.softened,
        summary.failed
    );
    for tally in &summary.tallies {
        let enough = tally.exercised >= 20 || tally.note.is_some();
        assert!(enough, "{summary}");
    }
    assert!(summary.step_error < 1e-9, "{summary}");
}

#[test]
fn a_wrong_tangent_is_found() {
    let law = broken::WrongTangent(decohesive(Normal::Rankine));
    let outcome = contract::check(&law);
    // The message that docs/own-law.md shows.
    let message = outcome.as_ref().map_err(|v| v.to_string()).err();
    let call = ".replay(&law, \"P3 tangent\", 0)";
    assert!(message.is_some_and(|message| message.contains(call)));
    breaks(outcome, "P3 tangent");
}

#[test]
fn negative_dissipation_is_found() {
    let law = broken::NegativeDissipation(decohesive(Normal::Rankine));
    breaks(contract::check(&law), "P6 dissipation");
}

#[test]
fn a_law_that_is_not_objective_is_found() {
    let law = broken::NotObjective(decohesive(Normal::Rankine));
    breaks(contract::check(&law), "P9 objectivity");
}

#[test]
fn a_wrong_fracture_energy_is_found() {
    let law = broken::WrongFractureEnergy(decohesive(Normal::Rankine));
    breaks(contract::check_cracking(&law), "P8 fracture energy");
}

#[test]
fn hidden_state_is_found() {
    let law = broken::HiddenState(decohesive(Normal::Rankine), AtomicU64::new(0));
    breaks(contract::check(&law), "P22 determinism");
}

#[test]
fn a_violation_is_found_again_by_its_sample_and_by_its_case() {
    let law = broken::WrongFractureEnergy(decohesive(Normal::Rankine));
    let contract = Contract {
        seed: 3,
        ..Contract::default()
    };
    let found = contract
        .check_cracking(&law)
        .expect_err("a broken law passed");
    let sample = found.replay.sample.expect("one case failed");
    let again = found
        .replay
        .contract
        .replay_cracking(&law, found.property, sample);
    assert_eq!(again.as_ref(), Err(&found));
    let call = format!(
        "Contract {{ seed: 0x3, ..Contract::default() }}.replay_cracking(&law, \"P8 fracture energy\", {sample})"
    );
    assert!(found.to_string().contains(&call), "{found}");
    // The small case alone, by the number of the property.
    let alone = contract.judge_cracking(&law, "P8", &found.case);
    assert_eq!(alone.map_err(|v| v.case), Err(found.case.clone()));
    // A law that is right passes the same case, and it is one.
    let right = contract
        .judge_cracking(&law.0, "P8", &found.case)
        .expect("passes");
    assert_eq!((right.tallies.len(), right.tallies[0].exercised), (1, 1));
    let unknown = contract
        .replay(&law, "P99", 0)
        .expect_err("there is no P99");
    assert!(unknown.explanation.contains("P3 tangent"), "{unknown}");
}

#[test]
fn every_small_fault_is_found_by_its_property() {
    use broken::Fault;
    for (fault, normal, property) in [
        (Fault::CreepingState, Normal::Rankine, "P1 zero increment"),
        (
            Fault::ClaimsIsotropy,
            Normal::Prescribed(Vector3::x()),
            "P10 isotropy",
        ),
        (Fault::AbsolutePressure, Normal::Rankine, "P19 units"),
        (Fault::Time, Normal::Rankine, "P12 sub-step convergence"),
        (
            Fault::FallingIrreversible,
            Normal::Rankine,
            "P7 irreversibility",
        ),
        (Fault::UnderstatedRatio, Normal::Rankine, "P5 consistency"),
        (Fault::WrongOpening, Normal::Rankine, "P14 crack strain"),
        (Fault::TurnedNormal, Normal::Rankine, "P18 initiation"),
        (Fault::WideLimit, Normal::Rankine, "P24 band validation"),
        (Fault::SlowWave, Normal::Rankine, "P24 validation"),
        (Fault::LateOnset, Normal::Rankine, "P5 consistency"),
    ] {
        let law = broken::Faulty(decohesive(normal), fault);
        let contract = Contract {
            step_error_steps: 50,
            ..Contract::default()
        };
        let name = contract.check_cracking(&law).map_err(|v| v.property);
        assert_eq!(name.err(), Some(property), "{fault:?}");
    }
}

#[test]
fn a_crack_over_a_band_too_wide_for_plane_stress_is_refused() {
    // Between the limit of plane stress and that of the law inside, seen only when it starts.
    let law = PlaneStress(decohesive(Normal::Prescribed(Vector3::x())));
    let limit = law.band_limit(&Default::default());
    assert!(limit < 0.96 * law.0.band_limit(&Default::default()));
    let edge = 0.72 * limit;
    let band = Band::Projected([edge, edge, 0.0]);
    assert_eq!(law.check_band(&band, &Default::default()), Ok(()));
    let stretch = Matrix3::from_diagonal(&Vector3::new(1.001, 1.0, 1.0));
    let turn = rotation(&Vector3::z(), std::f64::consts::FRAC_PI_4);
    let along = Increment {
        band,
        ..Increment::to(stretch)
    };
    assert!(law.update(&along, &law.initial()).is_ok());
    let refused = law.update(&along.with_end(turn * stretch), &law.initial());
    let Err(MaterialError::Band {
        width, limit: told, ..
    }) = refused
    else {
        unreachable!("{refused:?}");
    };
    assert!((width / (edge * 2.0_f64.sqrt()) - 1.0).abs() < 1e-9);
    assert!(
        (told / limit - 1.0).abs() < 1e-9
            && width > told
            && width < law.0.band_limit(&Default::default())
    );
}

#[test]
fn a_rotated_crack_over_a_band_that_is_too_wide_is_refused() {
    // The door sees the width along the prescribed normal; turned by 45° the band is wider.
    let law = decohesive(Normal::Prescribed(Vector3::x()));
    let edge = 0.8 * law.band_limit(&Default::default());
    let band = Band::Projected([edge, edge, 0.0]);
    assert_eq!(law.check_band(&band, &Default::default()), Ok(()));
    let stretch = Matrix3::from_diagonal(&Vector3::new(1.001, 1.0, 1.0));
    let turn = rotation(&Vector3::z(), std::f64::consts::FRAC_PI_4);
    let along = Increment {
        band,
        ..Increment::to(stretch)
    };
    let turned = along.with_end(turn * stretch);
    let virgin = law.initial();
    assert!(law.update(&along, &virgin).is_ok());
    let refused = law.update(&turned, &virgin);
    assert!(matches!(refused, Err(MaterialError::Band { .. })));
    // So is a crack across a direction in which the band has no width at all.
    let rankine = decohesive(Normal::Rankine);
    let out_of_plane = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 1.001));
    let refused = rankine.update(&along.with_end(out_of_plane), &virgin);
    assert!(matches!(refused, Err(MaterialError::Band { .. })));
}

/// A law that breaks a property is put to all the others when that is said, and to none that does not exist.
#[test]
fn what_is_said_not_to_hold_does_not_hide_the_rest() {
    let law = broken::WrongFractureEnergy(decohesive(Normal::Rankine));
    let contract = Contract {
        samples: 40,
        step_error_steps: 20,
        not_held: &["P8", "P14"],
        ..Contract::default()
    };
    let summary = contract
        .check_cracking(&law)
        .unwrap_or_else(|v| panic!("{v}"));
    let broken: Vec<_> = summary.not_held.iter().map(|v| v.property).collect();
    assert_eq!(broken, ["P8 fracture energy", "P14 crack strain"]);
    assert!(
        summary
            .tally("P8")
            .is_some_and(|tally| tally.note.is_some() && tally.worst > 1.0)
    );
    assert!(
        summary
            .tally("P15")
            .is_some_and(|tally| tally.exercised > 0)
    );
    let unknown = Contract {
        not_held: &["P99"],
        ..contract
    };
    let violation = unknown.check_cracking(&law).expect_err("there is no P99");
    assert!(violation.explanation.contains("P99"), "{violation}");
}
