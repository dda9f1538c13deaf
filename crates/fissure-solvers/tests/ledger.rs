//! The ledger of a ringing block: the laws' work but for little that falls with the step, and every joule in a column.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests")]

use fissure_grid::{Grid, Shape, shape};
use fissure_materials::{Hencky, Isotropic};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Plane, Scene, Solver};
use fissure_solvers::{Explicit, ExplicitSettings, StressUpdate, Transfer};
use nalgebra::vector;

const H: f64 = 0.125;
const SIZE: f64 = 6.0 * H;

/// Imbalance over the energy at the start, after the block has rung once.
fn imbalance<S: Shape<2>>(shape: S, transfer: Transfer, update: StressUpdate, cfl: f64) -> f64 {
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: 0.0,
    };
    let speed = elastic.p_wave_speed();
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let block = Block::new([0.0; 2], [SIZE; 2]);
    let wave = std::f64::consts::PI / SIZE;
    scene
        .fill("block", Hencky { elastic }, &block, &Spacing(0.5 * H))
        .unwrap()
        .set_velocity("block", |x| {
            vector![
                2e-3 * speed * (wave * x.x).cos(),
                -1e-3 * speed * (wave * x.y).cos()
            ]
        })
        .unwrap();
    let start = scene.energy().kinetic;
    let grid = Grid::over([-4.0 * H; 2], [SIZE + 4.0 * H; 2], H).unwrap();
    let settings = ExplicitSettings {
        cfl,
        transfer,
        stress_update: update,
        ..ExplicitSettings::default()
    };
    let mut solver = Explicit::new(grid, shape, settings).unwrap();
    let end = 2.0 * SIZE / speed;
    while scene.time() < end {
        solver.step(&mut scene, end).unwrap();
    }
    let e = scene.energy();
    assert!(e.worst_balance <= 1e-12, "{e:?}");
    let all = e.kinetic + e.half_step + e.internal + e.transfer_loss;
    assert!((all / start - 1.0).abs() <= 1e-10, "{e:?}");
    e.imbalance() / start
}

#[test]
fn the_laws_take_the_work_that_is_booked() {
    let transfers = [
        Transfer::Flip { pic: 0.0 },
        Transfer::Pic,
        Transfer::Xpic { order: 3 },
    ];
    for update in [StressUpdate::First, StressUpdate::Last, StressUpdate::Musl] {
        for transfer in transfers {
            let of = |cfl| imbalance(shape::Gimp, transfer, update, cfl);
            let [coarse, fine] = [of(0.4), of(0.1)];
            println!("{update:?} {transfer:?}: {coarse:.2e}, {fine:.2e}");
            assert!(coarse.abs() < 1e-3, "{coarse}");
            assert!(fine.abs() < 0.3 * coarse.abs() + 1e-6, "{coarse} {fine}");
        }
    }
}
