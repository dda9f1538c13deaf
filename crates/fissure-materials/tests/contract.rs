//! Every law passes the battery; deliberately broken ones fail it by the right name.

use fissure_materials::{
    Cracking, Decohesive, Isotropic, Material, Normal, Vector3, contract, softening::Linear,
};

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
    let start = std::time::Instant::now();
    let outcome = contract::check_cracking(law).map(|s| println!("{s}\n{:?}", start.elapsed()));
    let message = outcome.err().map(|v| v.to_string());
    assert_eq!(message.unwrap_or_default(), "");
}

#[test]
fn isotropic_elasticity_passes() {
    passes(&CONCRETE);
}

#[test]
fn decohesive_rankine_passes() {
    passes_cracking(&decohesive(Normal::Rankine));
}

#[test]
fn decohesive_with_a_prescribed_normal_passes() {
    passes_cracking(&decohesive(Normal::Prescribed(Vector3::new(
        1.0, 2.0, -0.5,
    ))));
}
