//! D10: θ with weight 0 is the explicit step.

use fissure_grid::shape;
use fissure_scene::Solver;
use fissure_solvers::{
    Explicit, ExplicitSettings, ImplicitSettings, Integration, Iterative, LinearSolver, Method,
    Preconditioning, Product, StressUpdate,
};

use crate::bar::{difference, grid, scene, solver};

#[test]
fn d10_weight_0_is_the_explicit_step() {
    let settings = ExplicitSettings {
        stress_update: StressUpdate::Last,
        ..ExplicitSettings::default()
    };
    let mut explicit = Explicit::new(grid(), shape::Linear, settings).unwrap();
    let by_differences = LinearSolver::Iterative(Iterative {
        method: Method::Gmres,
        product: Product::Differences,
        preconditioner: Preconditioning::Mass,
        ..Iterative::default()
    });
    for linear in [LinearSolver::Direct, by_differences] {
        let (mut one, mut other) = (scene(1.0), scene(1.0));
        let energy = one.bodies()[0].kinetic_energy();
        for step in 1..=20 {
            let report = explicit.step(&mut one, f64::INFINITY).unwrap();
            let mut implicit = solver(ImplicitSettings {
                step: report.dt,
                integration: Integration::Theta { weight: 0.0 },
                linear,
                tolerance: 1e-12,
                ..ImplicitSettings::default()
            });
            let same = implicit.step(&mut other, f64::INFINITY).unwrap();
            assert_eq!(same.time, report.time);
            let energies = [
                (same.energy.external, report.energy.external),
                (
                    same.energy.internal,
                    report.energy.internal + report.energy.staggering,
                ),
                (
                    same.energy.kinetic_grid_start,
                    report.energy.kinetic_grid_start,
                ),
                (same.energy.kinetic_grid_end, report.energy.kinetic_grid_end),
                (
                    same.energy.kinetic_particles,
                    report.energy.kinetic_particles,
                ),
                (same.energy.stored, report.energy.stored),
            ];
            for (a, b) in energies {
                assert!((a - b).abs() <= 1e-12 * energy, "{a} {b}");
            }
            let apart = difference(&one, &other, 1.0, 1.0);
            assert!(apart <= 1e-13 * f64::from(step), "{step}: {apart}");
            let force = report.reactions[0].norm() + 1.0;
            assert!((same.reactions[0] - report.reactions[0]).norm() <= 1e-11 * force);
        }
        explicit = Explicit::new(grid(), shape::Linear, settings).unwrap();
    }
}
