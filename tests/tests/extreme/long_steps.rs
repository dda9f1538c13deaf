//! X8: steps of 0.5, 0.9 and 1.0 of the time a wave needs across a cell, and longer ones.

use std::error::Error as _;

use fissure::diagnostics::EnergyGuard;
use fissure::prelude::*;

const H: f64 = 0.125;

/// A block that rings in all its waves, the shortest among them.
fn block() -> Scene<2> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let law = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: 0.0,
    };
    let block = Block::new([0.0; 2], [1.0, 0.25]);
    scene.fill("block", law, &block, &Spacing(H / 2.0)).unwrap();
    let noise = |x: &Vector2<f64>, a: f64, b: f64| ((a * x[0] + b * x[1]).sin() * 43758.5).fract();
    scene
        .set_velocity("block", |x| {
            Vector2::new(noise(x, 1234.5, 777.7), noise(x, 234.5, 1777.7)) * 1e-3
        })
        .unwrap();
    scene
}

/// Largest energy of motion and strain over that at the start, or what stopped the run.
fn shaken(update: StressUpdate, cfl: f64) -> Result<f64, Error> {
    let mut scene = block();
    let settings = ExplicitSettings {
        cfl,
        stress_update: update,
        ..ExplicitSettings::default()
    };
    let grid = Grid::over([-1.0; 2], [2.0, 1.25], H)?;
    let mut solver = Explicit::new(grid, shape::Linear, settings)?;
    let start = scene.bodies()[0].kinetic_energy();
    let mut guard = EnergyGuard::new(&scene);
    let mut most = 0.0_f64;
    for _ in 0..1000 {
        run(&mut scene, &mut solver, Until::Steps(1), &mut [&mut guard])?;
        most = most.max((scene.energy().kinetic + scene.energy().stored) / start);
    }
    Ok(most)
}

/// With the stress first and with MUSL every step up to the limit is stable. With the stress last the limit is 0.75: the
/// displacement has all of a change of velocity, of which the particles give a quarter back at the shortest waves.
#[test]
fn x8_steps_up_to_the_limit_are_stable() {
    let all = [0.5, 0.9, 0.99];
    for (update, shares) in [
        (StressUpdate::First, &all[..]),
        (StressUpdate::Musl, &all[..]),
        (StressUpdate::Last, &[0.5, 0.74]),
    ] {
        for &cfl in shares {
            let most = shaken(update, cfl).unwrap();
            println!("{update:?}, cfl {cfl}: energy at most {most:.3}");
            assert!(most <= 1.15, "{update:?} {cfl}: {most}");
        }
    }
}

/// What is too long is found by the energy it makes, or refused before anything moves.
#[test]
fn x8_steps_beyond_it_are_found() {
    for cfl in [0.78, 0.9, 1.0] {
        let stopped = shaken(StressUpdate::Last, cfl).unwrap_err();
        let cause = stopped
            .source()
            .map(ToString::to_string)
            .unwrap_or_default();
        println!("stress last, cfl {cfl}: {stopped}: {cause}");
        assert!(cause.contains("too long for their scheme"), "{stopped:?}");
    }
    for cfl in [1.01, 1.5, 10.0] {
        let refused = shaken(StressUpdate::Musl, cfl).unwrap_err().to_string();
        assert!(refused.contains("cfl"), "{refused}");
    }
}
