//! The halves of a bar fly apart and tear the law between them: what that takes, in explicit steps.

use fissure_grid::shape;
use fissure_scene::{Scene, Solver};
use fissure_solvers::{Explicit, ExplicitSettings, StressUpdate, Transfer};
use nalgebra::vector;

use crate::bar::{AREA, H, LAW, LENGTH, THICKNESS, WIDTH, cut, grid};

const YOUNG: f64 = 4e9;
/// m/s: kinetic energy of some times what the law takes.
const SPEED: f64 = 3.0;

fn scene() -> Scene<2> {
    let x = 4.4 * H;
    let mut scene = cut(YOUNG, WIDTH, [x; 2]);
    scene
        .set_velocity("bar", move |p| {
            vector![if p.x < x { -SPEED } else { SPEED }, 0.0]
        })
        .unwrap();
    scene
}

fn solver(transfer: Transfer, stress_update: StressUpdate) -> Explicit<shape::Gimp, 2> {
    let settings = ExplicitSettings {
        transfer,
        stress_update,
        ..ExplicitSettings::default()
    };
    Explicit::new(grid(), shape::Gimp, settings).unwrap()
}

#[test]
fn the_ledger_closes_through_failure() {
    for transfer in [Transfer::Flip { pic: 0.0 }, Transfer::Xpic { order: 3 }] {
        for update in [StressUpdate::First, StressUpdate::Last, StressUpdate::Musl] {
            let (mut scene, mut solver) = (scene(), solver(transfer, update));
            let start = 0.5 * 1000.0 * LENGTH * WIDTH * THICKNESS * SPEED * SPEED;
            while scene.time() < 3e-4 {
                solver.step(&mut scene, 3e-4).unwrap();
            }
            let e = *scene.energy();
            let spent = e.dissipated / (LAW.toughness * AREA);
            let imbalance = e.imbalance() / e.dissipated;
            println!(
                "{transfer:?} {update:?}: {spent:.5} of G_f A, imbalance {imbalance:.1e}, transfer {:.3} of the start",
                e.transfer_loss / start
            );
            assert!((spent - 1.0).abs() < 5e-3, "{spent}");
            assert!(imbalance.abs() < 0.02, "{imbalance}");
            let all = e.kinetic + e.half_step + e.internal + e.contact + e.transfer_loss;
            assert!((all / start - 1.0).abs() < 1e-10, "{e:?}");
            assert!(e.worst_balance < 1e-12, "{e:?}");
        }
    }
}

#[test]
fn a_restart_has_the_same_bits() {
    let transfer = Transfer::Xpic { order: 2 };
    let make = || (scene(), solver(transfer, StressUpdate::Musl));
    let (mut scene, mut through) = make();
    let spent = |scene: &Scene<2>| scene.energy().dissipated / (LAW.toughness * AREA);
    while spent(&scene) < 0.4 {
        through.step(&mut scene, 1.0).unwrap();
    }
    let (sections, memory) = (scene.save().unwrap(), through.memory());
    let (mut again, mut restarted) = make();
    again.restore(&sections).unwrap();
    restarted.recall(&memory);
    for _ in 0..10 {
        through.step(&mut scene, 1.0).unwrap();
        restarted.step(&mut again, 1.0).unwrap();
    }
    assert!(spent(&scene) > 0.5, "{}", spent(&scene));
    assert_eq!(
        scene.bodies()[0].motion().velocity,
        again.bodies()[0].motion().velocity
    );
    assert_eq!(scene.cracks(), again.cracks());
    assert_eq!(scene.energy(), again.energy());
}
