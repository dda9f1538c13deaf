//! D5. The ledger of a vibrating block.
//!
//! External work = change of the grid's kinetic energy + internal work: to round-off.
//! Internal work = stored + dissipated: to first order in the step.
//! What particles hold in all: never more than at the start, but for a part that falls with the
//! step.

use std::f64::consts::PI;

use fissure::prelude::*;
use fissure_tests::{Build, Case, Space, Table, cases, observed_orders, rubber};

const H: f64 = 0.125;

struct Outcome {
    balance: f64,
    imbalance: f64,
    /// Largest energy of the particles over that at the start, less 1.
    growth: f64,
}

fn vibrate<const D: usize>(case: &Case, cfl: f64) -> Outcome
where
    Table: Build<D>,
{
    let cells = if D == 3 { 3.0 } else { 6.0 };
    let size = cells * H;
    let mut scene = Table::scene(case.space);
    // Radii from 8 cells: far from the axis.
    let low = if case.space == Space::Axisymmetric { 8.0 * H } else { 0.0 };
    let mut min = [0.0; D];
    min[0] = low;
    let mut max = [size; D];
    max[0] = low + size;
    scene.fill("block", rubber(), &Block::new(min, max), &Spacing(H / 2.0)).unwrap();
    let speed = rubber().elastic.p_wave_speed();
    scene
        .set_velocity("block", |x| {
            let mut v = x * 0.0;
            v[0] = 2e-3 * speed * (PI * (x[0] - low) / size).cos();
            v[1] = -1e-3 * speed * (PI * x[1] / size).cos();
            v
        })
        .unwrap();
    let start = scene.energy().kinetic;
    let grid = Grid::over([-4.0 * H; D], [20.0 * H; D], H).unwrap();
    let mut solver = Table::row(case, grid, cfl).unwrap();
    let end = 2.0 * size / speed;
    let mut largest = 0.0;
    while scene.time() < end {
        solver.step(&mut scene, end).unwrap();
        let energy = scene.energy().kinetic + scene.energy().stored;
        if !(energy <= largest) {
            largest = energy;
        }
    }
    let energy = scene.energy();
    assert!(energy.stored > 1e-4 * start || case.transfer == Transfer::Pic, "{case:?}: at rest");
    Outcome {
        balance: energy.worst_balance,
        imbalance: energy.imbalance() / start,
        growth: largest / start - 1.0,
    }
}

fn ledger<const D: usize>(case: &Case)
where
    Table: Build<D>,
{
    let outcomes = [0.4, 0.2, 0.1].map(|cfl| vibrate::<D>(case, cfl));
    let imbalance = outcomes.each_ref().map(|outcome| outcome.imbalance);
    let orders = observed_orders(&imbalance);
    println!(
        "{case:?} balance {:.1e} imbalance {:.2e} {:.2e} {:.2e} orders {orders:.2?} growth {:.1e} {:.1e} {:.1e}",
        outcomes[0].balance, imbalance[0], imbalance[1], imbalance[2],
        outcomes[0].growth, outcomes[1].growth, outcomes[2].growth,
    );
}

#[test]
fn d5_ledger_of_a_vibrating_block_in_plane() {
    cases(Space::Plane).iter().for_each(ledger::<2>);
}

#[test]
fn d5_ledger_of_a_vibrating_block_axisymmetric() {
    cases(Space::Axisymmetric).iter().for_each(ledger::<2>);
}

#[test]
fn d5_ledger_of_a_vibrating_block_in_space() {
    cases(Space::Solid).iter().for_each(ledger::<3>);
}
