//! D4. Angular momentum under APIC, with gradients of the functions or moving least squares, `Σ m (x × v + ε:C D)`: kept to round-off on splines, whose
//! moment `D` does not depend on the place. The other shapes store the velocity gradient instead
//! of the moment and keep it less well.

use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

const H: f64 = 0.125;

/// Angular momentum; `moment` is `D` of the shape, m².
fn angular(scene: &Scene<2>, moment: f64) -> f64 {
    let mut sum = 0.0;
    for body in scene.bodies() {
        let motion = body.motion();
        for (i, mass) in body.particles().mass.iter().enumerate() {
            let (x, v, c) = (motion.position[i], motion.velocity[i], motion.affine[i]);
            sum += mass * (x[0] * v[1] - x[1] * v[0] + moment * (c.m21 - c.m12));
        }
    }
    sum
}

#[test]
fn d4_apic_keeps_angular_momentum_on_splines() {
    for (shape, moment) in [
        (ShapeKind::Bspline2, H * H / 4.0),
        (ShapeKind::Bspline3, H * H / 3.0),
    ] {
        let updates = [StressUpdate::First, StressUpdate::Last, StressUpdate::Musl];
        for (transfer, update) in [Transfer::Apic, Transfer::Mls]
            .into_iter()
            .flat_map(|transfer| updates.map(|update| (transfer, update)))
        {
            let mut scene: Scene<2> = Table::scene(Space::Plane);
            let block = Block::new([-0.4, -0.3], [0.5, 0.3]);
            scene
                .fill("block", rubber(), &block, &Spacing(H / 2.0))
                .unwrap()
                .set_velocity("block", |x| {
                    Vector2::new(1.0 - 9.0 * x[1], 9.0 * x[0] + 3.0 * x[1])
                })
                .unwrap();
            let grid = Grid::over([-2.0; 2], [3.0; 2], H).unwrap();
            let settings = ExplicitSettings {
                transfer,
                stress_update: update,
                mass_cutoff: 0.0,
                cfl: 0.3,
                ..Default::default()
            };
            let mut solver = Table::solver(shape, grid, settings).unwrap();
            // The first step fills the affine part.
            solver.step(&mut scene, f64::INFINITY).unwrap();
            let start = angular(&scene, moment);
            let mut worst: f64 = 0.0;
            for _ in 0..200 {
                let before = angular(&scene, moment);
                solver.step(&mut scene, f64::INFINITY).unwrap();
                let error = (angular(&scene, moment) - before).abs() / start.abs();
                assert!(error.is_finite());
                worst = worst.max(error);
            }
            println!("{shape:?} {transfer:?} {update:?}: {worst:.1e} a step");
            assert!(
                worst <= 1e-13,
                "{shape:?} {transfer:?} {update:?}: {worst:e} a step"
            );
        }
    }
}
