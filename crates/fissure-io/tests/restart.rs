//! A scene that is saved in the middle of softening and restarted ends with the same bits.
#![allow(clippy::unwrap_used, reason = "helpers of tests are tests")]

mod support;

use std::fs;

use fissure_io::checkpoint::{AutoCheckpoint, Checkpoint, CheckpointError, CheckpointReader};
use fissure_scene::{PersistError, Plane, Scene, Solver, Until, Watch, run};
use fissure_solvers::{ExplicitSettings, StressUpdate, Transfer};

use support::bar::{HALF_BROKEN, scene, solver};

const STRAIN: Plane = Plane::Strain { thickness: 0.05 };

fn softened(scene: &Scene<2>) -> f64 {
    let softened = scene.body("bar").unwrap().value("softened").unwrap();
    softened.into_iter().fold(0.0, f64::max)
}

/// Runs to the middle of softening and on; then again from the last checkpoint before the end.
fn restart(plane: Plane, settings: ExplicitSettings) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.checkpoint");
    let end = Until::Time(1.1 * HALF_BROKEN);

    let mut whole = scene(plane);
    let mut checkpoint = AutoCheckpoint::new(&path, 1000);
    let mut moving = solver(settings);
    run(&mut whole, &mut moving, end, &mut [&mut checkpoint]).unwrap();

    let mut again = scene(plane);
    let mut resumed = solver(settings);
    let memory = Checkpoint::load(&path, &mut again).unwrap();
    assert!(!memory.is_empty());
    resumed.recall(&memory);
    assert_eq!(Some(again.step()), checkpoint.last());
    assert!(again.step() < whole.step());
    let halfway = softened(&again);
    assert!(halfway > 0.1 && halfway < 1.0, "{halfway}");
    run(&mut again, &mut resumed, end, &mut []).unwrap();

    assert!(softened(&again) > halfway);
    assert_eq!(again.step(), whole.step());
    assert_eq!(again.time().to_bits(), whole.time().to_bits());
    assert_eq!(again.save().unwrap(), whole.save().unwrap());
    assert_eq!(resumed.memory(), moving.memory());
}

#[test]
fn in_plane_strain_by_default() {
    restart(STRAIN, ExplicitSettings::default());
}

#[test]
fn in_plane_stress_with_stress_first() {
    let settings = ExplicitSettings {
        stress_update: StressUpdate::First,
        ..ExplicitSettings::default()
    };
    restart(Plane::Stress { thickness: 0.05 }, settings);
}

#[test]
fn with_affine_columns_and_viscosity() {
    let settings = ExplicitSettings {
        transfer: Transfer::Apic,
        stress_update: StressUpdate::Last,
        viscosity: Some((0.1, 1.5)),
        ..ExplicitSettings::default()
    };
    restart(STRAIN, settings);
}

/// A checkpoint of the bar after some steps, and where it is.
fn saved(folder: &tempfile::TempDir) -> std::path::PathBuf {
    let path = folder.path().join("bar.checkpoint");
    let (mut scene, mut solver) = (scene(STRAIN), solver(ExplicitSettings::default()));
    run(&mut scene, &mut solver, Until::Steps(5), &mut []).unwrap();
    Checkpoint::save(&path, &scene, &solver.memory()).unwrap();
    path
}

#[test]
fn a_spoilt_file_is_refused_by_section_and_leaves_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let path = saved(&folder);
    let reader = CheckpointReader::open(&path).unwrap();
    let names: Vec<String> = reader.sections().map(|(name, _)| name.to_owned()).collect();
    let expected = [
        "scene",
        "bar/particles",
        "bar/states",
        "bar/extra/scale",
        "block/particles",
        "block/states",
        "solver memory",
    ];
    assert_eq!(names, expected);
    let lengths: Vec<usize> = names[..names.len() - 1]
        .iter()
        .map(|name| reader.get_bytes(name).unwrap().len())
        .collect();
    let whole = fs::read(&path).unwrap();
    let untouched = scene(STRAIN).save().unwrap();
    let memory: Vec<f64> = reader.get("solver memory").unwrap();
    let sections = lengths.iter().sum::<usize>() + size_of_val(&memory[..]);
    let mut start = whole.len() - sections;
    for (name, length) in names.iter().zip(lengths) {
        let middle = start + length / 2;
        start += length;
        let mut flipped = whole.clone();
        flipped[middle] ^= 1;
        for (spoilt, word) in [
            (flipped, "damaged"),
            (whole[..middle].to_vec(), "truncated"),
        ] {
            fs::write(&path, spoilt).unwrap();
            let mut scene = scene(STRAIN);
            let error = Checkpoint::load(&path, &mut scene).unwrap_err().to_string();
            assert!(
                error.contains(word) && error.contains(&format!("'{name}'")),
                "{error}"
            );
            assert_eq!(scene.save().unwrap(), untouched);
        }
    }
}

#[test]
fn another_scene_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = saved(&folder);
    let mut other: Scene<2> = Scene::plane(STRAIN);
    let error = Checkpoint::load(&path, &mut other).unwrap_err();
    let CheckpointError::Scene { source, .. } = error else {
        panic!("{error}");
    };
    assert!(matches!(source, PersistError::Mismatch { .. }), "{source}");
}

#[test]
fn a_checkpoint_without_memory_can_be_gone_on_from() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.checkpoint");
    let (mut bar, mut moving) = (scene(STRAIN), solver(ExplicitSettings::default()));
    let report = moving.step(&mut bar, 1.0).unwrap();
    let mut checkpoint = AutoCheckpoint::new(&path, 1);
    checkpoint.after(&bar, &report).unwrap();
    let mut again = scene(STRAIN);
    let memory = Checkpoint::load(&path, &mut again).unwrap();
    assert!(memory.is_empty());
    moving.recall(&memory);
    moving.step(&mut again, 1.0).unwrap();
    assert_eq!(again.step(), 2);
}
