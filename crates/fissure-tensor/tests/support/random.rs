//! Random inputs shared by the tests.

#![allow(dead_code)]

use fissure_tensor::{Matrix3, Sym, Vector3, rotation};
use proptest::prelude::*;

/// A configuration with this many cases that writes no files.
pub fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Rotations about any axis.
pub fn turn() -> impl Strategy<Value = Matrix3<f64>> {
    (prop::array::uniform3(-1.0..1.0), -3.2..3.2)
        .prop_map(|(n, angle)| rotation(&Vector3::from(n), angle))
}

/// Tensors with components in `±1`.
pub fn tensor() -> impl Strategy<Value = Sym> {
    prop::array::uniform6(-1.0..1.0).prop_map(|c| Sym::new(c[0], c[1], c[2], c[3], c[4], c[5]))
}

/// Unit vectors.
pub fn direction() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-1.0..1.0)
        .prop_filter("long enough", |n| Vector3::from(*n).norm() > 0.1)
        .prop_map(|n| Vector3::from(n).normalize())
}

/// Numbers in `±1` from a fixed linear congruential sequence.
pub fn sequence(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
