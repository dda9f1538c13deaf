//! A bar that breaks in one row of cells, watched.

mod support;

use fissure_diagnostics::{
    EnergyBalance, FailedZone, LoadDisplacement, MeasureError, Record, state_hash,
};
use fissure_scene::{SolveError, Until, WatchError, run};

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
    assert!(balance.energy_imbalance().abs() < 2e-3, "{balance:?}");
    let gain = balance.kinetic + balance.half_step + balance.transfer_loss;
    assert!((balance.grid_kinetic_gain - gain).abs() < 1e-6 * balance.scale());
    assert!((balance.dissipated / bar.fracture_energy() - 1.0).abs() < 0.05);
    let labels: Vec<&str> = energy.columns().map(|(label, _)| label).collect();
    assert_eq!(labels[0], "time [s]");
    let rows = energy.times().len();
    assert!(energy.columns().all(|(_, values)| values.len() == rows));
    let stored = energy.balances().map(|balance| balance.stored);
    assert!(stored.fold(0.0, f64::max) > 0.0);
}

#[test]
fn the_failed_zone_is_one_row_of_cells() {
    let bar = Bar::default();
    let (scene, _) = broken(&bar);
    let zone = FailedZone::of(&scene, "bar", "failed", 1.0).unwrap();
    assert_eq!(zone.number, 8);
    assert!((zone.measure - bar.cell * bar.width).abs() < 1e-15);
    assert!((zone.width(bar.area()).unwrap() - bar.cell).abs() < 1e-15);
    let open = FailedZone::of(&scene, "bar", "opening", bar.critical_opening()).unwrap();
    assert_eq!(open, zone);
    assert!(zone.width(0.0).is_err() && zone.width(f64::NAN).is_err());
    let none = FailedZone::of(&scene, "bar", "opening", f64::INFINITY).unwrap();
    assert_eq!(none, FailedZone::default());
    assert!(matches!(
        FailedZone::of(&scene, "bar", "damage", 1.0),
        Err(MeasureError::UnknownValue { .. })
    ));
    assert!(FailedZone::of(&scene, "bar", "opening", f64::NAN).is_err());
}

#[test]
fn the_curve_of_the_grips_gives_the_work_and_the_peak() {
    let bar = Bar::default();
    let (mut scene, mut solver) = bar.build();
    let mut curve = LoadDisplacement::of("right").against("left").every(25);
    let way = 1.3 * bar.critical_opening();
    let end = Until::Time(bar.time_at(way));
    run(&mut scene, &mut solver, end, &mut [&mut curve]).unwrap();
    let curve = curve.curve();
    assert_eq!(curve.displacement().len() as u64, 1 + scene.step() / 25);
    assert_eq!((curve.displacement()[0], curve.load()[0]), (0.0, 0.0));
    assert!(
        (curve.now().0 / way - 1.0).abs() < 1e-2,
        "{:?}",
        curve.now()
    );
    // Both grips move the same way only through the body: their mean load does the work.
    let external = scene.energy().external;
    assert!((curve.work() / external - 1.0).abs() < 0.02, "{external}");
    let strength = Bar::WEAKNESS * bar.strength * bar.area();
    assert!(
        (curve.peak() / strength - 1.0).abs() < 0.1,
        "{}",
        curve.peak()
    );
    let slope = 24.9e9 / (1.0 - 0.18_f64.powi(2)) / bar.length * bar.area();
    let (onset, last) = (strength / slope, bar.critical_opening());
    let exact = |x: f64| match x {
        x if x < onset => slope * x,
        x if x < last => strength * (last - x) / (last - onset),
        _ => 0.0,
    };
    let error = curve
        .error(exact, (0.0, 1.2 * last), &[onset, last])
        .unwrap();
    assert!(error < 0.15, "{error}");
}

#[test]
fn a_grip_that_is_none_stops_the_run() {
    let (mut scene, mut solver) = Bar::default().build();
    let mut curve = LoadDisplacement::of("rigth");
    let error = run(&mut scene, &mut solver, Until::Steps(1), &mut [&mut curve]).unwrap_err();
    assert!(matches!(
        error,
        SolveError::Watch(WatchError::Unknown { name, .. }) if name == "rigth"
    ));
}

#[test]
fn the_hash_tells_a_step_and_not_an_order() {
    let (mut scene, mut solver) = Bar::default().build();
    let start = state_hash(&scene);
    run(&mut scene, &mut solver, Until::Steps(3), &mut []).unwrap();
    let moved = state_hash(&scene);
    assert_ne!(start, moved);
    let count = scene.bodies()[0].particles().len() as u32;
    let order: Vec<u32> = (0..count).rev().collect();
    scene.bodies_mut()[0].reorder(&order).unwrap();
    assert_eq!(state_hash(&scene), moved);
    let stress = &mut scene.bodies_mut()[0].particles_mut().motion.stress[5];
    stress.mandel[3] = -stress.mandel[3] + f64::MIN_POSITIVE;
    assert_ne!(state_hash(&scene), moved);
}
