//! The closed form is faster than nalgebra's iteration; the ratio is printed with `--nocapture`.

#[path = "support/timing.rs"]
mod timing;

use fissure_tensor::Sym;
use timing::{median, nanoseconds_per_call, tensors};

/// Blocks alternate, so that a busy machine disturbs both alike, and the median of the ratios is
/// taken; some 3.5 is usual, so that one leaves a wide margin.
#[test]
fn faster_than_nalgebra() {
    let (general, plane) = (tensors(512, false), tensors(512, true));
    let mut ratios = [Vec::new(), Vec::new()];
    for _ in 0..31 {
        let theirs = nanoseconds_per_call(&general, |a| a.to_matrix().symmetric_eigen());
        let ours = nanoseconds_per_call(&general, Sym::spectrum);
        let plane_ours = nanoseconds_per_call(&plane, Sym::spectrum);
        ratios[0].push(theirs / ours);
        ratios[1].push(theirs / plane_ours);
    }
    let [general, plane] = ratios.map(median);
    println!("nalgebra takes {general:.2} times as long, {plane:.1} times the plane branch");
    assert!(general > 1.0, "ratio {general}");
    assert!(plane > 1.0, "ratio {plane}");
}
