//! Section forces in bars stressed by hand and by a solver.
#![allow(clippy::unwrap_used, reason = "helpers of tests are tests")]

mod support;

use fissure_diagnostics::{MeasureError, section_force};
use fissure_materials::Isotropic;
use fissure_particles::{Block, Spacing, Turned};
use fissure_scene::{Plane, Scene, Until, run};
use fissure_tensor::{Matrix3, Sym, Vector3};
use nalgebra::{Rotation2, Vector2};

use support::Bar;

const STRESS: f64 = 3e6;
const LENGTH: f64 = 0.2;
const WIDTH: f64 = 0.06;
const THICKNESS: f64 = 0.04;

/// A bar turned by `angle` about the origin, stretched and under uniaxial stress along itself.
fn stressed_bar(angle: f64, stretch: f64) -> Scene<2> {
    let steel = Isotropic {
        density: 7800.0,
        young: 210e9,
        poisson: 0.3,
    };
    let seeding = Turned {
        inner: Spacing(5e-3),
        angle,
        centre: [0.0, 0.0],
    };
    let mut scene = Scene::plane(Plane::Strain {
        thickness: THICKNESS,
    });
    let block = Block::new([0.0, 0.0], [LENGTH, WIDTH]);
    scene.fill("bar", steel, &block, &seeding).unwrap();
    let axis = Vector3::new(angle.cos(), angle.sin(), 0.0);
    let f = Matrix3::identity() + axis * axis.transpose() * (stretch - 1.0);
    let motion = &mut scene.bodies_mut()[0].particles_mut().motion;
    motion.stress.fill(Sym::dyad(&axis) * STRESS);
    motion.deformation_gradient.fill(f);
    for x in &mut motion.position {
        *x = f.fixed_view::<2, 2>(0, 0) * *x;
    }
    scene
}

#[test]
fn the_force_is_stress_times_area_wherever_the_slab_is() {
    for angle in [0.0, 0.3, 1.1, 2.5] {
        let scene = stressed_bar(angle, 1.02);
        let turn = Rotation2::new(angle);
        let axis = turn * Vector2::x();
        for (at, slab) in [(0.1, 5e-3), (0.0812, 0.0213), (0.11, 1e-3), (0.097, 0.1)] {
            let point = turn * Vector2::new(at, 0.01);
            let section = section_force(&scene, "bar", point, axis * 7.0, slab).unwrap();
            let exact = STRESS * WIDTH * THICKNESS;
            assert!((section.normal / exact - 1.0).abs() < 1e-9, "{section:?}");
            assert!((section.force - axis * exact).norm() < 1e-9 * exact);
            assert!(section.particles >= 12);
        }
    }
}

#[test]
fn an_inclined_section_carries_the_same_force() {
    let scene = stressed_bar(0.0, 1.0);
    let normal = Vector2::new(0.8, 0.6);
    let section = section_force(&scene, "bar", Vector2::new(0.1, 0.03), normal, 0.03).unwrap();
    let exact = STRESS * WIDTH * THICKNESS;
    let along = Vector2::x() * exact;
    assert!((section.force - along).norm() < 2e-3 * exact, "{section:?}");
    assert!((section.normal - section.force.dot(&normal)).abs() < 1e-9 * exact);
}

#[test]
fn what_cannot_be_cut_is_said() {
    let scene = stressed_bar(0.0, 1.0);
    let cut = |body, x, n, slab| section_force(&scene, body, Vector2::new(x, 0.0), n, slab);
    assert!(matches!(
        cut("rod", 0.1, Vector2::x(), 0.01),
        Err(MeasureError::UnknownBody { .. })
    ));
    assert!(matches!(
        cut("bar", 0.5, Vector2::x(), 0.01),
        Err(MeasureError::EmptySection { .. })
    ));
    for (n, slab) in [
        (Vector2::x(), 0.0),
        (Vector2::x(), f64::NAN),
        (Vector2::zeros(), 0.01),
        (Vector2::new(f64::NAN, 0.0), 0.01),
    ] {
        let refused = cut("bar", 0.1, n, slab);
        assert!(matches!(refused, Err(MeasureError::Parameter { .. })));
    }
}

#[test]
fn sections_of_a_pulled_bar_carry_what_the_grips_do() {
    let bar = Bar {
        speed: 1e-3,
        ..Bar::default()
    };
    let (mut scene, mut solver) = bar.build();
    run(&mut scene, &mut solver, Until::Time(bar.ramp()), &mut []).unwrap();
    let grips = 0.5 * (scene.reaction("right").unwrap() - scene.reaction("left").unwrap())[0];
    let (middle, across) = (
        Vector2::new(0.5 * bar.length, 0.5 * bar.width),
        Vector2::x(),
    );
    let section = section_force(&scene, "bar", middle, across, 0.5 * bar.length).unwrap();
    assert!(grips > 0.0);
    assert!(
        (section.normal / grips - 1.0).abs() < 0.05,
        "{section:?} {grips}"
    );
}
