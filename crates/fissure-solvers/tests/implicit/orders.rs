//! Observed orders in the step, on the ringing bar: against the same grid and a much finer step, so that
//! only the error of the time integration is seen.
//!
//! Particles and nodes exchange velocities once a step, and what particles give back of a change is not what
//! the nodes gave (S⁺S is not the identity). So on fine steps every scheme is of first order, with a
//! small factor for a motion that is smooth on the grid; the scheme's own order is seen on coarse ones.
//! `implicit::scheme` tests the schemes without a grid.

use fissure_scene::Scene;
use fissure_solvers::{ImplicitSettings, Integration};

use crate::bar::{LENGTH, period, run, scene, solver};

/// Speed of the end, m/s: small, so that particles stay in their cells.
const SPEED: f64 = 1e-3;

/// Amplitudes of the first mode after 0.6 periods: displacement over the period, and velocity.
fn amplitudes(integration: Integration, steps: usize) -> (f64, f64) {
    let until = 0.6 * period();
    let mut scene = scene(SPEED);
    let start = scene.bodies()[0].motion().position.to_vec();
    let mut solver = solver(ImplicitSettings {
        step: until / steps as f64,
        integration,
        tolerance: 1e-10,
        ..ImplicitSettings::default()
    });
    let ids = |scene: &Scene<2>| scene.bodies()[0].particles().id.clone();
    let first = ids(&scene);
    run(&mut scene, &mut solver, until);
    let place = |id| first.iter().position(|known| *known == id).unwrap();
    let motion = scene.bodies()[0].motion();
    let (mut displaced, mut moving, mut whole) = (0.0, 0.0, 0.0);
    for (row, id) in ids(&scene).into_iter().enumerate() {
        let from = start[place(id)];
        let mode = (std::f64::consts::FRAC_PI_2 * from[0] / LENGTH).sin();
        displaced += mode * (motion.position[row] - from)[0];
        moving += mode * motion.velocity[row][0];
        whole += mode * mode * SPEED;
    }
    (displaced / (whole * period()), moving / whole)
}

fn observed(integration: Integration, steps: usize) -> f64 {
    let reference = amplitudes(
        Integration::Newmark {
            beta: 0.25,
            gamma: 0.5,
        },
        4096,
    );
    let error = |steps| {
        let (x, v) = amplitudes(integration, steps);
        (x - reference.0).hypot(v - reference.1)
    };
    let (coarse, fine) = (error(steps), error(2 * steps));
    (coarse / fine).log2()
}

#[test]
fn theta_is_of_first_order() {
    for weight in [0.5, 1.0] {
        let order = observed(Integration::Theta { weight }, 64);
        assert!((order - 1.0).abs() <= 0.15, "{weight}: {order}");
    }
}

#[test]
fn newmark_and_generalized_alpha_are_of_second_order() {
    let newmark = Integration::Newmark {
        beta: 0.25,
        gamma: 0.5,
    };
    let alpha = |spectral_radius| Integration::GeneralizedAlpha { spectral_radius };
    for integration in [newmark, alpha(1.0), alpha(0.8), alpha(0.0)] {
        let orders = [6, 12, 24].map(|steps| observed(integration, steps));
        assert!(
            (orders[0] - 2.0).abs() <= 0.3,
            "{integration:?}: {orders:?}"
        );
    }
}
