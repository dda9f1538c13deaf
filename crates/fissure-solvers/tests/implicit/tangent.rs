//! The assembled tangent is the derivative of the forces, and Newton's method converges as it should.

use fissure_grid::{Grid, shape};
use fissure_materials::NeoHookean;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Hold, Plane, Scene, Solver, Velocity};
use fissure_solvers::{
    Implicit, ImplicitSettings, Integration, Iterative, LinearSolver, NewtonStop, Preconditioning,
    Product,
};
use nalgebra::vector;

/// A rubber block that is pulled out by a tenth of its length a second and sheared.
fn rubber() -> Scene<2> {
    let law = NeoHookean {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let clamp = Hold::All(vector![1.0, 0.0]);
    scene
        .fill(
            "block",
            law,
            &Block::new([0.0, 0.0], [1.0, 0.5]),
            &Spacing(0.125),
        )
        .unwrap()
        .rigid(
            "left",
            &Block::new([-0.25, 0.0], [0.0, 0.5]),
            &Spacing(0.125),
            clamp,
            Velocity(|_| 0.0),
        )
        .unwrap();
    let push = Hold::All(vector![0.8, 0.6]);
    scene
        .rigid(
            "right",
            &Block::new([1.0, 0.0], [1.25, 0.5]),
            &Spacing(0.125),
            push,
            Velocity(|_| 0.5),
        )
        .unwrap();
    scene
}

fn settings(step: f64) -> ImplicitSettings {
    ImplicitSettings {
        step,
        integration: Integration::Theta { weight: 1.0 },
        tolerance: 1e-9,
        ..ImplicitSettings::default()
    }
}

fn solver(settings: ImplicitSettings) -> Implicit<shape::Linear, 2> {
    let grid = Grid::over([-1.0, -1.0], [2.0, 1.5], 0.25).unwrap();
    Implicit::new(grid, shape::Linear, settings).unwrap()
}

#[test]
fn newton_converges_quadratically_with_the_analytic_tangent() {
    let mut scene = rubber();
    let mut solver = solver(settings(0.2));
    for _ in 0..3 {
        solver.step(&mut scene, f64::INFINITY).unwrap();
        let statistics = solver.statistics();
        assert_eq!(statistics.stop, Some(NewtonStop::Converged));
        assert_eq!(statistics.cuts, 0);
        let residuals = &statistics.residuals;
        // Once it is near, r' <= C r^2 with one C; round-off ends it.
        let near = residuals[1..]
            .windows(2)
            .filter(|pair| pair[0] <= 1e-1 && pair[1] >= 1e-12);
        let constants: Vec<f64> = near.map(|pair| pair[1] / pair[0].powi(2)).collect();
        assert!(!constants.is_empty(), "{residuals:?}");
        assert!(constants.iter().all(|&c| c <= 2.0), "{residuals:?}");
    }
}

/// End to end: a step with products of the assembled matrix, of the law's tangent particle by particle and of
/// differences of the residual takes the same Newton iterates.
#[test]
fn the_assembled_jacobian_is_the_derivative_of_the_residual() {
    let step = |linear| {
        let mut scene = rubber();
        let mut solver = solver(ImplicitSettings {
            linear,
            ..settings(0.2)
        });
        solver.step(&mut scene, f64::INFINITY).unwrap();
        (solver.statistics().residuals.clone(), scene)
    };
    let (_, reference) = step(LinearSolver::Direct);
    let mut histories: Vec<Vec<f64>> = Vec::new();
    for product in [Product::Assembled, Product::Tangent, Product::Differences] {
        let (residuals, scene) = step(LinearSolver::Iterative(Iterative {
            product,
            preconditioner: Preconditioning::None,
            ..Iterative::default()
        }));
        let apart = crate::bar::difference(&scene, &reference, 1.0, 1.0);
        assert!(apart <= 1e-7, "{product:?}: {apart}");
        histories.push(residuals);
    }
    // The same iterates: to the truncation of a difference, 1e-8 of a spacing wide.
    for others in &histories[1..] {
        for (a, b) in histories[0].iter().zip(others).filter(|(a, _)| **a > 1e-6) {
            assert!((a / b - 1.0).abs() <= 1e-4, "{histories:?}");
        }
    }
}
