//! D7: where the origin is does not matter.
//!
//! Positions are absolute, so bits can only stay where positions round alike: lengths are dyadic
//! and the shift stays between 4 and 8 m. Grid and bodies moved together by whole cells: the same
//! bits. By an arbitrary length: round-off of the positions, ε·offset/h, which fracture amplifies;
//! it is bounded before the bar cracks.

use fissure::prelude::*;
use fissure_tests::largest_difference;

use crate::fragments::{H, SETTINGS, Setting, advance, scene, softening, solver};

fn flown(setting: &Setting, offset: f64, steps: u64) -> Scene<2> {
    let mut scene = scene(offset);
    advance(&mut scene, &mut *solver(setting, offset), steps);
    scene
}

/// Columns of all bodies that should not depend on the origin.
fn columns(scene: &Scene<2>) -> (Vec<Vector2<f64>>, Vec<u64>) {
    let mut words = Vec::new();
    let mut velocities = Vec::new();
    for body in scene.bodies() {
        let motion = body.motion();
        velocities.extend_from_slice(motion.velocity);
        words.extend(body.particles().id.iter().map(|id| u64::from(id.0)));
        for row in 0..motion.velocity.len() {
            words.extend(motion.velocity[row].iter().map(|v| v.to_bits()));
            words.extend(motion.stress[row].mandel.iter().map(|v| v.to_bits()));
            words.extend(motion.deformation_gradient[row].iter().map(|v| v.to_bits()));
        }
    }
    words.push(scene.energy().dissipated.to_bits());
    (velocities, words)
}

#[test]
fn d7_whole_cells_give_the_same_bits() {
    for setting in &SETTINGS {
        let here = flown(setting, 0.0, 160);
        assert!(softening(&here) > 0, "{setting:?}");
        for cells in [1.0, 6.0] {
            let there = flown(setting, cells * H, 160);
            let same = columns(&here).1 == columns(&there).1;
            assert!(same, "{setting:?}: {cells} cells on");
        }
    }
}

#[test]
fn d7_any_offset_gives_the_same_to_round_off() {
    for setting in &SETTINGS {
        let here = flown(setting, 0.0, 20);
        for offset in [0.3, 100.0 / 3.0] {
            let there = flown(setting, offset, 20);
            let error = largest_difference(&columns(&here).0, &columns(&there).0) / 8.0;
            let bound = 2e2 * f64::EPSILON * (8.0 + offset) / H;
            println!("{setting:?} {offset}: {error:.1e} of {bound:.1e}");
            assert!(error <= bound, "{setting:?}: {error:e} at {offset} m");
        }
    }
}
