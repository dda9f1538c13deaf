//! Time per polar decomposition: general, near the identity, plane, and from nalgebra's singular
//! value decomposition.

#![allow(clippy::print_stdout)]

#[path = "../tests/support/timing.rs"]
#[allow(dead_code)]
mod timing;

use fissure_tensor::{Matrix3, polar};
use timing::{median, nanoseconds_per_call};

fn main() {
    let gradients = |size: f64, plane: bool| -> Vec<Matrix3<f64>> {
        timing::tensors(1024, plane)
            .iter()
            .map(|a| {
                let h = a.to_matrix() * size;
                // Not symmetric: one shear is reversed.
                let h = Matrix3::new(
                    h.m11, -h.m12, h.m13, h.m21, h.m22, -h.m23, h.m31, h.m32, h.m33,
                );
                Matrix3::identity() + h
            })
            .collect()
    };
    let (general, near, plane) = (
        gradients(0.4, false),
        gradients(1e-3, false),
        gradients(0.4, true),
    );
    let mut samples: [Vec<f64>; 4] = Default::default();
    for _ in 0..41 {
        samples[0].push(nanoseconds_per_call(&general, polar));
        samples[1].push(nanoseconds_per_call(&near, polar));
        samples[2].push(nanoseconds_per_call(&plane, polar));
        samples[3].push(nanoseconds_per_call(&general, |f| f.svd(true, true)));
    }
    let names = [
        "polar",
        "polar near identity",
        "plane polar",
        "nalgebra svd",
    ];
    for (name, time) in names.iter().zip(samples.map(median)) {
        println!("{name:20} {time:8.1} ns/call");
    }
}
