//! Errors name the parameter, its value and the rule.

use std::error::Error;

use fissure::materials::{Hencky, NeoHookean};
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

const H: f64 = 0.125;

fn block() -> Block<2> {
    Block::new([0.0, 0.0], [0.5, 0.5])
}

fn scene() -> Scene<2> {
    let mut scene = Table::scene(Space::Plane);
    scene
        .fill("block", rubber(), &block(), &Spacing(H / 2.0))
        .unwrap();
    scene
}

fn first_step(scene: &mut Scene<2>, high: f64) -> Result<Report<2>, SolveError> {
    let grid = Grid::over([-0.5; 2], [high; 2], H).unwrap();
    let settings = ExplicitSettings::default();
    Table::solver(ShapeKind::Linear, grid, settings)?.step(scene, f64::INFINITY)
}

/// The messages of an error and its sources.
fn chain(error: &dyn Error) -> String {
    let mut text = error.to_string();
    let mut source = error.source();
    while let Some(error) = source {
        text += &format!(": {error}");
        source = error.source();
    }
    text
}

#[test]
fn p24_elastic_constants_outside_their_range_are_refused() {
    let good = rubber().elastic;
    let bad = [
        (
            "young",
            Isotropic {
                young: -1.0,
                ..good
            },
            -1.0,
        ),
        ("young", Isotropic { young: 0.0, ..good }, 0.0),
        (
            "young",
            Isotropic {
                young: f64::NAN,
                ..good
            },
            f64::NAN,
        ),
        (
            "young",
            Isotropic {
                young: f64::INFINITY,
                ..good
            },
            f64::INFINITY,
        ),
        (
            "poisson",
            Isotropic {
                poisson: 0.5,
                ..good
            },
            0.5,
        ),
        (
            "poisson",
            Isotropic {
                poisson: 0.7,
                ..good
            },
            0.7,
        ),
        (
            "poisson",
            Isotropic {
                poisson: -1.0,
                ..good
            },
            -1.0,
        ),
        (
            "poisson",
            Isotropic {
                poisson: f64::NAN,
                ..good
            },
            f64::NAN,
        ),
        (
            "density",
            Isotropic {
                density: 0.0,
                ..good
            },
            0.0,
        ),
        (
            "density",
            Isotropic {
                density: -3.0,
                ..good
            },
            -3.0,
        ),
    ];
    for (field, elastic, wrong) in bad {
        let spacing = Spacing(H / 2.0);
        let Isotropic {
            density,
            young,
            poisson,
        } = elastic;
        let neo_hookean = NeoHookean {
            density,
            young,
            poisson,
        };
        let decohesive = Decohesive {
            elastic,
            strength: 1e4,
            toughness: 10.0,
            softening: softening::Linear,
            normal: Normal::Rankine,
        };
        for filled in [
            Scene::plane(Plane::Strain { thickness: 1.0 })
                .fill("b", elastic, &block(), &spacing)
                .err(),
            Scene::plane(Plane::Stress { thickness: 1.0 })
                .fill("b", elastic, &block(), &spacing)
                .err(),
            Scene::axisymmetric()
                .fill("b", Hencky { elastic }, &block(), &spacing)
                .err(),
            Scene::axisymmetric()
                .fill("b", neo_hookean, &block(), &spacing)
                .err(),
            Scene::plane(Plane::Strain { thickness: 1.0 })
                .fill("b", decohesive, &block(), &spacing)
                .err(),
        ] {
            let Some(SceneError::Law { body, source }) = filled else {
                panic!("{field} {wrong}: {filled:?}");
            };
            let MaterialError::Parameter {
                parameter,
                value,
                permitted,
                ..
            } = source
            else {
                panic!("{field} {wrong}: {source:?}");
            };
            assert_eq!((body.as_str(), parameter), ("b", field));
            assert!(value.to_bits() == wrong.to_bits() && !permitted.is_empty());
        }
    }
}

#[test]
fn band_over_the_limit_of_eq_4_5_17_is_refused_before_the_first_step() {
    let elastic = rubber().elastic;
    let (strength, toughness) = (1e5, 10.0);
    // L < C G/(τ² steepest), steepest = ½ for linear softening.
    let limit = 2.0 * elastic.p_wave_modulus() * toughness / (strength * strength);
    assert!(limit < H);
    let law = Decohesive {
        elastic,
        strength,
        toughness,
        softening: softening::Linear,
        normal: Normal::Prescribed(Vector3::x()),
    };
    let mut scene: Scene<2> = Table::scene(Space::Plane);
    scene
        .fill("block", law, &block(), &Spacing(H / 2.0))
        .unwrap();
    let error = first_step(&mut scene, 1.0).unwrap_err();
    let text = chain(&error);
    let SolveError::Band {
        body,
        source:
            MaterialError::Band {
                width,
                limit: found,
                ..
            },
    } = error
    else {
        panic!("{error:?}");
    };
    assert_eq!((body.as_str(), scene.step()), ("block", 0));
    assert!(
        width >= H && (found / limit - 1.0).abs() <= 1e-12,
        "{width} {found} {limit}"
    );
    assert!(text.contains("block") && text.contains("refine"), "{text}");
}

#[test]
fn x7_a_point_outside_the_grid_is_named() {
    let mut scene = scene();
    let error = first_step(&mut scene, 0.35).unwrap_err();
    let SolveError::Outside {
        body,
        position,
        step,
        ..
    } = &error
    else {
        panic!("{error:?}");
    };
    assert_eq!((body.as_str(), *step, scene.step()), ("block", 1, 0));
    assert!(position.iter().any(|x| *x > 0.35), "{position:?}");
}

#[test]
fn x12_numbers_that_are_not_finite_are_refused_with_their_particle() {
    type Spoil = fn(&mut Particles<2>);
    let spoilers: [(&str, Spoil); 6] = [
        ("position", |p| p.motion.position[7][1] = f64::NAN),
        ("velocity", |p| p.motion.velocity[7][0] = f64::INFINITY),
        ("deformation_gradient", |p| {
            p.motion.deformation_gradient[7].m23 = f64::NAN
        }),
        ("stress", |p| p.motion.stress[7] = Sym::IDENTITY * f64::NAN),
        ("mass", |p| p.mass[7] = f64::NAN),
        ("volume", |p| p.volume[7] = f64::INFINITY),
    ];
    for (column, spoil) in spoilers {
        let mut scene = scene();
        spoil(scene.bodies_mut()[0].particles_mut());
        let error = first_step(&mut scene, 1.0).unwrap_err();
        let SolveError::NotFinite { body, id, field } = &error else {
            panic!("{column}: {error:?}");
        };
        assert_eq!(
            (body.as_str(), *id, *field),
            ("block", ParticleId(7), column)
        );
        assert_eq!(scene.step(), 0);
    }
}

#[test]
fn numbers_in_scene_grid_and_settings_are_refused_by_name() {
    let mut scene = scene();
    scene
        .set_velocity("block", |_| Vector2::new(1.0, 2.0))
        .unwrap();
    let before = scene.save().unwrap();
    // Most velocities are good; that of one corner is not.
    let velocity = scene
        .set_velocity("block", |x| {
            Vector2::new(3.0, if x.min() > 0.45 { f64::NAN } else { 4.0 })
        })
        .err();
    assert!(scene.save().unwrap() == before, "half of a change was made");
    assert!(matches!(
        velocity,
        Some(SceneError::Parameter {
            parameter: "velocity",
            ..
        })
    ));
    let scale = Scale {
        strength: 0.0,
        ..Default::default()
    };
    let scale = scene.set_scale("block", |_| true, scale).err();
    assert!(matches!(scale, Some(SceneError::Parameter { value, .. }) if value == 0.0));
    let nobody = scene.set_velocity("bar", |_| Vector2::zeros()).err();
    assert!(matches!(nobody, Some(SceneError::UnknownBody { name }) if name == "bar"));
    let nothing = scene.hold(
        "h",
        "block",
        |_| false,
        Hold::Component(Vector2::x()),
        Constant(0.0),
    );
    assert!(matches!(nothing.err(), Some(SceneError::EmptySelection { name }) if name == "h"));
    let taken = scene.fill("block", rubber(), &block(), &Spacing(H)).err();
    assert!(matches!(taken, Some(SceneError::NameTaken { name }) if name == "block"));
    let thin = Scene::plane(Plane::Strain { thickness: 0.0 })
        .fill("b", rubber(), &block(), &Spacing(H))
        .err();
    assert!(matches!(
        thin,
        Some(SceneError::Parameter {
            parameter: "thickness",
            ..
        })
    ));
    let over_axis = Scene::axisymmetric()
        .fill(
            "b",
            rubber(),
            &Block::new([-1.0, 0.0], [1.0, 1.0]),
            &Spacing(H),
        )
        .err();
    assert!(matches!(over_axis, Some(SceneError::NegativeRadius { radius, .. }) if radius < 0.0));
    for (setting, settings) in [
        (
            "cfl",
            ExplicitSettings {
                cfl: 0.0,
                ..Default::default()
            },
        ),
        (
            "cfl",
            ExplicitSettings {
                cfl: f64::NAN,
                ..Default::default()
            },
        ),
        (
            "mass_cutoff",
            ExplicitSettings {
                mass_cutoff: -1.0,
                ..Default::default()
            },
        ),
        (
            "pic",
            ExplicitSettings {
                transfer: Transfer::Flip { pic: 1.5 },
                ..Default::default()
            },
        ),
        (
            "order",
            ExplicitSettings {
                transfer: Transfer::Xpic { order: 0 },
                ..Default::default()
            },
        ),
        (
            "linear viscosity",
            ExplicitSettings {
                viscosity: Some((-1.0, 0.0)),
                ..Default::default()
            },
        ),
    ] {
        let grid = Grid::over([0.0; 2], [1.0; 2], H).unwrap();
        let refused = Table::solver(ShapeKind::Linear, grid, settings).err();
        assert!(
            matches!(&refused, Some(SolveError::Setting { setting: name, permitted, .. })
                if *name == setting && !permitted.is_empty()),
            "{setting}: {refused:?}"
        );
    }
}

#[test]
fn moving_least_squares_are_refused_where_there_is_no_constant_moment() {
    for shape in ShapeKind::ALL {
        let grid = Grid::over([0.0; 2], [1.0; 2], H).unwrap();
        let settings = ExplicitSettings {
            transfer: Transfer::Mls,
            ..Default::default()
        };
        let splines = matches!(shape, ShapeKind::Bspline2 | ShapeKind::Bspline3);
        match Table::solver(shape, grid, settings) {
            Ok(_) => assert!(splines, "{shape:?}"),
            Err(SolveError::Unsupported { what }) => {
                assert!(!splines && what.contains("least squares"), "{shape:?}");
            }
            Err(other) => panic!("{other}"),
        }
    }
}

#[test]
fn a_time_in_the_past_is_refused() {
    let mut scene = scene();
    let grid = Grid::over([-0.5; 2], [1.0; 2], H).unwrap();
    let settings = ExplicitSettings::default();
    let mut solver = Table::solver(ShapeKind::Linear, grid, settings).unwrap();
    for until in [f64::NAN, -1.0, 0.0] {
        assert!(solver.step(&mut scene, until).is_err(), "until {until}");
        assert_eq!((scene.step(), scene.time()), (0, 0.0));
    }
}
