//! A law that refuses in the middle of a run: the error names the particle, the step and the time,
//! and what is left is the scene before that step, to be saved and started again.

use fissure::prelude::*;
use fissure_tests::{Build, Refusing, ShapeKind, Space, Table, rubber};

const H: f64 = 0.125;

fn scene(limit: f64) -> Scene<2> {
    let mut scene = Table::scene(Space::Plane);
    let law = Refusing {
        inner: rubber(),
        limit,
    };
    scene
        .fill(
            "bar",
            law,
            &Block::new([0.0, 0.0], [8.0 * H, 2.0 * H]),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .rigid(
            "grip",
            &Block::new([-H, 0.0], [0.0, 2.0 * H]),
            &Spacing(H / 2.0),
            Hold::Component(Vector2::x()),
            Velocity(|t: f64| 2.0 - 5.0 * (t / 0.02).min(1.0)),
        )
        .unwrap()
        .set_velocity("bar", |_| Vector2::new(2.0, 3.0))
        .unwrap();
    scene
}

fn solver(update: StressUpdate) -> Box<dyn Solver<2>> {
    let grid = Grid::over([-2.0; 2], [3.0; 2], H).unwrap();
    let settings = ExplicitSettings {
        stress_update: update,
        ..Default::default()
    };
    Table::solver(ShapeKind::Bspline2, grid, settings).unwrap()
}

#[test]
fn a_failing_particle_is_reported_and_the_last_good_state_goes_on() {
    for update in [StressUpdate::First, StressUpdate::Last, StressUpdate::Musl] {
        let mut moving = scene(0.03);
        let mut running = solver(update);
        let (before, error) = loop {
            let before = (moving.save().unwrap(), running.memory());
            match running.step(&mut moving, f64::INFINITY) {
                Ok(_) => assert!(moving.step() < 1000, "{update:?}: nothing fails"),
                Err(error) => break (before, error),
            }
        };
        let text = error.to_string();
        let SolveError::Particle {
            body,
            id,
            step,
            time,
            deformation_gradient,
            state,
            source,
        } = error
        else {
            panic!("{update:?}: {text}");
        };
        assert!(
            moving.step() > 10 && step == moving.step() + 1,
            "{update:?}: step {step}"
        );
        assert_eq!((body.as_str(), time), ("bar", moving.time()));
        assert!(deformation_gradient.m11 > 1.03 && state.parse::<f64>().unwrap() <= 0.03);
        assert!(matches!(
            source,
            MaterialError::NoConvergence { iterations: 7, .. }
        ));
        for part in [
            &format!("step {step}"),
            &format!("particle {}", id.0),
            "'bar'",
        ] {
            assert!(text.contains(part), "{text}");
        }
        let known = moving.bodies()[0].particles().id.contains(&id);
        assert!(
            known && moving.save().unwrap() == before.0,
            "{update:?}: the scene has changed"
        );

        // The same step fails the same way, here and in a scene restored from what was saved.
        let again = running
            .step(&mut moving, f64::INFINITY)
            .unwrap_err()
            .to_string();
        assert_eq!(again, text);
        let mut restored = scene(0.03);
        restored.restore(&before.0).unwrap();
        let mut fresh = solver(update);
        fresh.recall(&before.1);
        assert_eq!(
            fresh
                .step(&mut restored, f64::INFINITY)
                .unwrap_err()
                .to_string(),
            text
        );

        // With a law that permits more it goes on.
        let mut stronger = scene(1.0);
        stronger.restore(&before.0).unwrap();
        let mut fresh = solver(update);
        fresh.recall(&before.1);
        run(&mut stronger, &mut *fresh, Until::Steps(10), &mut []).unwrap();
        assert_eq!(stronger.step(), step + 9);
    }
}
