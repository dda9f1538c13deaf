//! An elastic bar that is held at one end and rings along its axis.

use fissure_grid::{Grid, shape};
use fissure_materials::Isotropic;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Hold, Plane, Scene, Solver, Velocity};
use fissure_solvers::{Implicit, ImplicitSettings};
use fissure_tensor::Matrix3;
use nalgebra::{SVector, vector};

pub const LENGTH: f64 = 1.0;
const SPACING: f64 = 0.125;
pub const STONE: Isotropic = Isotropic {
    density: 1000.0,
    young: 1e6,
    poisson: 0.0,
};

/// Speed of a wave along the bar, m/s.
pub fn wave() -> f64 {
    (STONE.young / STONE.density).sqrt()
}

/// Time of one vibration of the first mode, s.
pub fn period() -> f64 {
    4.0 * LENGTH / wave()
}

pub fn grid() -> Grid<2> {
    Grid::over([-0.5, -0.5], [1.5, 0.75], SPACING).unwrap()
}

/// The bar at rest, thrown along its axis in the shape of its first mode, or, with `speed` 0, at rest.
pub fn scene(speed: f64) -> Scene<2> {
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let half = SPACING / 2.0;
    let along = Hold::Component(vector![1.0, 0.0]);
    scene
        .fill(
            "bar",
            STONE,
            &Block::new([0.0, 0.0], [LENGTH, 0.25]),
            &Spacing(half),
        )
        .unwrap()
        .set_velocity("bar", |x| {
            vector![
                speed * (std::f64::consts::FRAC_PI_2 * x[0] / LENGTH).sin(),
                0.0
            ]
        })
        .unwrap()
        .rigid(
            "wall",
            &Block::new([-SPACING, 0.0], [0.0, 0.25]),
            &Spacing(half),
            along,
            Velocity(|_| 0.0),
        )
        .unwrap();
    scene
}

pub fn solver(settings: ImplicitSettings) -> Implicit<shape::Linear, 2> {
    Implicit::new(grid(), shape::Linear, settings).unwrap()
}

/// Steps to a time.
pub fn run(scene: &mut Scene<2>, solver: &mut dyn Solver<2>, until: f64) {
    while scene.time() < until {
        solver.step(scene, until).unwrap();
    }
}

/// Positions and velocities of the particles by their ids.
pub fn motion(scene: &Scene<2>) -> Vec<(SVector<f64, 2>, SVector<f64, 2>, Matrix3<f64>)> {
    let particles = scene.bodies()[0].particles();
    let mut rows: Vec<usize> = (0..particles.len()).collect();
    rows.sort_by_key(|&row| particles.id[row].0);
    let motion = &particles.motion;
    rows.iter()
        .map(|&row| {
            (
                motion.position[row],
                motion.velocity[row],
                motion.deformation_gradient[row],
            )
        })
        .collect()
}

/// Largest difference of positions over `length` and velocities over `speed`.
pub fn difference(a: &Scene<2>, b: &Scene<2>, length: f64, speed: f64) -> f64 {
    let pairs = motion(a).into_iter().zip(motion(b));
    let mut largest: f64 = 0.0;
    for ((x, v, _), (y, w, _)) in pairs {
        largest = largest
            .max((x - y).amax() / length)
            .max((v - w).amax() / speed);
        assert!(!largest.is_nan());
    }
    largest
}
