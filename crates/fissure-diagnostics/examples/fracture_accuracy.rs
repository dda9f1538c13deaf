//! Errors of J and K on exact fields put on particles: the table of `docs/fracture-diagnostics.md`.

#![allow(clippy::print_stdout)]

#[path = "../tests/exact/mod.rs"]
mod exact;

use exact::{GLASS, Lattice, griffith, williams};
use fissure_diagnostics::MeasureError;
use fissure_diagnostics::fracture::{Annulus, contours, interaction, j_integral};

fn main() -> Result<(), MeasureError> {
    let k = [1.2e6, -0.5e6];
    let j = GLASS.energy_release(k[0], k[1]);
    let mixed = williams(GLASS, k, 2e6);
    println!("mixed mode with T: outer radius and ring in cells, worst of 4 places of the tip");
    println!(
        "{:>8} {:>8} {:>10} {:>10} {:>10}",
        "inner/h", "outer/h", "K_I", "K_II", "J"
    );
    for (inner, outer) in [
        (0.0, 3.0),
        (1.0, 3.0),
        (1.0, 4.0),
        (2.0, 4.0),
        (2.0, 5.0),
        (2.0, 6.0),
        (3.0, 8.0),
        (4.0, 12.0),
    ] {
        let mut worst = [0.0f64; 3];
        for tip in [0.0, 0.2, 0.25, 0.4] {
            let h = 1e-3;
            let lattice = Lattice {
                tip,
                ..Lattice::new(h, outer * h)
            };
            let (field, frame) = (lattice.field(&GLASS, &mixed), lattice.frame());
            let ring = Annulus {
                inner: inner * h,
                outer: outer * h,
            };
            let found = interaction(&field, &frame, &ring, &GLASS)?;
            let errors = [
                (found.k1 / k[0] - 1.0).abs(),
                (found.k2 / k[1] - 1.0).abs(),
                (j_integral(&field, &frame, &ring)? / j - 1.0).abs(),
            ];
            for (w, e) in worst.iter_mut().zip(errors) {
                *w = w.max(e);
            }
        }
        println!(
            "{inner:8} {outer:8} {:10.2e} {:10.2e} {:10.2e}",
            worst[0], worst[1], worst[2]
        );
    }
    let a = 0.025;
    println!("Griffith crack, tension and shear, domain of a/20 to a/4");
    for cells in [25.0, 50.0, 100.0, 200.0] {
        let h = a / cells;
        let field = griffith(GLASS, a, 1e7, 0.5e7);
        let k = [1e7, 0.5e7].map(|s: f64| s * (std::f64::consts::PI * a).sqrt());
        for tip in [0.0, 0.25, 0.4] {
            let lattice = Lattice {
                tip,
                ..Lattice::new(h, 0.5 * a)
            };
            let (field, frame) = (lattice.field(&GLASS, &field), lattice.frame());
            let rings = [(0.05, 0.25), (0.1, 0.3), (0.1, 0.5), (0.2, 0.4)].map(|(i, o)| Annulus {
                inner: i * a,
                outer: o * a,
            });
            let found = interaction(&field, &frame, &rings[0], &GLASS)?;
            let j = contours(&field, &frame, &rings)?;
            println!(
                "a/h {cells:4} tip {tip:4}: K_I {:9.2e} K_II {:9.2e} J {:9.2e} spread {:9.2e}",
                found.k1 / k[0] - 1.0,
                found.k2 / k[1] - 1.0,
                j.j[0] / GLASS.energy_release(k[0], k[1]) - 1.0,
                j.spread
            );
        }
    }
    Ok(())
}
