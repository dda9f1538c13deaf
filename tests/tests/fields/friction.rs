//! A block on a slope: it slides at `g (sin θ − μ cos θ)` or stays.

use fissure::nalgebra::Vector2;
use fissure::prelude::*;
use fissure_tests::rubber;

const H: f64 = 0.1;
const GRAVITY: f64 = 1.0;
/// Gravity is turned on over this time, so that the block does not hop.
const RAMP: f64 = 0.4;

/// The scene is turned so that the slope is level and gravity aslant.
fn slope(law: ContactLaw, angle: f64) -> Scene<2> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let (sine, cosine) = angle.sin_cos();
    scene
        .fill(
            "slope",
            rubber(),
            &Block::new([0.0, -0.4], [4.0, 0.0]),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .fill(
            "block",
            rubber(),
            &Block::new([0.5, 0.0], [1.1, 0.3]),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .contact("contact", "slope", "block", law)
        .unwrap()
        .hold(
            "floor",
            "slope",
            |x| x[1] < -0.3,
            Hold::All(Vector2::x()),
            Constant(0.0),
        )
        .unwrap()
        .body_force(move |_, t| Vector2::new(sine, -cosine) * (GRAVITY * (t / RAMP).min(1.0)));
    scene
}

/// Mean acceleration of the block along the slope over a second, in units of gravity, and the forces over its weight.
fn slide(law: ContactLaw, angle: f64) -> (f64, Vector2<f64>) {
    let mut scene = slope(law, angle);
    let grid = Grid::over([-0.4, -0.8], [4.4, 0.8], H).unwrap();
    let settings = ExplicitSettings {
        transfer: Transfer::Apic,
        stress_update: StressUpdate::Last,
        ..ExplicitSettings::default()
    };
    let mut solver = Explicit::new(grid, shape::Gimp, settings).unwrap();
    let (time, acting) = (1.0, 1.0 - 0.5 * RAMP);
    let mut impulse = Vector2::zeros();
    while scene.time() < time {
        let report = solver.step(&mut scene, time).unwrap();
        impulse += scene.contact_force("contact").unwrap() * report.dt;
    }
    let particles = scene.body("block").unwrap().particles();
    let mass: f64 = particles.mass.iter().sum();
    let velocity = particles.motion.velocity.iter().zip(&particles.mass);
    let momentum: f64 = velocity.map(|(v, m)| m * v[0]).sum();
    (
        momentum / (mass * GRAVITY * acting),
        impulse / (mass * GRAVITY * acting),
    )
}

#[test]
fn a_block_slides_by_coulombs_law() {
    let angle = 0.5_f64;
    let (sine, cosine) = angle.sin_cos();
    for (law, exact) in [
        (ContactLaw::Frictionless, sine),
        (ContactLaw::Coulomb { friction: 0.2 }, sine - 0.2 * cosine),
        (ContactLaw::Coulomb { friction: 0.5 }, sine - 0.5 * cosine),
        (ContactLaw::Coulomb { friction: 0.6 }, 0.0),
        (ContactLaw::Stick, 0.0),
    ] {
        let (acceleration, force) = slide(law, angle);
        println!(
            "{law:?}: {acceleration:.5} of g, exact {exact:.5}; force {:.4} {:.4}",
            force[0], force[1]
        );
        assert!(
            (acceleration - exact).abs() <= 0.01,
            "{law:?}: {acceleration} against {exact}"
        );
        assert!(
            (force[1] - cosine).abs() <= 0.01,
            "{law:?}: pressed by {}",
            force[1]
        );
    }
}

#[test]
fn what_parts_is_not_held_back() {
    let mut scene = slope(ContactLaw::Stick, 0.0);
    scene
        .body_force(|_, _| Vector2::zeros())
        .set_velocity("block", |_| Vector2::new(0.2, 0.4))
        .unwrap();
    let grid = Grid::over([-0.4, -0.8], [4.4, 0.8], H).unwrap();
    let mut solver = Explicit::new(grid, shape::Linear, ExplicitSettings::default()).unwrap();
    while scene.time() < 0.5 {
        solver.step(&mut scene, 0.5).unwrap();
        assert_eq!(scene.contact_force("contact").unwrap(), Vector2::zeros());
    }
    let motion = scene.body("block").unwrap().motion();
    for v in motion.velocity {
        assert!((v - Vector2::new(0.2, 0.4)).amax() <= 1e-12);
    }
}
