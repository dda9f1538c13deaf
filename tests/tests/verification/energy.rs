//! D5. The ledger of a vibrating block.
//!
//! External work = change of the grid's kinetic energy + internal work: to round-off.
//! Internal work = stored + dissipated: but for little that falls with the step.
//! External work = kinetic energy at the time of the stresses + internal work + what the transfer loses: to round-off.
//! What particles hold in all: never more than at the start, but for a part that falls with the
//! step.

use std::f64::consts::PI;

use fissure::materials::Hencky;
use fissure::prelude::*;
use fissure_tests::{Build, Case, Space, Table, cases, observed_orders, rubber};

const H: f64 = 0.125;
/// Courant numbers.
const STEPS: [f64; 3] = [0.4, 0.2, 0.1];

/// Without lateral strain the cosines below are free vibrations: no waves start at the faces.
fn law() -> Hencky {
    let mut law = rubber();
    law.elastic.poisson = 0.0;
    law
}

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
    let cells = if D == 3 { 4.0 } else { 6.0 };
    let size = cells * H;
    let mut scene = Table::scene(case.space);
    // Radii from 8 cells: far from the axis.
    let low = if case.space == Space::Axisymmetric {
        8.0 * H
    } else {
        0.0
    };
    let mut min = [0.0; D];
    min[0] = low;
    let mut max = [size; D];
    max[0] = low + size;
    scene
        .fill("block", law(), &Block::new(min, max), &Spacing(H / 2.0))
        .unwrap();
    let speed = law().elastic.p_wave_speed();
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
    assert!(
        energy.stored > 1e-4 * start || case.transfer == Transfer::Pic,
        "{case:?}: at rest"
    );
    // Every joule is in a column.
    let all = energy.kinetic + energy.half_step + energy.internal + energy.transfer_loss;
    assert!((all / start - 1.0).abs() <= 1e-10, "{case:?}: {energy:?}");
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
    let outcomes = STEPS.map(|cfl| vibrate::<D>(case, cfl));
    let imbalance = outcomes.each_ref().map(|outcome| outcome.imbalance);
    let orders = observed_orders(&imbalance);
    for (outcome, cfl) in outcomes.iter().zip(STEPS) {
        assert!(outcome.balance <= 1e-12, "{case:?}: {:e}", outcome.balance);
        let imbalance = outcome.imbalance.abs() / cfl;
        assert!(imbalance <= 1e-3, "{case:?}: imbalance {imbalance} per cfl");
        // Particles hold velocities half a step behind their stresses, which shows in the sum of
        // the energies to first order; the finest wave of the coarse block in space has 4 cells.
        let bound = if D == 3 { 0.45 } else { 0.3 };
        let growth = outcome.growth / cfl;
        assert!(
            growth <= bound,
            "{case:?}: energy grows by {growth} per cfl"
        );
    }
    println!("{case:?}: imbalance {imbalance:?}, orders {orders:?}");
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
