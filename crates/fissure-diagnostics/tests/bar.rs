//! A bar that breaks in one row of cells, watched.

mod support;

use fissure_diagnostics::{EnergyBalance, Record};
use fissure_scene::{Until, run};

use support::{Bar, broken};

#[test]
fn a_record_keeps_what_the_scene_and_the_report_say() {
    let bar = Bar::default();
    let (mut scene, mut solver) = bar.build();
    let mut curve = Record::new()
        .column("time [s]", |scene, _| scene.time())
        .column("force [N]", |scene, _| {
            scene.reaction("right").map_or(f64::NAN, |force| force[0])
        })
        .column("dt [s]", |_, report| report.dt)
        .every(10);
    run(
        &mut scene,
        &mut solver,
        Until::Steps(100),
        &mut [&mut curve],
    )
    .unwrap();
    assert_eq!(curve.len(), 10);
    assert_eq!(curve.last("time"), Some(scene.time()));
    assert_eq!(
        curve.last("force [N]"),
        Some(scene.reaction("right").unwrap()[0])
    );
    assert!(curve.values("dt").unwrap().iter().all(|dt| *dt > 0.0));
}

#[test]
fn the_ledger_of_a_broken_bar_closes() {
    let bar = Bar::default();
    let (scene, energy) = broken(&bar);
    let balance = EnergyBalance::of(scene.energy());
    assert!(energy.worst_balance() < 1e-9, "{energy:?}");
    assert!(energy.worst_imbalance() < 2e-3, "{balance:?}");
    assert!(balance.energy_imbalance().abs() <= energy.worst_imbalance());
    let gain = balance.kinetic + balance.transfer_loss;
    assert!((balance.grid_kinetic_gain - gain).abs() < 1e-6 * balance.scale());
    assert!((balance.dissipated / bar.fracture_energy() - 1.0).abs() < 0.05);
    let labels: Vec<&str> = energy.columns().map(|(label, _)| label).collect();
    assert_eq!(labels[0], "time [s]");
    let rows = energy.times().len();
    assert!(energy.columns().all(|(_, values)| values.len() == rows));
    let stored = energy.balances().map(|balance| balance.stored);
    assert!(stored.fold(0.0, f64::max) > 0.0);
}
