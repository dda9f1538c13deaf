//! Weight: what holds a column at rest, and how a lone particle falls (X9).

use fissure::nalgebra;
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

const H: f64 = 0.0625;
const GRAVITY: f64 = 9.81;

#[test]
fn a_column_at_rest_weighs_on_its_base() {
    for space in [Space::Plane, Space::Axisymmetric] {
        let mut scene = Table::scene(space);
        let mut law = rubber();
        law.elastic.poisson = 0.0;
        scene
            .fill(
                "column",
                law,
                &Block::new([0.0, 0.0], [2.0 * H, 8.0 * H]),
                &Spacing(H / 2.0),
            )
            .unwrap()
            .rigid(
                "base",
                &Block::new([0.0, -H], [2.0 * H, 0.0]),
                &Spacing(H / 2.0),
                Hold::Component(Vector2::y()),
                Constant(0.0),
            )
            .unwrap()
            .body_force(|_, _| vector![0.0, -GRAVITY]);
        let grid = Grid::over([-4.0 * H, -4.0 * H], [6.0 * H, 12.0 * H], H).unwrap();
        // PIC damps to rest.
        let settings = ExplicitSettings {
            transfer: Transfer::Pic,
            ..Default::default()
        };
        let mut solver = Table::solver(ShapeKind::Linear, grid, settings).unwrap();
        run(&mut scene, &mut *solver, Until::Steps(9000), &mut []).unwrap();
        let mass: f64 = scene.bodies()[0].particles().mass.iter().sum();
        let reaction = scene.reaction("base").unwrap();
        let error = (reaction[1] / (mass * GRAVITY) - 1.0).abs();
        println!("{space:?}: reaction off by {error:.1e}");
        assert!(error <= 1e-12, "{space:?}: {error:e}");
        assert!(
            reaction[0].abs() <= 1e-12 * reaction[1],
            "{space:?}: {reaction}"
        );
    }
}

/// X9. Velocities are those of the parabola to round-off; positions are those of velocities half
/// a step behind, which is the parabola shifted by `g Δt/2` a second.
#[test]
fn x9_a_lone_particle_falls_on_its_parabola() {
    for shape in ShapeKind::ALL {
        let mut scene: Scene<2> = Table::scene(Space::Plane);
        let mut law = rubber();
        // Slow waves make long steps.
        law.elastic.density *= 1e4;
        let seeds = Seeds {
            position: vec![vector![0.31, 0.77]],
            volume: vec![H * H / 4.0],
            half_edges: fissure::nalgebra::Matrix2::identity() * (H / 4.0),
        };
        scene
            .add_body("point", law, seeds)
            .unwrap()
            .set_velocity("point", |_| vector![2.0, 3.0])
            .unwrap()
            .body_force(|_, _| vector![0.0, -GRAVITY]);
        let grid = Grid::over([-1.0, -1.0], [3.0, 3.0], H).unwrap();
        // The cut-off would take the force from nodes that hold next to nothing of the particle.
        let settings = ExplicitSettings {
            mass_cutoff: 0.0,
            ..Default::default()
        };
        let mut solver = Table::solver(shape, grid, settings).unwrap();
        let mut squares = 0.0;
        for _ in 0..100 {
            let report = solver.step(&mut scene, f64::INFINITY).unwrap();
            squares += report.dt * report.dt;
        }
        let t = scene.time();
        let motion = scene.bodies()[0].motion();
        let v = vector![2.0, 3.0 - GRAVITY * t];
        assert!((motion.velocity[0] - v).norm() <= 1e-12, "{shape:?}");
        let parabola = vector![0.31, 0.77] + vector![2.0, 3.0] * t
            - Vector2::y() * (0.5 * GRAVITY * (t * t + squares));
        let error = (motion.position[0] - parabola).norm();
        assert!(
            t > 0.2 && t < 0.8 && error <= 1e-12,
            "{shape:?}: {error:e} at {t} s"
        );
        let strain = (motion.deformation_gradient[0] - Matrix3::identity()).norm();
        assert!(strain <= 1e-12, "{shape:?}: strain {strain:e}");
    }
}
