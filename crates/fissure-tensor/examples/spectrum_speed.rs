//! Time per spectral decomposition: closed form, its plane branch, eigenvalues only, cyclic
//! Jacobi and nalgebra. Blocks of the contenders alternate and the medians are printed, so that
//! a busy machine disturbs all of them alike.

#![allow(clippy::print_stdout)]

#[path = "../tests/support/jacobi.rs"]
mod jacobi;
#[path = "../tests/support/timing.rs"]
mod timing;

use fissure_tensor::Sym;
use timing::{median, nanoseconds_per_call};

fn main() {
    let general = timing::tensors(1024, false);
    let plane = timing::tensors(1024, true);
    let mut samples: [Vec<f64>; 6] = Default::default();
    for _ in 0..41 {
        samples[0].push(nanoseconds_per_call(&general, Sym::spectrum));
        samples[1].push(nanoseconds_per_call(&general, Sym::eigenvalues));
        samples[2].push(nanoseconds_per_call(&plane, Sym::spectrum));
        samples[3].push(nanoseconds_per_call(&plane, Sym::eigenvalues));
        samples[4].push(nanoseconds_per_call(&general, jacobi::jacobi));
        samples[5].push(nanoseconds_per_call(&general, |a| {
            a.to_matrix().symmetric_eigen()
        }));
    }
    let times = samples.map(median);
    let names = [
        "spectrum",
        "eigenvalues only",
        "plane spectrum",
        "plane eigenvalues",
        "Jacobi",
        "nalgebra symmetric_eigen",
    ];
    println!("{:26} {:>9} {:>18}", "", "ns/call", "nalgebra over this");
    for (name, time) in names.iter().zip(times) {
        println!("{name:26} {time:9.1} {:18.2}", times[5] / time);
    }
}
