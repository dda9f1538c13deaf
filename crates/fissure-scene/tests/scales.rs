//! Scales by id and place: the same for a particle wherever it is in the columns.

#![allow(clippy::unwrap_used)]

use fissure_materials::{Isotropic, Scale};
use fissure_particles::{
    Block, Correlation, FieldSampler, Marginal, ParticleId, Spacing, WhiteNoise,
};
use fissure_scene::{Plane, Scene, SceneError};
use nalgebra::Vector2;

fn scene() -> Scene<2> {
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: 0.25,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let block = Block::new([0.0, 0.0], [1.0, 0.4]);
    scene
        .fill("plate", elastic, &block, &Spacing(0.05))
        .unwrap();
    scene
}

/// Strength by place, toughness with it, stiffness by id.
fn random() -> impl Fn(ParticleId, &Vector2<f64>) -> Scale {
    let correlation = Correlation::Exponential { alpha: 10.0 };
    let sampler = FieldSampler::new([0.025; 2], [0.975, 0.375], 0.05, correlation).unwrap();
    let field = sampler.draw(5);
    let (weibull, normal) = (
        Marginal::Weibull { modulus: 8.0 },
        Marginal::Normal {
            deviation: 0.05,
            least: 0.5,
        },
    );
    move |id, x| {
        let z = field.at(x).unwrap_or(f64::NAN);
        Scale {
            strength: weibull.of(z),
            toughness: weibull.of(z).sqrt(),
            stiffness: normal.of(WhiteNoise { seed: 5 }.at(id)),
        }
    }
}

fn by_id(scene: &Scene<2>) -> Vec<(ParticleId, Scale)> {
    let body = &scene.bodies()[0];
    let pairs = body.particles().id.iter().zip(body.scales().unwrap());
    let mut pairs: Vec<_> = pairs.map(|(id, scale)| (*id, scale.0)).collect();
    pairs.sort_by_key(|(id, _)| *id);
    pairs
}

#[test]
fn scales_do_not_depend_on_the_order_of_the_particles() {
    let mut plain = scene();
    plain.set_scales("plate", random()).unwrap();
    let scales = by_id(&plain);
    assert_eq!(scales.len(), 160);
    let strengths: Vec<f64> = scales.iter().map(|(_, scale)| scale.strength).collect();
    let least = strengths.iter().copied().fold(f64::INFINITY, f64::min);
    let most = strengths.iter().copied().fold(0.0, f64::max);
    assert!(least < 0.95 && most > 1.05, "{least} to {most}");

    let order: Vec<u32> = (0..160).map(|i| i * 7 % 160).collect();
    let mut sorted = scene();
    sorted.bodies_mut()[0].reorder(&order).unwrap();
    sorted.set_scales("plate", random()).unwrap();
    assert_eq!(by_id(&sorted), scales);
    plain.bodies_mut()[0].reorder(&order).unwrap();
    assert_eq!(by_id(&plain), scales);
}

#[test]
fn a_refused_factor_changes_nothing() {
    let mut scene = scene();
    scene.set_scales("plate", random()).unwrap();
    let before = (by_id(&scene), scene.edits());
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = scene.set_scales("plate", |id, _| Scale {
            toughness: if id.0 == 100 { bad } else { 2.0 },
            ..Scale::default()
        });
        assert!(matches!(
            refused.err(),
            Some(SceneError::Parameter {
                parameter: "scale of toughness",
                ..
            })
        ));
    }
    let unknown = scene.set_scales("bar", random()).err();
    assert!(matches!(unknown, Some(SceneError::UnknownBody { .. })));
    assert_eq!((by_id(&scene), scene.edits()), before);
}
