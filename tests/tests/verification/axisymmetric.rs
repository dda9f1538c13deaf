//! Axisymmetric scenes are those of the full 2π, and hoops ring.

use std::f64::consts::PI;

use fissure::materials::Hencky;
use fissure::nalgebra;
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

const H: f64 = 0.025;

/// A ring about r = 1 m, of three by three cells.
fn ring(law: Hencky) -> Scene<2> {
    let mut scene = Table::scene(Space::Axisymmetric);
    let block = Block::new([1.0 - 1.5 * H, 0.0], [1.0 + 1.5 * H, 3.0 * H]);
    scene.fill("ring", law, &block, &Spacing(H / 2.0)).unwrap();
    scene
}

fn grid() -> Grid<2> {
    Grid::over([1.0 - 5.5 * H, -4.0 * H], [1.0 + 5.5 * H, 7.0 * H], H).unwrap()
}

#[test]
fn mass_and_volume_are_of_the_full_turn() {
    let scene = ring(rubber());
    let particles = scene.bodies()[0].particles();
    let volume = 2.0 * PI * (3.0 * H) * (3.0 * H);
    let error = particles.volume.iter().sum::<f64>() / volume - 1.0;
    assert!(error.abs() <= 1e-14, "{error:e}");
    let mass: f64 = particles.mass.iter().sum();
    let error = mass / (volume * rubber().density()) - 1.0;
    assert!(error.abs() <= 1e-14, "{error:e}");
}

/// A thin ring breathes at `ω = √(E/ρ)/r`, with `(1 + h²/12r²)`-like corrections below 1e-3.
#[test]
fn a_thin_ring_breathes_at_its_frequency() {
    for shape in ShapeKind::ALL {
        let law = rubber();
        let mut scene = ring(law);
        let omega = (law.elastic.young / law.elastic.density).sqrt();
        scene
            .set_velocity("ring", |x| vector![1e-4 * omega * x[0], 0.0])
            .unwrap();
        let settings = ExplicitSettings::default();
        let mut solver = Table::solver(shape, grid(), settings).unwrap();
        let radial = |scene: &Scene<2>| {
            let velocity = scene.bodies()[0].motion().velocity;
            velocity.iter().map(|v| v[0]).sum::<f64>()
        };
        let end = 5.2 * PI / omega;
        let (mut crossings, mut before) = (Vec::new(), radial(&scene));
        while scene.time() < end {
            let report = solver.step(&mut scene, end).unwrap();
            let now = radial(&scene);
            if before * now < 0.0 {
                crossings.push(scene.time() - report.dt * now / (now - before));
            }
            before = now;
        }
        assert!(
            crossings.len() == 5,
            "{shape:?}: {} crossings",
            crossings.len()
        );
        let found = 4.0 * PI / (crossings[4] - crossings[0]) / omega;
        println!("{shape:?}: {found:.5}");
        assert!((found - 1.0).abs() <= 5e-3, "{shape:?}: {found}");
    }
}
