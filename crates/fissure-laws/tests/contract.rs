//! Every law of the registry against the public contract.

use fissure_laws::{LAWS, Space, Values};
use fissure_materials::contract::Contract;

/// What laws do not hold, each for a reason.
///
/// Rotating: the band of a plane that turns is that of its first direction (P8), unloading turns it, the faster the nearer two
/// principal strains are (P13), and pressed shut it turns to where it can open, which relieves what it was shut against (P15).
///
/// Geological: in uniaxial strain the flow does not open purely, the stress along its plane lowers the tension it carries
/// (P8); along uniaxial stress it does (`energy_error_max` of the study `laws`).
fn not_held(law: &str) -> &'static [&'static str] {
    match law {
        "mode-one-rotating" => &[
            "P8 fracture energy",
            "P13 positive unloading stiffness",
            "P15 closure",
        ],
        "geological-flow" | "geological-multiple" => &["P8 fracture energy"],
        _ => &[],
    }
}

#[test]
fn every_law_passes_the_contract_where_it_is_offered() {
    let mut violations = Vec::new();
    for entry in LAWS {
        let mut broken = Vec::new();
        let contract = Contract {
            samples: 32,
            step_error_steps: 20,
            not_held: not_held(entry.name),
            ..Contract::default()
        };
        for space in [Space::Solid, Space::PlaneStress] {
            if !entry.is_for(space) {
                continue;
            }
            let law = (entry.build)(&Values::own(entry), space);
            match law.check_contract(&contract) {
                Ok(summary) => broken.extend(summary.not_held.iter().map(|v| v.property)),
                Err(violation) => {
                    violations.push(format!("{} in {space:?}: {violation}", entry.name));
                }
            }
        }
        for name in not_held(entry.name) {
            assert!(broken.contains(name), "{} holds {name}", entry.name);
        }
    }
    assert!(violations.is_empty(), "{}", violations.join("\n\n"));
}
