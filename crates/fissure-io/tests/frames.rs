//! Frames of a running scene, read back.
#![allow(clippy::unwrap_used, reason = "helpers of tests are tests")]

mod support;

use std::collections::BTreeSet;
use std::path::Path;

use fissure_io::vtk::{Compression, ParticleSeries, Series};
use fissure_scene::{Plane, Scene, SolveError, Until, WatchError, run};
use fissure_solvers::ExplicitSettings;

use support::bar::{scene, solver};
use support::vtu::{Document, read};

const STRAIN: Plane = Plane::Strain { thickness: 0.05 };

fn series(folder: &Path) -> ParticleSeries {
    ParticleSeries::new(Series::new(folder, "bar", Compression::Lz4).unwrap())
}

fn numbers(document: &Document, name: &str) -> Vec<f64> {
    let bytes = document.arrays[name].bytes.chunks_exact(8);
    bytes
        .map(|bytes| f64::from_ne_bytes(bytes.try_into().unwrap()))
        .collect()
}

fn words(document: &Document, name: &str) -> Vec<u32> {
    let bytes = document.arrays[name].bytes.chunks_exact(4);
    bytes
        .map(|bytes| u32::from_ne_bytes(bytes.try_into().unwrap()))
        .collect()
}

fn steps(
    scene: &mut Scene<2>,
    count: u64,
    frames: &mut ParticleSeries,
) -> Result<(), Box<SolveError>> {
    let mut solver = solver(ExplicitSettings::default());
    run(scene, &mut solver, Until::Steps(count), &mut [frames])?;
    Ok(())
}

#[test]
fn every_field_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = scene(STRAIN);
    let mut frames = series(folder.path())
        .velocity()
        .stress()
        .jacobian()
        .ids()
        .bodies()
        .value("failed")
        .values()
        .every(20);
    steps(&mut scene, 40, &mut frames).unwrap();
    assert_eq!(frames.series().len(), 2);
    let frame = read(&folder.path().join("bar_000001.vtu"));
    assert_eq!(
        (frame.points, frame.time),
        (scene.particle_count(), Some(scene.time()))
    );
    let (x, v) = (numbers(&frame, "Points"), numbers(&frame, "velocity [m/s]"));
    let (stress, jacobian) = (numbers(&frame, "stress [Pa]"), numbers(&frame, "jacobian"));
    let (ids, bodies) = (words(&frame, "id"), words(&frame, "body"));
    let opening = numbers(&frame, "opening");
    let mut row = 0;
    for (index, body) in scene.bodies().iter().enumerate() {
        let known = body.value("opening");
        assert_eq!(known.is_some(), index == 0);
        for i in 0..body.particles().len() {
            let motion = body.motion();
            assert_eq!(x[3 * row..3 * row + 2], *motion.position[i].as_slice());
            assert_eq!(v[3 * row..3 * row + 2], *motion.velocity[i].as_slice());
            assert_eq!((x[3 * row + 2], v[3 * row + 2]), (0.0, 0.0));
            let s = &motion.stress[i];
            let components = [s.xx(), s.yy(), s.zz(), s.xy(), s.yz(), s.xz()];
            assert_eq!(stress[6 * row..6 * row + 6], components);
            assert_eq!(jacobian[row], motion.deformation_gradient[i].determinant());
            assert_eq!(
                (ids[row], bodies[row]),
                (body.particles().id[i].0, index as u32)
            );
            match &known {
                Some(values) => assert_eq!(opening[row], values[i]),
                None => assert!(opening[row].is_nan()),
            }
            row += 1;
        }
    }
    assert!(frame.arrays.contains_key("softened") && frame.arrays.contains_key("failed"));
}

#[test]
fn only_what_was_asked_for_is_written_and_when_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = scene(STRAIN);
    let mut frames = series(folder.path()).every_interval(5e-6).value("opening");
    let first = frames.frame(&scene).unwrap();
    let names: BTreeSet<String> = read(&first).arrays.into_keys().collect();
    let expected = ["Points", "connectivity", "offsets", "opening", "types"];
    assert_eq!(names, expected.map(str::to_owned).into());
    steps(&mut scene, 20, &mut frames).unwrap();
    let passed = (scene.time() / 5e-6).floor() as usize;
    assert!(passed > 1);
    assert_eq!(frames.series().len(), 1 + passed);
}

#[test]
fn a_value_that_no_law_has_stops_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let mut frames = series(folder.path()).value("damage");
    let error = steps(&mut scene(STRAIN), 1, &mut frames).unwrap_err();
    assert!(matches!(
        *error,
        SolveError::Watch(WatchError::Unknown { ref name, .. }) if name == "damage"
    ));
}

#[test]
fn a_file_that_cannot_be_written_stops_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let taken = folder.path().join("taken");
    std::fs::write(&taken, "a file, no folder").unwrap();
    let error = steps(&mut scene(STRAIN), 1, &mut series(&taken)).unwrap_err();
    assert!(matches!(*error, SolveError::Watch(WatchError::Write(_))));
}
