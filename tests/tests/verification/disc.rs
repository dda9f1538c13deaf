//! A spinning disc over ten turns, and the stress that holds it together (A12, plane strain).

use std::f64::consts::PI;

use fissure::materials::Hencky;
use fissure::nalgebra;
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, observed_orders, rubber};

const RADIUS: f64 = 0.5;
const CELLS: f64 = 5.0;
const H: f64 = RADIUS / CELLS;

fn law() -> Hencky {
    rubber()
}

/// Angular velocity, 1/s: the rim runs at a tenth of the wave speed.
fn spin() -> f64 {
    0.1 * law().elastic.p_wave_speed() / RADIUS
}

fn disc(omega: f64) -> Scene<2> {
    let mut scene = Table::scene(Space::Plane);
    scene
        .fill(
            "disc",
            law(),
            &Ball::new([0.0, 0.0], RADIUS),
            &Spacing(0.5 * H),
        )
        .unwrap();
    let elastic = law().elastic;
    let (e, nu) = (
        elastic.young / (1.0 - elastic.poisson.powi(2)),
        elastic.poisson / (1.0 - elastic.poisson),
    );
    // Start from the linear solution for a disc that already spins: u = A r − B r³.
    let load = elastic.density * omega * omega * (1.0 - nu * nu) / (8.0 * e);
    let a = load * (3.0 + nu) / (1.0 + nu) * RADIUS * RADIUS;
    let motion = &mut scene.bodies_mut()[0].particles_mut().motion;
    for row in 0..motion.len() {
        let x = motion.position[row];
        let r2 = x.norm_squared();
        let mut f = Matrix3::identity();
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            f[(i, j)] += if i == j { a - load * r2 } else { 0.0 } - 2.0 * load * x[i] * x[j];
        }
        motion.deformation_gradient[row] = f;
        motion.stress[row] = law().update(&Increment::to(f), &()).unwrap().stress;
        motion.position[row] = x * (1.0 + a - load * r2);
    }
    scene
        .set_velocity("disc", |x| vector![-omega * x[1], omega * x[0]])
        .unwrap();
    scene
}

/// Root mean square radius.
fn radius(scene: &Scene<2>) -> f64 {
    let body = &scene.bodies()[0];
    let masses = &body.particles().mass;
    let squares = masses
        .iter()
        .zip(body.motion().position)
        .map(|(m, x)| m * x.norm_squared());
    (squares.sum::<f64>() / masses.iter().sum::<f64>()).sqrt()
}

/// Angular momentum, with what the affine part of APIC on quadratic splines holds.
fn angular_momentum(scene: &Scene<2>) -> f64 {
    let body = &scene.bodies()[0];
    let motion = body.motion();
    let mut sum = 0.0;
    for (i, mass) in body.particles().mass.iter().enumerate() {
        let (x, v, c) = (motion.position[i], motion.velocity[i], motion.affine[i]);
        sum += mass * (x[0] * v[1] - x[1] * v[0] + 0.25 * H * H * (c.m21 - c.m12));
    }
    sum
}

struct Spun {
    /// Change of the radius over ten turns.
    radius: f64,
    /// Change of the angular momentum.
    momentum: f64,
    /// Means over the last turn: the trace of the stress over twice the kinetic energy, and the
    /// trace in the middle over the exact one.
    virial: f64,
    middle: f64,
}

fn spin_ten_turns(update: StressUpdate, cfl: f64) -> Spun {
    let omega = spin();
    let mut scene = disc(omega);
    let grid = Grid::over([-0.5 - 6.0 * H; 2], [0.5 + 6.0 * H; 2], H).unwrap();
    let settings = ExplicitSettings {
        cfl,
        transfer: Transfer::Apic,
        stress_update: update,
        ..Default::default()
    };
    let mut solver = Table::solver(ShapeKind::Bspline2, grid, settings).unwrap();
    let start = radius(&scene);
    // The first step fills the affine part.
    solver.step(&mut scene, f64::INFINITY).unwrap();
    let momentum = angular_momentum(&scene);
    let turn = 2.0 * PI / omega;
    run(&mut scene, &mut *solver, Until::Time(9.0 * turn), &mut []).unwrap();
    let (mut traces, mut kinetic, mut middle, mut count) = (0.0, 0.0, 0.0, 0.0);
    while scene.time() < 10.0 * turn {
        solver.step(&mut scene, 10.0 * turn).unwrap();
        let body = &scene.bodies()[0];
        let motion = body.motion();
        for (i, stress) in motion.stress.iter().enumerate() {
            let trace = stress.xx() + stress.yy();
            let volume = motion.deformation_gradient[i].determinant();
            traces += trace * volume * body.particles().volume[i];
            if motion.position[i].norm() < 1.2 * H {
                middle += trace;
                count += 1.0;
            }
        }
        kinetic += scene.energy().kinetic;
    }
    let nu = law().elastic.poisson / (1.0 - law().elastic.poisson);
    let exact = 0.25 * (3.0 + nu) * law().elastic.density * (omega * RADIUS).powi(2);
    Spun {
        radius: radius(&scene) / start - 1.0,
        momentum: angular_momentum(&scene) / momentum - 1.0,
        virial: 0.5 * traces / kinetic,
        middle: middle / count / exact,
    }
}

#[test]
fn a_spinning_disc_over_ten_turns_shows_its_order() {
    for update in [StressUpdate::First, StressUpdate::Last] {
        let spun = [0.4, 0.2, 0.1].map(|cfl| spin_ten_turns(update, cfl));
        for s in &spun {
            println!(
                "{update:?}: radius {:.2e} momentum {:.2e} virial {:.4} middle {:.4}",
                s.radius, s.momentum, s.virial, s.middle
            );
        }
        println!("{:?}", observed_orders(&spun.map(|s| s.radius)));
    }
}
