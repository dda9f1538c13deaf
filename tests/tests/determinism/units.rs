//! Vector units that fuse multiply and add give the same bits, over whole runs.

use fissure::grid::simd::Simd;
use fissure_tests::bits;

use crate::fragments::{SETTINGS, advance, scene, solver_on};

#[test]
fn avx2_and_avx512_give_the_same_bits() {
    let [Some(avx2), Some(avx512)] = ["avx2", "avx512"].map(Simd::named) else {
        println!("not both on this machine: nothing to compare");
        return;
    };
    for setting in &SETTINGS {
        let [a, b] = [avx2, avx512].map(|simd| {
            let mut scene = scene(0.0);
            advance(&mut scene, &mut *solver_on(setting, 0.0, simd), 80);
            bits(&scene).unwrap()
        });
        assert!(a == b, "{setting:?}: the units differ");
    }
}
