//! A law that keeps the states of cracked particles alone gives the bits of one that keeps all.

use fissure::diagnostics::state_hash;
use fissure::prelude::*;
use fissure_tests::{Build, Dense, Space, Table};

use crate::fragments::{SETTINGS, advance, brittle, scene_of, softening, solver, sorted_anew};

fn strain() -> Scene<2> {
    Table::scene(Space::Plane)
}

fn stress() -> Scene<2> {
    Scene::plane(Plane::Stress { thickness: 1.0 })
}

/// Bytes of the bar's states in a checkpoint.
fn saved(scene: &Scene<2>) -> usize {
    let sections = scene.save().unwrap();
    let states = sections.iter().find(|section| section.name == "bar/states");
    states.unwrap().bytes.len()
}

#[test]
fn sparse_and_dense_states_give_the_same_bits() {
    for empty in [strain, stress] {
        for setting in &SETTINGS {
            let mut sparse = scene_of(empty(), brittle(), 0.0);
            let mut dense = scene_of(empty(), Dense(brittle()), 0.0);
            let (mut one, mut other) = (solver(setting, 0.0), solver(setting, 0.0));
            let mut some_kept = false;
            for step in (20..=160).step_by(20) {
                advance(&mut sparse, &mut *one, 20);
                advance(&mut dense, &mut *other, 20);
                assert!(
                    state_hash(&sparse) == state_hash(&dense) && sparse.energy() == dense.energy(),
                    "{setting:?}: the bits differ after {step} steps"
                );
                some_kept |= softening(&sparse) > 0 && saved(&sparse) < saved(&dense);
            }
            assert!(some_kept && sorted_anew(&sparse), "{setting:?}");
        }
    }
}
