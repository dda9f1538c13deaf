//! P22: 1, 2, 4 and 8 threads give the same bits.

use fissure_tests::bits;

use crate::fragments::{SETTINGS, Setting, advance, scene, softening, solver, sorted_anew};

fn on_threads(setting: &Setting, threads: usize) -> Vec<fissure::scene::Section> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.unwrap().install(|| {
        let mut scene = scene(0.0);
        let mut solver = solver(setting, 0.0);
        advance(&mut scene, &mut *solver, 160);
        // Not vacuous: cracks are open, and particles have changed tiles.
        assert!(
            softening(&scene) > 0,
            "{setting:?}: {} soften",
            softening(&scene)
        );
        assert!(
            scene.energy().dissipated > 0.0 && sorted_anew(&scene),
            "{setting:?}"
        );
        bits(&scene).unwrap()
    })
}

#[test]
fn p22_any_number_of_threads_gives_the_same_bits() {
    for setting in &SETTINGS {
        let one = on_threads(setting, 1);
        for threads in [2, 4, 8] {
            let same = on_threads(setting, threads) == one;
            assert!(same, "{setting:?}: {threads} threads differ from 1");
        }
    }
}
