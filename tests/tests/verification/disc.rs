//! A spinning disc over ten turns, and the stress that holds it together (A12, plane strain).

use std::f64::consts::PI;

use fissure::materials::Hencky;
use fissure::nalgebra;
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, observed_orders, rubber};

const RADIUS: f64 = 0.5;
const CELLS: f64 = 6.0;
const H: f64 = RADIUS / CELLS;

fn law() -> Hencky {
    rubber()
}

/// Angular velocity at which the rim runs at this share of the wave speed.
fn spin(share: f64) -> f64 {
    share * law().elastic.p_wave_speed() / RADIUS
}

fn disc(omega: f64, h: f64) -> Scene<2> {
    let mut scene = Table::scene(Space::Plane);
    scene
        .fill(
            "disc",
            law(),
            &Ball::new([0.0, 0.0], RADIUS),
            &Spacing(0.5 * h),
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

/// Angular momentum, mean radius (root mean square) and energy.
fn state(scene: &Scene<2>) -> [f64; 3] {
    let body = &scene.bodies()[0];
    let motion = body.motion();
    let (mut spin, mut square) = (0.0, 0.0);
    for (i, mass) in body.particles().mass.iter().enumerate() {
        let (x, v) = (motion.position[i], motion.velocity[i]);
        spin += mass * (x[0] * v[1] - x[1] * v[0]);
        square += mass * x.norm_squared();
    }
    [
        spin,
        square.sqrt(),
        scene.energy().kinetic + scene.energy().stored,
    ]
}

/// Relative change of those over ten turns.
fn drift(update: StressUpdate, transfer: Transfer, cfl: f64) -> [f64; 3] {
    let omega = spin(0.1);
    let mut scene = disc(omega, H);
    let grid = Grid::over([-0.5 - 6.0 * H; 2], [0.5 + 6.0 * H; 2], H).unwrap();
    let settings = ExplicitSettings {
        cfl,
        transfer,
        stress_update: update,
        ..Default::default()
    };
    let mut solver = Table::solver(ShapeKind::Bspline2, grid, settings).unwrap();
    // One step for the stored energy.
    solver.step(&mut scene, f64::INFINITY).unwrap();
    let start = state(&scene);
    run(
        &mut scene,
        &mut *solver,
        Until::Time(20.0 * PI / omega),
        &mut [],
    )
    .unwrap();
    let end = state(&scene);
    [0, 1, 2].map(|k| end[k] / start[k] - 1.0)
}

#[test]
fn a_spinning_disc_over_ten_turns_shows_its_order() {
    for (update, transfer) in [
        (StressUpdate::First, Transfer::Flip { pic: 0.0 }),
        (StressUpdate::Last, Transfer::Flip { pic: 0.0 }),
        (StressUpdate::Musl, Transfer::Flip { pic: 0.0 }),
        (StressUpdate::Last, Transfer::Apic),
    ] {
        let drifts = [0.4, 0.2, 0.1].map(|cfl| drift(update, transfer, cfl));
        println!("{update:?} {transfer:?} {drifts:?}");
        for k in 0..3 {
            println!("   {:?}", observed_orders(&drifts.map(|d| d[k])));
        }
    }
}
