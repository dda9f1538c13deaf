//! A8 and A9: waves and vibrations of a bar in one dimension (ν = 0, one cell high).

use std::f64::consts::PI;

use fissure::materials::Hencky;
use fissure::nalgebra;
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

fn law() -> Hencky {
    let mut law = rubber();
    law.elastic.poisson = 0.0;
    law
}

fn speed() -> f64 {
    law().elastic.p_wave_speed()
}

/// A bar of 1 m in cells of `h`, free on the right and moved on the left by a rigid body.
fn bar(h: f64, grip: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Scene<2> {
    let mut scene = Table::scene(Space::Plane);
    scene
        .fill(
            "bar",
            law(),
            &Block::new([0.0, 0.0], [1.0, h]),
            &Spacing(h / 2.0),
        )
        .unwrap()
        .rigid(
            "grip",
            &Block::new([-h, 0.0], [0.0, h]),
            &Spacing(h / 2.0),
            Hold::Component(Vector2::x()),
            Velocity(grip),
        )
        .unwrap();
    scene
}

fn solver(h: f64, transfer: Transfer, update: StressUpdate) -> Box<dyn Solver<2>> {
    let grid = Grid::over([-4.0 * h, -4.0 * h], [1.0 + 4.0 * h, 5.0 * h], h).unwrap();
    let settings = ExplicitSettings {
        transfer,
        stress_update: update,
        ..Default::default()
    };
    Table::solver(ShapeKind::Linear, grid, settings).unwrap()
}

/// A9: frequency of the first mode, fixed-free, and the energy it keeps over ten periods.
fn vibrate(transfer: Transfer, update: StressUpdate) -> (f64, f64) {
    let h = 1.0 / 32.0;
    let mut scene = bar(h, |_| 0.0);
    let amplitude = 1e-4 * speed();
    let mode = |x: f64| (0.5 * PI * x).sin();
    scene
        .set_velocity("bar", |x| vector![amplitude * mode(x[0]), 0.0])
        .unwrap();
    let mut solver = solver(h, transfer, update);
    let period = 4.0 / speed();
    let start = scene.energy().kinetic;
    let modal = |scene: &Scene<2>| {
        let motion = scene.bodies()[0].motion();
        let pairs = motion.position.iter().zip(motion.velocity);
        pairs.map(|(x, v)| mode(x[0]) * v[0]).sum::<f64>()
    };
    let (mut crossings, mut before) = (Vec::new(), modal(&scene));
    let (mut tail, mut count) = (0.0, 0.0);
    while scene.time() < 10.0 * period {
        let report = solver.step(&mut scene, 10.0 * period).unwrap();
        let now = modal(&scene);
        if before * now < 0.0 {
            crossings.push(scene.time() - report.dt * now / (now - before));
        }
        before = now;
        // The mean over a period: single values waver with the staggering of the step.
        if scene.time() > 9.0 * period {
            tail += scene.energy().kinetic + scene.energy().stored;
            count += 1.0;
        }
    }
    assert!(
        (19..=21).contains(&crossings.len()),
        "{} crossings",
        crossings.len()
    );
    let last = crossings[crossings.len() - 1];
    let found = 0.5 * (crossings.len() - 1) as f64 / (last - crossings[0]);
    (found * period, tail / count / start)
}

#[test]
fn a9_first_mode_has_its_frequency_and_keeps_its_energy() {
    let flip = Transfer::Flip { pic: 0.0 };
    for (transfer, update) in [
        (flip, StressUpdate::First),
        (flip, StressUpdate::Musl),
        (flip, StressUpdate::Last),
        (Transfer::Fmpm { order: 3 }, StressUpdate::Last),
        (Transfer::Fmpm { order: 3 }, StressUpdate::Musl),
    ] {
        let (frequency, kept) = vibrate(transfer, update);
        println!("{transfer:?} {update:?}: frequency {frequency:.5}, energy {kept:.5}");
        assert!(
            (frequency - 1.0).abs() <= 0.01,
            "{transfer:?} {update:?}: {frequency}"
        );
        assert!(
            (kept - 1.0).abs() <= 0.01,
            "{transfer:?} {update:?}: {kept}"
        );
    }
}

/// A8: a step of velocity at the grip passes two stations at the speed of sound, and behind it the
/// stress is `ρ c v`.
#[test]
fn a8_step_wave_has_the_speed_of_sound_and_its_stress() {
    let strain = 1e-3;
    let pull = -strain * speed();
    // The front spreads as the cube root of the cells it passed.
    let h = 1.0 / 128.0;
    let mut scene = bar(h, move |_| pull);
    let mut solver = solver(h, Transfer::Flip { pic: 0.0 }, StressUpdate::Musl);
    let stress = |scene: &Scene<2>, low: f64, high: f64| {
        let motion = scene.bodies()[0].motion();
        let pairs = motion.position.iter().zip(motion.stress);
        let inside = pairs.filter(|(x, _)| x[0] > low && x[0] < high);
        let stresses: Vec<f64> = inside.map(|(_, stress)| stress.xx()).collect();
        stresses.iter().sum::<f64>() / stresses.len() as f64
    };
    let plateau = law().density() * speed() * speed() * strain;
    let stations = [0.25, 0.75];
    let mut arrivals = [None; 2];
    let mut before = [0.0; 2];
    while scene.time() < 0.95 / speed() {
        let report = solver.step(&mut scene, 0.95 / speed()).unwrap();
        for (k, x) in stations.iter().enumerate() {
            let now = stress(&scene, x - h, x + h);
            if arrivals[k].is_none() && now >= 0.5 * plateau {
                let part = (now - 0.5 * plateau) / (now - before[k]);
                arrivals[k] = Some(scene.time() - report.dt * part);
            }
            before[k] = now;
        }
    }
    let found = (stations[1] - stations[0]) / (arrivals[1].unwrap() - arrivals[0].unwrap());
    let behind = stress(&scene, 0.1, 0.6);
    println!(
        "speed {:.4}, stress {:.4}",
        found / speed(),
        behind / plateau
    );
    assert!(
        (found / speed() - 1.0).abs() <= 0.01,
        "speed {}",
        found / speed()
    );
    assert!(
        (behind / plateau - 1.0).abs() <= 0.01,
        "stress {}",
        behind / plateau
    );
}
