//! P24 for our own laws: every parameter outside its range is refused by name.

use fissure_materials::{Decohesive, Isotropic, Material, MaterialError, Normal, Vector3};

const ELASTIC: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};

fn decohesive() -> Decohesive {
    Decohesive {
        elastic: ELASTIC,
        strength: 2.7e6,
        toughness: 61.35,
        softening: Default::default(),
        normal: Normal::Rankine,
    }
}

fn refuses(law: &impl Material, name: &str) {
    let refusal = law.check();
    assert!(
        matches!(refusal, Err(MaterialError::Parameter { parameter, .. }) if parameter == name),
        "{name}: {refusal:?}"
    );
}

const NOT_POSITIVE: [f64; 5] = [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

#[test]
fn isotropic_elasticity_refuses_each_parameter() {
    assert_eq!(ELASTIC.check(), Ok(()));
    for bad in NOT_POSITIVE {
        let density = bad;
        refuses(&Isotropic { density, ..ELASTIC }, "density");
        let young = bad;
        refuses(&Isotropic { young, ..ELASTIC }, "young");
    }
    for poisson in [-1.0, 0.5, 0.6, f64::NAN, f64::INFINITY] {
        refuses(&Isotropic { poisson, ..ELASTIC }, "poisson");
    }
}

#[test]
fn the_decohesive_law_refuses_each_parameter() {
    assert_eq!(decohesive().check(), Ok(()));
    for bad in NOT_POSITIVE {
        let strength = bad;
        refuses(
            &Decohesive {
                strength,
                ..decohesive()
            },
            "strength",
        );
        let toughness = bad;
        refuses(
            &Decohesive {
                toughness,
                ..decohesive()
            },
            "toughness",
        );
        let elastic = Isotropic {
            young: bad,
            ..ELASTIC
        };
        refuses(
            &Decohesive {
                elastic,
                ..decohesive()
            },
            "young",
        );
    }
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        let normal = Normal::Prescribed(Vector3::new(bad, 0.0, 0.0));
        refuses(
            &Decohesive {
                normal,
                ..decohesive()
            },
            "normal",
        );
    }
}
