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
    /// Change of the radius.
    radius: f64,
    /// Change of the angular momentum.
    momentum: f64,
    /// Means over the last half turn: the trace of the stress over twice the kinetic energy, and the
    /// trace in the middle over the exact one.
    virial: f64,
    middle: f64,
}

fn spin_turns(update: StressUpdate, cfl: f64, turns: f64) -> Spun {
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
    run(
        &mut scene,
        &mut *solver,
        Until::Time((turns - 0.5) * turn),
        &mut [],
    )
    .unwrap();
    // Plane strain: the plane-stress solution with ν/(1 − ν).
    let nu = law().elastic.poisson / (1.0 - law().elastic.poisson);
    let at_axis = 0.25 * (3.0 + nu) * RADIUS * RADIUS;
    let density = law().elastic.density;
    let (mut traces, mut kinetic, mut middle, mut count) = (0.0, 0.0, 0.0, 0.0);
    while scene.time() < turns * turn {
        solver.step(&mut scene, turns * turn).unwrap();
        let body = &scene.bodies()[0];
        let motion = body.motion();
        for (i, stress) in motion.stress.iter().enumerate() {
            let trace = stress.xx() + stress.yy();
            let volume = motion.deformation_gradient[i].determinant();
            traces += trace * volume * body.particles().volume[i];
            let r2 = motion.position[i].norm_squared();
            if r2 < 2.25 * H * H {
                middle += trace / (density * omega * omega * (at_axis - 0.5 * (1.0 + nu) * r2));
                count += 1.0;
            }
        }
        kinetic += scene.energy().kinetic;
    }
    Spun {
        radius: radius(&scene) / start - 1.0,
        momentum: angular_momentum(&scene) / momentum - 1.0,
        virial: 0.5 * traces / kinetic,
        middle: middle / count,
    }
}

#[test]
fn a_spinning_disc_over_ten_turns_shows_its_order() {
    let spun = [0.4, 0.2, 0.1].map(|cfl| spin_turns(StressUpdate::Last, cfl, 10.0));
    for s in &spun {
        println!(
            "radius {:.2e} momentum {:.2e} virial {:.4} middle {:.4}",
            s.radius, s.momentum, s.virial, s.middle
        );
        // Round-off of 4,000 to 40,000 steps, and the cut-off at light nodes.
        assert!(s.momentum.abs() <= 1e-8, "{}", s.momentum);
        // Exact for a body in steady rotation: what is stressed is what turns.
        assert!((s.virial - 1.0).abs() <= 1e-3, "{}", s.virial);
        assert!((s.middle - 1.0).abs() <= 0.05, "{}", s.middle);
    }
    let orders = observed_orders(&spun.each_ref().map(|s| s.radius));
    println!("radius: orders {orders:.2?}");
    assert!(
        spun[0].radius.abs() <= 1e-3 && 0.5 * (orders[0] + orders[1]) >= 0.9,
        "{orders:?}"
    );
}

/// With the stress first, the gradient of the velocity before the step is applied at the place
/// after the step that it made: `1 + ΔtL` where `(1 − ΔtL)⁻¹` moved the points. `F` grows by
/// `ω²Δt²` a step and the disc shrinks by half of that in each direction, to first order in Δt.
#[test]
fn a_spinning_disc_shrinks_with_the_stress_first_to_first_order() {
    let radius = [0.2, 0.1, 0.05].map(|cfl| spin_turns(StressUpdate::First, cfl, 0.5).radius);
    let orders = observed_orders(&radius);
    println!("stress first: {radius:.2?}, orders {orders:.2?}");
    assert!(orders.iter().all(|order| *order >= 0.85), "{orders:?}");
}
