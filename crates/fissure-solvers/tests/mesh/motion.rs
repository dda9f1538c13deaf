//! A body that flies over a distorted mesh.

use fissure_grid::shape;
use fissure_materials::NeoHookean;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Plane, Scene, Solver};
use fissure_solvers::{Explicit, ExplicitSettings, StressUpdate, Transfer};
use nalgebra::{Vector2, vector};

use crate::meshes::distorted;

fn block(velocity: Vector2<f64>) -> Scene<2> {
    let law = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let block = Block::new([0.25, 0.375], [0.75, 0.875]);
    scene
        .fill("block", law, &block, &Spacing(1.0 / 32.0))
        .unwrap();
    scene.set_velocity("block", |_| velocity).unwrap();
    scene
}

fn settings(transfer: Transfer, stress_update: StressUpdate) -> ExplicitSettings {
    ExplicitSettings {
        transfer,
        stress_update,
        ..ExplicitSettings::default()
    }
}

const TRANSFERS: [Transfer; 5] = [
    Transfer::Flip { pic: 0.0 },
    Transfer::Pic,
    Transfer::Apic,
    Transfer::Xpic { order: 2 },
    Transfer::Fmpm { order: 2 },
];

/// Across many faces and patches: no particle is hurried or strained, nothing of the momentum is lost.
#[test]
fn a_rigid_translation_stays_one() {
    let velocity = vector![9.0, 2.5];
    for transfer in TRANSFERS {
        for stress_update in [StressUpdate::Last, StressUpdate::Musl] {
            let mesh = distorted(24, 12, 0.125);
            let mut scene = block(velocity);
            let mut solver = Explicit::new(
                mesh.grid(),
                shape::Isoparametric(mesh),
                settings(transfer, stress_update),
            )
            .unwrap();
            let momentum = |scene: &Scene<2>| -> Vector2<f64> {
                let body = &scene.bodies()[0];
                let pairs = body.particles().mass.iter().zip(body.motion().velocity);
                pairs.map(|(m, v)| v * *m).sum()
            };
            let before = momentum(&scene);
            let end = 0.15;
            while scene.time() < end {
                solver.step(&mut scene, end).unwrap();
            }
            assert!(scene.step() > 100);
            let lost = (momentum(&scene) - before).norm() / before.norm();
            println!("{transfer:?}, {stress_update:?}: momentum {lost:.1e}");
            assert!(lost <= 1e-11);
            for (v, s) in scene.bodies()[0]
                .motion()
                .velocity
                .iter()
                .zip(scene.bodies()[0].motion().stress)
            {
                assert!(
                    (v - velocity).norm() <= 1e-9 * velocity.norm(),
                    "{transfer:?} {stress_update:?}"
                );
                assert!(
                    s.norm() <= 1e-6 * 1e6,
                    "{transfer:?} {stress_update:?} {s:?}"
                );
            }
        }
    }
}

/// Inner forces sum to nothing on any mesh.
#[test]
fn momentum_is_kept_by_a_ringing_block() {
    for transfer in TRANSFERS {
        let mesh = distorted(24, 12, 0.125);
        let mut scene = block(vector![4.0, 1.0]);
        let wave = |x: &Vector2<f64>| vector![4.0 + (5.0 * x.y).sin(), 1.0 + (7.0 * x.x).cos()];
        scene.set_velocity("block", wave).unwrap();
        let mut solver = Explicit::new(
            mesh.grid(),
            shape::Isoparametric(mesh),
            settings(transfer, StressUpdate::Musl),
        )
        .unwrap();
        let momentum = |scene: &Scene<2>| -> Vector2<f64> {
            let body = &scene.bodies()[0];
            let pairs = body.particles().mass.iter().zip(body.motion().velocity);
            pairs.map(|(m, v)| v * *m).sum()
        };
        let before = momentum(&scene);
        for _ in 0..150 {
            solver.step(&mut scene, f64::INFINITY).unwrap();
        }
        let stored = scene.energy().stored;
        assert!(
            stored > 1e-4 * scene.energy().kinetic,
            "{transfer:?}: {stored}"
        );
        assert!(
            (momentum(&scene) - before).norm() <= 1e-11 * before.norm(),
            "{transfer:?}"
        );
    }
}

/// The same bits on one thread and on several, and after a restart.
#[test]
fn bits_are_the_same_on_any_threads_and_after_a_restart() {
    let run = |threads: usize, restart: bool| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mesh = distorted(24, 12, 0.125);
            let new = || {
                Explicit::new(
                    mesh.grid(),
                    shape::Isoparametric(mesh.clone()),
                    settings(Transfer::Apic, StressUpdate::Musl),
                )
                .unwrap()
            };
            let turning = |x: &Vector2<f64>| vector![4.0 - 3.0 * x.y, 1.0 + 3.0 * x.x];
            let mut scene = block(vector![0.0, 0.0]);
            scene.set_velocity("block", turning).unwrap();
            let mut solver = new();
            for step in 0..120 {
                if restart && step == 61 {
                    let (sections, memory) = (scene.save().unwrap(), solver.memory());
                    scene = block(vector![0.0, 0.0]);
                    scene.restore(&sections).unwrap();
                    solver = new();
                    solver.recall(&memory);
                }
                solver.step(&mut scene, f64::INFINITY).unwrap();
            }
            let body = &scene.bodies()[0];
            let rows = crate::meshes::by_id(body);
            let motion = body.motion();
            rows.into_iter()
                .flat_map(|row| {
                    let (x, v) = (motion.position[row], motion.velocity[row]);
                    [x.x, x.y, v.x, v.y].map(f64::to_bits)
                })
                .collect::<Vec<u64>>()
        })
    };
    let one = run(1, false);
    assert_eq!(one, run(3, false));
    assert_eq!(one, run(2, true));
}
