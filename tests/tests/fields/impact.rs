//! Two equal bars meet head on: a wave runs through each and back, and they part with velocities
//! exchanged. Force `ρ c A v`, duration `2 L / c`, and no energy is lost.

use fissure::nalgebra::Vector2;
use fissure::prelude::*;

const LENGTH: f64 = 1.0;
const SPEED: f64 = 0.1;
/// Both bars move at this speed towards each other; waves run at 100 m/s.
const WAVE: f64 = 100.0;
const DENSITY: f64 = 1000.0;

/// Bars of one cell's height with the lateral strain held: c² = E/ρ for ν = 0.
fn bars(h: f64, gap: f64) -> Scene<2> {
    let law = Isotropic {
        density: DENSITY,
        young: DENSITY * WAVE * WAVE,
        poisson: 0.0,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let left = Block::new([-LENGTH - gap, 0.0], [-gap, 2.0 * h]);
    let right = Block::new([0.0, 0.0], [LENGTH, 2.0 * h]);
    scene
        .fill("left", law, &left, &Spacing(h / 2.0))
        .unwrap()
        .fill("right", law, &right, &Spacing(h / 2.0))
        .unwrap()
        .contact("touch", "left", "right", ContactLaw::Frictionless)
        .unwrap()
        .set_velocity("left", |_| Vector2::new(SPEED, 0.0))
        .unwrap()
        .set_velocity("right", |_| Vector2::new(-SPEED, 0.0))
        .unwrap();
    scene
}

struct Impact {
    /// Relative error of the impulse, of the force halfway and of the duration.
    impulse: f64,
    force: f64,
    duration: f64,
    /// Velocity of the right bar after, over the one it should have.
    rebound: f64,
    first_touch: f64,
    energy: EnergyTotals,
}

fn impact(h: f64, gap: f64, transfer: Transfer, update: StressUpdate) -> Impact {
    let mut scene = bars(h, gap);
    // Off the nodes, so that nothing is symmetric by chance.
    let grid = Grid::over([-1.6 - 0.3 * h, -4.0 * h], [1.6, 6.0 * h], h).unwrap();
    let settings = ExplicitSettings {
        cfl: 0.4,
        transfer,
        stress_update: update,
        ..ExplicitSettings::default()
    };
    let mut solver = Explicit::new(grid, shape::Gimp, settings).unwrap();
    let height = 2.0 * h;
    let exact = DENSITY * WAVE * SPEED * height;
    let duration = 2.0 * LENGTH / WAVE;
    let (mut impulse, mut touched, mut first, mut middle) = (0.0, 0.0, f64::NAN, Vec::new());
    while scene.time() < gap / (2.0 * SPEED) + 1.6 * duration {
        let report = solver.step(&mut scene, f64::INFINITY).unwrap();
        let force = scene.contact_force("touch").unwrap()[0];
        impulse += force * report.dt;
        if force > 0.3 * exact {
            touched += report.dt;
        }
        if force > 0.0 && first.is_nan() {
            first = report.time;
        }
        let since = report.time - gap / (2.0 * SPEED);
        if (0.2..0.8).contains(&(since / duration)) {
            middle.push(force);
        }
    }
    let right = scene.body("right").unwrap();
    let velocity = &right.particles().motion.velocity;
    let mean = velocity.iter().map(|v| v[0]).sum::<f64>() / velocity.len() as f64;
    Impact {
        impulse: (impulse / (exact * duration) - 1.0).abs(),
        force: (middle.iter().sum::<f64>() / middle.len() as f64 / exact - 1.0).abs(),
        duration: (touched / duration - 1.0).abs(),
        rebound: mean / SPEED,
        first_touch: first,
        energy: *scene.energy(),
    }
}

#[test]
fn bars_exchange_their_velocities() {
    let kinetic = DENSITY * LENGTH * SPEED * SPEED;
    for (update, transfer) in [
        (StressUpdate::Musl, Transfer::Flip { pic: 0.0 }),
        (StressUpdate::First, Transfer::Flip { pic: 0.0 }),
        (StressUpdate::Last, Transfer::Apic),
        (StressUpdate::Last, Transfer::Fmpm { order: 4 }),
        (StressUpdate::Musl, Transfer::Xpic { order: 2 }),
    ] {
        for h in [0.05, 0.025] {
            let result = impact(h, 0.0, transfer, update);
            let per_height = kinetic * 2.0 * h;
            let taken = result.energy.contact / per_height;
            println!(
                "{transfer:?} {update:?} h {h}: impulse {:.4} force {:.4} duration {:.4} rebound {:.4} contact took {taken:.4} balance {:.1e}",
                result.impulse,
                result.force,
                result.duration,
                result.rebound,
                result.energy.worst_balance
            );
            assert!(result.force <= 0.5 * h, "force off by {}", result.force);
            assert!(
                result.impulse <= 0.8 * h,
                "impulse off by {}",
                result.impulse
            );
            assert!(
                (result.rebound - 1.0).abs() <= 1.5 * h,
                "rebound {}",
                result.rebound
            );
            assert!(
                result.energy.worst_balance <= 1e-12,
                "{}",
                result.energy.worst_balance
            );
            assert!(
                taken >= -1e-12 && taken <= 2.0 * h,
                "contact took {taken} of the energy"
            );
        }
    }
}

#[test]
fn nothing_is_felt_across_a_gap() {
    let h = 0.05;
    for gap in [0.2 * h, 0.7 * h, 1.6 * h] {
        let result = impact(h, gap, Transfer::Flip { pic: 0.0 }, StressUpdate::Musl);
        let closed = gap / (2.0 * SPEED);
        let step = 0.4 * h / WAVE;
        println!(
            "gap {gap}: closed at {closed:.5}, felt at {:.5}, rebound {:.4}",
            result.first_touch, result.rebound
        );
        assert!((result.first_touch - closed).abs() <= 1.5 * step);
        assert!((result.rebound - 1.0).abs() <= 1.5 * h);
    }
}
