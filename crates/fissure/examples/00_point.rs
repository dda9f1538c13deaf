//! A law at one material point: a crack opens, is unloaded, reloaded, fails, and shuts.
//!
//! New here: a law, a path, the point that follows it. No grid, no particles.
//! Read on: `01_bar`, where the same law breaks a bar.
#![allow(clippy::print_stdout)]

use fissure::prelude::*;

fn main() -> Result<(), Error> {
    // Concrete of Sanchez 2010, Table 5.1.
    let concrete = Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: 2.7e6,
        toughness: 61.35,
        softening: softening::Linear,
        normal: Normal::Rankine,
    };
    // A crack is smeared over the band: 10 mm here, the cell size in a simulation.
    let band = 0.01;
    // Uniaxial stress; strains of the stretch U − 1. `back` drives the same component elsewhere.
    let path = Path::new(Band::cube(band))
        .uniaxial(Axis::X, 2.0e-3, 200) // opens, beyond the peak
        .back(1.95e-3, 40) // unloads along the elastic line: the opening stays
        .back(6.0e-3, 400) // reloads, softens on, fails
        .back(0.0, 200); // shuts, and carries nothing on the way
    let samples = Point::new(&concrete)?.drive(&path)?;

    println!("  strain   stress/MPa   opening/µm   dissipated·L/G_f");
    for sample in samples.iter().skip(9).step_by(40) {
        println!(
            "{:8.5}   {:10.4}   {:10.3}   {:16.6}",
            sample.strain.xx(),
            sample.stress.xx() * 1e-6,
            sample.state.opening * 1e6,
            sample.dissipated * band / concrete.toughness
        );
    }
    if let Some(end) = samples.last() {
        let density = concrete.toughness / band;
        println!("energy per crack area over G_f:");
        println!("  dissipated {:.12}", end.dissipated / density);
        println!("  work       {:.12}", end.work / density);
        assert!((end.dissipated / density - 1.0).abs() < 1e-12);
    }
    Ok(())
}
