//! Every linear solver gives the same step; a failed step leaves the scene as it was; bits do not depend on
//! threads.

use fissure_scene::{SolveError, Solver};
use fissure_solvers::{
    ImplicitSettings, Integration, Iterative, LinearSolver, Method, NewtonStop, Preconditioning,
    Product,
};

use crate::bar::{difference, motion, period, run, scene, solver};

fn iterative(method: Method, product: Product, preconditioner: Preconditioning) -> LinearSolver {
    LinearSolver::Iterative(Iterative {
        method,
        product,
        preconditioner,
        ..Iterative::default()
    })
}

#[test]
fn every_linear_solver_gives_the_same_motion() {
    let settings = ImplicitSettings {
        step: 0.02 * period(),
        tolerance: 1e-10,
        ..ImplicitSettings::default()
    };
    let ring = |linear| {
        let mut scene = scene(1.0);
        let mut solver = solver(ImplicitSettings { linear, ..settings });
        run(&mut scene, &mut solver, 0.2 * period());
        scene
    };
    let reference = ring(LinearSolver::Direct);
    for method in [Method::Gmres, Method::ConjugateGradients] {
        for (product, preconditioner) in [
            (Product::Differences, Preconditioning::None),
            (Product::Differences, Preconditioning::Mass),
            (Product::Tangent, Preconditioning::Mass),
            (Product::Tangent, Preconditioning::NodeBlocks),
            (Product::Assembled, Preconditioning::None),
            (Product::Assembled, Preconditioning::Mass),
            (Product::Assembled, Preconditioning::NodeBlocks),
            (Product::Assembled, Preconditioning::Incomplete),
        ] {
            let scene = ring(iterative(method, product, preconditioner));
            let apart = difference(&scene, &reference, 1.0, 1.0);
            assert!(
                apart <= 1e-8,
                "{method:?} {product:?} {preconditioner:?}: {apart}"
            );
        }
    }
}

#[test]
fn pairs_that_do_not_go_together_are_refused() {
    for (product, preconditioner) in [
        (Product::Differences, Preconditioning::NodeBlocks),
        (Product::Differences, Preconditioning::Incomplete),
        (Product::Tangent, Preconditioning::Incomplete),
    ] {
        let settings = ImplicitSettings {
            linear: iterative(Method::Gmres, product, preconditioner),
            ..ImplicitSettings::default()
        };
        let made = fissure_solvers::Implicit::new(
            crate::bar::grid(),
            fissure_grid::shape::Linear,
            settings,
        );
        assert!(matches!(
            made,
            Err(SolveError::Setting {
                setting: "preconditioner",
                ..
            })
        ));
    }
    for settings in [
        ImplicitSettings {
            step: f64::NAN,
            ..ImplicitSettings::default()
        },
        ImplicitSettings {
            integration: Integration::Theta { weight: 1.1 },
            ..ImplicitSettings::default()
        },
        ImplicitSettings {
            integration: Integration::Newmark {
                beta: 0.25,
                gamma: 0.6,
            },
            ..ImplicitSettings::default()
        },
        ImplicitSettings {
            integration: Integration::GeneralizedAlpha {
                spectral_radius: f64::NAN,
            },
            ..ImplicitSettings::default()
        },
    ] {
        let made = fissure_solvers::Implicit::new(
            crate::bar::grid(),
            fissure_grid::shape::Linear,
            settings,
        );
        assert!(matches!(made, Err(SolveError::Setting { .. })));
    }
}

#[test]
fn a_failed_step_leaves_the_scene_as_it_was_and_says_why() {
    let mut scene = scene(1.0);
    let before = motion(&scene);
    let mut solver = solver(ImplicitSettings {
        step: period(),
        linear: LinearSolver::Iterative(Iterative {
            max_iterations: 1,
            preconditioner: Preconditioning::None,
            ..Iterative::default()
        }),
        max_iterations: 2,
        max_cuts: 1,
        ..ImplicitSettings::default()
    });
    let stopped = solver.step(&mut scene, f64::INFINITY);
    assert!(
        matches!(stopped, Err(SolveError::NoConvergence { cuts: 1, .. })),
        "{stopped:?}"
    );
    assert_eq!(solver.statistics().stop, Some(NewtonStop::Iterations));
    assert_eq!(motion(&scene), before);
    assert_eq!((scene.time(), scene.step()), (0.0, 0));
}

#[test]
fn bits_do_not_depend_on_threads() {
    for linear in [
        LinearSolver::Direct,
        iterative(Method::Gmres, Product::Tangent, Preconditioning::NodeBlocks),
        iterative(Method::Gmres, Product::Differences, Preconditioning::Mass),
        iterative(
            Method::ConjugateGradients,
            Product::Assembled,
            Preconditioning::Incomplete,
        ),
    ] {
        let ring = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| {
                let mut scene = scene(20.0);
                let settings = ImplicitSettings {
                    step: 0.05 * period(),
                    linear,
                    ..ImplicitSettings::default()
                };
                run(&mut scene, &mut solver(settings), 0.3 * period());
                motion(&scene)
            })
        };
        assert_eq!(ring(1), ring(3), "{linear:?}");
    }
}

/// A restart with the solver's memory goes on with the same bits.
#[test]
fn a_restarted_run_has_the_same_bits() {
    let settings = ImplicitSettings {
        step: 0.05 * period(),
        ..ImplicitSettings::default()
    };
    let (mut whole, mut first) = (scene(20.0), solver(settings));
    run(&mut whole, &mut first, 0.2 * period());
    let (saved, memory) = (whole.save().unwrap(), first.memory());
    run(&mut whole, &mut first, 0.5 * period());
    let (mut again, mut second) = (scene(20.0), solver(settings));
    again.restore(&saved).unwrap();
    second.recall(&memory);
    run(&mut again, &mut second, 0.5 * period());
    assert_eq!(motion(&whole), motion(&again));
    assert_eq!(whole.energy(), again.energy());
}
