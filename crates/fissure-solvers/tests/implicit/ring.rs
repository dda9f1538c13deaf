//! Implicit steps in axisymmetry: a thin ring breathes at `ω = √(E/ρ)/r`.

use std::f64::consts::PI;

use fissure_grid::{Grid, shape};
use fissure_materials::Isotropic;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Scene, Solver};
use fissure_solvers::{Implicit, ImplicitSettings, Integration};
use nalgebra::vector;

const H: f64 = 0.025;
const LAW: Isotropic = Isotropic {
    density: 1000.0,
    young: 1e6,
    poisson: 0.3,
};

#[test]
fn a_thin_ring_breathes_at_its_frequency() {
    let omega = (LAW.young / LAW.density).sqrt();
    for integration in [
        Integration::GeneralizedAlpha {
            spectral_radius: 0.8,
        },
        Integration::Theta { weight: 0.5 },
    ] {
        let mut scene = Scene::axisymmetric();
        let block = Block::new([1.0 - 1.5 * H, 0.0], [1.0 + 1.5 * H, 3.0 * H]);
        scene
            .fill("ring", LAW, &block, &Spacing(0.5 * H))
            .unwrap()
            .set_velocity("ring", |x| vector![1e-4 * omega * x[0], 0.0])
            .unwrap();
        let grid = Grid::over([1.0 - 5.5 * H, -4.0 * H], [1.0 + 5.5 * H, 7.0 * H], H).unwrap();
        let settings = ImplicitSettings {
            // A hundred a period: three times the explicit limit.
            step: 0.02 * PI / omega,
            integration,
            ..ImplicitSettings::default()
        };
        let mut solver = Implicit::new(grid, shape::Linear, settings).unwrap();
        let radial = |scene: &Scene<2>| {
            let velocity = scene.bodies()[0].motion().velocity;
            velocity.iter().map(|v| v[0]).sum::<f64>()
        };
        let (mut crossings, mut before) = (Vec::new(), radial(&scene));
        while scene.time() < 5.2 * PI / omega {
            let report = solver.step(&mut scene, f64::INFINITY).unwrap();
            let now = radial(&scene);
            if before * now < 0.0 {
                crossings.push(report.time - report.dt * now / (now - before));
            }
            before = now;
        }
        assert_eq!(crossings.len(), 5, "{integration:?}");
        let found = 4.0 * PI / (crossings[4] - crossings[0]) / omega;
        println!("{integration:?}: {found:.5} of the frequency");
        assert!((found - 1.0).abs() <= 5e-3, "{integration:?}: {found}");
    }
}
