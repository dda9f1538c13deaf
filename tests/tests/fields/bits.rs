//! P22, and restart, of a scene with contact; what is refused.

use fissure::nalgebra::Vector2;
use fissure::prelude::*;
use fissure_tests::{bits, rubber};

const H: f64 = 0.125;

fn scene() -> Scene<2> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let ball = |x: f64, y: f64| Ball::new([x, y], 4.1 * H);
    scene
        .fill("one", rubber(), &ball(1.0, 1.0), &Spacing(H / 2.0))
        .unwrap()
        .fill("two", rubber(), &ball(2.1, 1.3), &Spacing(H / 2.0))
        .unwrap()
        .contact("touch", "one", "two", ContactLaw::Coulomb { friction: 0.4 })
        .unwrap()
        .set_velocity("one", |x| Vector2::new(20.0, 10.0 * x[0]))
        .unwrap();
    scene
}

fn solver() -> Explicit<shape::Gimp, 2> {
    let grid = Grid::over([-1.0, -1.0], [8.0, 8.0], H).unwrap();
    Explicit::new(grid, shape::Gimp, ExplicitSettings::default()).unwrap()
}

fn advance(scene: &mut Scene<2>, solver: &mut Explicit<shape::Gimp, 2>, steps: usize) -> f64 {
    let mut most = 0.0_f64;
    for _ in 0..steps {
        solver.step(scene, f64::INFINITY).unwrap();
        most = most.max(scene.contact_force("touch").unwrap().norm());
    }
    most
}

#[test]
fn threads_and_restarts_change_no_bit() {
    let on = |threads: usize, restart: bool| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let (mut scene, mut solver) = (scene(), solver());
            assert!(
                advance(&mut scene, &mut solver, 90) > 0.0,
                "they do not meet"
            );
            if restart {
                let (saved, memory) = (scene.save().unwrap(), solver.memory());
                (scene, solver) = (self::scene(), self::solver());
                scene.restore(&saved).unwrap();
                solver.recall(&memory);
            }
            advance(&mut scene, &mut solver, 60);
            bits(&scene).unwrap()
        })
    };
    let one = on(1, false);
    for (threads, restart) in [(2, false), (4, false), (8, false), (2, true)] {
        assert!(
            on(threads, restart) == one,
            "{threads} threads, restart {restart}"
        );
    }
}

#[test]
fn bad_contacts_are_refused() {
    let mut scene = scene();
    let mut refused = |name: &str, a: &str, b: &str, friction: f64| {
        let law = ContactLaw::Coulomb { friction };
        scene
            .contact(name, a, b, law)
            .err()
            .map(|error| error.to_string())
    };
    for (name, a, b, friction, says) in [
        ("touch", "one", "two", 0.1, "taken"),
        ("again", "two", "one", 0.1, "without a contact"),
        ("self", "two", "two", 0.1, "without a contact"),
        ("who", "one", "three", 0.1, "three"),
    ] {
        let error = refused(name, a, b, friction).unwrap();
        assert!(error.contains(says), "{error}");
    }
    let mut fresh = Scene::plane(Plane::Strain { thickness: 1.0 });
    fresh
        .fill(
            "one",
            rubber(),
            &Ball::new([0.0, 0.0], H),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .fill(
            "two",
            rubber(),
            &Ball::new([1.0, 0.0], H),
            &Spacing(H / 2.0),
        )
        .unwrap();
    for friction in [-0.1, f64::NAN, f64::INFINITY] {
        let law = ContactLaw::Coulomb { friction };
        let error = fresh.contact("c", "one", "two", law).err().unwrap();
        assert!(error.to_string().contains("friction"), "{error}");
    }
}
