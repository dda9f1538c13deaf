//! Errors of J and K on exact fields put on particles: the tables of `docs/fracture-diagnostics.md`.

#![allow(clippy::print_stdout)]

#[path = "../tests/exact/mod.rs"]
mod exact;

use std::error::Error;
use std::f64::consts::PI;

use exact::{GLASS, Lattice, griffith, williams};
use fissure_diagnostics::MeasureError;
use fissure_diagnostics::fracture::{
    Annulus, TipField, TipFrame, contours, interaction, j_integral,
};
use fissure_scene::Polyline;
use fissure_tensor::Matrix3;

/// K_I, K_II and J relative to the exact ones of these intensities.
fn errors(
    field: &TipField,
    frame: &TipFrame,
    ring: &Annulus,
    k: [f64; 2],
) -> Result<[f64; 3], MeasureError> {
    let found = interaction(field, frame, ring, &GLASS)?;
    let j = j_integral(field, frame, ring)?;
    Ok([
        (found.k1 / k[0] - 1.0).abs(),
        (found.k2 / k[1] - 1.0).abs(),
        (j / GLASS.energy_release(k[0], k[1]) - 1.0).abs(),
    ])
}

fn worst(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0].max(b[0]), a[1].max(b[1]), a[2].max(b[2])]
}

fn main() -> Result<(), Box<dyn Error>> {
    domains()?;
    refinement()?;
    noise()
}

/// Singular fields with a T-stress: what a domain of so many cells gives.
fn domains() -> Result<(), Box<dyn Error>> {
    let (k, h) = ([1.2e3, -0.5e3], 1e-3);
    let exact = williams(GLASS, k, 2e3);
    println!("mixed mode with T-stress, worst of 12 places and angles of the lattice");
    println!(
        "{:>6} {:>6} {:>9} {:>9} {:>9}   lattice along the crack",
        "r1/h", "r2/h", "K_I", "K_II", "J"
    );
    for (inner, outer) in [
        (0.0, 3.0),
        (1.0, 3.0),
        (1.0, 4.0),
        (2.0, 4.0),
        (2.0, 6.0),
        (3.0, 8.0),
        (4.0, 12.0),
        (8.0, 24.0),
    ] {
        let ring = Annulus {
            inner: inner * h,
            outer: outer * h,
        };
        let (mut aligned, mut turned) = ([0.0; 3], [0.0; 3]);
        for tip in [0.0, 0.2, 0.25, 0.4] {
            for angle in [0.0, 0.3, 0.6] {
                let lattice = Lattice {
                    tip,
                    angle,
                    ..Lattice::new(h, outer * h)
                };
                let found = errors(&lattice.field(&GLASS, &exact), &lattice.frame(), &ring, k)?;
                let into = if angle == 0.0 {
                    &mut aligned
                } else {
                    &mut turned
                };
                *into = worst(*into, found);
            }
        }
        for (errors, name) in [(aligned, "yes"), (turned, "no, at 17 and 34 degrees")] {
            let [k1, k2, j] = errors;
            println!("{inner:6} {outer:6} {k1:9.1e} {k2:9.1e} {j:9.1e}   {name}");
        }
    }
    Ok(())
}

/// Griffith's crack under tension and shear: refinement at domains that are parts of the crack.
fn refinement() -> Result<(), Box<dyn Error>> {
    let (a, sigma, tau) = (0.025, 1e4, 0.5e4);
    let exact = griffith(GLASS, a, sigma, tau);
    let k = [sigma, tau].map(|s| s * (PI * a).sqrt());
    let rings = [(0.05, 0.25), (0.1, 0.3), (0.1, 0.4), (0.15, 0.5)];
    let rings = rings.map(|(i, o)| Annulus {
        inner: i * a,
        outer: o * a,
    });
    println!("\nGriffith crack, tension and shear: worst of 4 domains and 3 places of the tip");
    println!(
        "{:>6} {:>9} {:>9} {:>9} {:>12}",
        "a/h", "K_I", "K_II", "J", "spread of J"
    );
    for cells in [12.5, 25.0, 50.0, 100.0, 200.0] {
        let (mut found, mut spread) = ([0.0; 3], 0.0f64);
        for tip in [0.0, 0.25, 0.4] {
            let lattice = Lattice {
                tip,
                ..Lattice::new(a / cells, 0.55 * a)
            };
            let (field, frame) = (lattice.field(&GLASS, &exact), lattice.frame());
            for ring in &rings {
                found = worst(found, errors(&field, &frame, ring, k)?);
            }
            spread = spread.max(contours(&field, &frame, &rings)?.spread);
        }
        let [k1, k2, j] = found;
        println!("{cells:6} {k1:9.1e} {k2:9.1e} {j:9.1e} {spread:12.1e}");
    }
    Ok(())
}

/// What noise on the particles does, and what averages over cells make of it.
fn noise() -> Result<(), Box<dyn Error>> {
    let (k, h) = ([1.2e3, -0.5e3], 1e-3);
    let exact = williams(GLASS, k, 2e3);
    let ring = Annulus {
        inner: 2.0 * h,
        outer: 6.0 * h,
    };
    let lattice = Lattice::new(h, 6.0 * h);
    let (clean, frame) = (lattice.field(&GLASS, &exact), lattice.frame());
    println!("\n20 % noise on the strains of particles, domain 2 h to 6 h: worst of 10 draws");
    println!("{:>34} {:>9} {:>9} {:>9}", "", "K_I", "K_II", "J");
    let mut state = 1u64;
    let mut draw = move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as f64 / (1u64 << 30) as f64 - 1.0
    };
    let (mut random, mut averaged) = ([0.0; 3], [0.0; 3]);
    for _ in 0..10 {
        let noisy = scaled(&clean, |_| 1.0 + 0.2 * 3f64.sqrt() * draw());
        random = worst(random, errors(&noisy, &frame, &ring, k)?);
        averaged = worst(
            averaged,
            errors(&cell_means(&noisy, &frame, h)?, &frame, &ring, k)?,
        );
    }
    // In a cell, left up and right down: what a mode that the nodes do not feel looks like.
    let odd = |x: f64| {
        if (2.0 * x / h).floor().rem_euclid(2.0) == 0.0 {
            1.0
        } else {
            -1.0
        }
    };
    let checked = scaled(&clean, |i| {
        let x = clean.samples[i].position - frame.position;
        1.0 + 0.2 * odd(x.x) * odd(x.y)
    });
    for (name, found) in [
        ("random", random),
        ("random, means over cells", averaged),
        ("checkerboard", errors(&checked, &frame, &ring, k)?),
        (
            "checkerboard, means over cells",
            errors(&cell_means(&checked, &frame, h)?, &frame, &ring, k)?,
        ),
        ("none", errors(&clean, &frame, &ring, k)?),
        (
            "none, means over cells",
            errors(&cell_means(&clean, &frame, h)?, &frame, &ring, k)?,
        ),
    ] {
        let [k1, k2, j] = found;
        println!("{name:>34} {k1:9.1e} {k2:9.1e} {j:9.1e}");
    }
    Ok(())
}

/// Stress and strain of each particle times a factor.
fn scaled(field: &TipField, mut factor: impl FnMut(usize) -> f64) -> TipField {
    let mut field = field.clone();
    for (i, sample) in field.samples.iter_mut().enumerate() {
        let factor = factor(i);
        sample.stress = sample.stress * factor;
        sample.deformation_gradient =
            Matrix3::identity() + (sample.deformation_gradient - Matrix3::identity()) * factor;
        sample.stored *= factor * factor;
    }
    field
}

/// The means over the cells of the lattice.
fn cell_means(field: &TipField, frame: &TipFrame, h: f64) -> Result<TipField, Box<dyn Error>> {
    let tip = frame.position;
    let crack = Polyline::new(vec![tip - frame.direction, tip])?;
    Ok(field.averaged(&tip, h, &crack, &GLASS)?)
}
