//! Cracks as discontinuities embedded in cells.

use fissure_grid::{Grid, shape};
use fissure_materials::{Isotropic, TractionSeparation, softening};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Hold, Plane, Scene, SolveError, Solver, Velocity};
use fissure_solvers::{EmbeddedCrack, EmbeddedForm, QuasiStatic, QuasiStaticSettings};
use nalgebra::{Vector2, Vector3, vector};

const H: f64 = 0.02;
const SIDE: f64 = 0.06;
const LENGTH: f64 = 0.2;
const STRENGTH: f64 = 2.7e6;
const TOUGHNESS: f64 = 61.35;
const CRITICAL: f64 = 2.0 * TOUGHNESS / STRENGTH;

const ELASTIC: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};

fn crack(angle: f64, form: EmbeddedForm, strength: f64) -> EmbeddedCrack {
    EmbeddedCrack {
        point: [0.5 * LENGTH, 0.5 * SIDE],
        normal: [angle.cos(), angle.sin()],
        law: TractionSeparation {
            strength,
            toughness: TOUGHNESS * strength / STRENGTH,
            stiffness: 200.0 * ELASTIC.young / H * strength / STRENGTH,
            shear_weight: 1.0,
            softening: softening::Linear,
        },
        form,
    }
}

/// A bar along x whose grips pull it apart along a direction, at 1 m/s.
fn bar(direction: Vector2<f64>) -> Scene<2> {
    let spacing = Spacing(0.5 * H);
    let mut scene = Scene::plane(Plane::Strain { thickness: SIDE });
    scene
        .fill(
            "bar",
            ELASTIC,
            &Block::new([0.0, 0.0], [LENGTH, SIDE]),
            &spacing,
        )
        .unwrap();
    for (name, from, speed) in [("left", -2.0 * H, 0.0), ("right", LENGTH, 1.0)] {
        let grip = Block::new([from, 0.0], [from + 2.0 * H, SIDE]);
        let hold = if direction.y == 0.0 {
            Hold::Component(direction)
        } else {
            Hold::All(direction)
        };
        scene
            .rigid(name, &grip, &spacing, hold, Velocity(move |_| speed))
            .unwrap();
    }
    scene
}

fn solver(step: f64) -> QuasiStatic<shape::Linear, 2> {
    let grid = Grid::over([-0.1, -0.1], [0.3, 0.16], H).unwrap();
    let settings = QuasiStaticSettings {
        step,
        ..QuasiStaticSettings::default()
    };
    QuasiStatic::new(grid, shape::Linear, settings).unwrap()
}

/// An aligned bar follows the exact curve of Sanchez 2010, eqs 5.2.13-5.2.14, in either form.
#[test]
fn an_aligned_bar_follows_the_exact_curve() {
    for form in [EmbeddedForm::Optimal, EmbeddedForm::Local(ELASTIC)] {
        let mut scene = bar(vector![1.0, 0.0]);
        let steps = 40;
        let end = 1.1 * CRITICAL;
        let step = end / f64::from(steps);
        let mut solver = solver(step)
            .with_embedded(crack(0.0, form, STRENGTH))
            .unwrap();
        let modulus = ELASTIC.young / (1.0 - ELASTIC.poisson * ELASTIC.poisson);
        let area = SIDE * SIDE;
        for number in 1..=steps {
            solver.step(&mut scene, step * f64::from(number)).unwrap();
            let pull = scene.time();
            let exact = if pull < STRENGTH * LENGTH / modulus {
                area * modulus * pull / LENGTH
            } else {
                let slope = LENGTH - modulus * CRITICAL / STRENGTH;
                (area * modulus * (pull - CRITICAL) / slope).max(0.0)
            };
            let load = scene.reaction("right").unwrap()[0];
            let error = (load - exact).abs() / (area * STRENGTH);
            assert!(error <= 3e-3, "{form:?} at {pull}: {load} for {exact}");
        }
        let spent = scene.energy().dissipated / (area * TOUGHNESS);
        // The section is that of the strained bar.
        assert!((spent - 1.0).abs() <= 1e-4, "{form:?}: {spent}");
        let section: f64 = solver.embedded_jumps().iter().map(|cell| cell.area).sum();
        assert!((section / area - 1.0).abs() <= 1e-4);
    }
}

/// Halves that move apart without strain strain no particle, however the crack crosses the cells: with a crack that
/// has a thousandth of the strength, no more than that is left of the stress.
#[test]
fn halves_move_apart_without_stress() {
    for degrees in [5.0_f64, 20.0, 30.0, 45.0] {
        let angle = degrees.to_radians();
        let (sin, cos) = angle.sin_cos();
        let mut scene = bar(vector![cos, sin]);
        let weak = crack(angle, EmbeddedForm::Optimal, 1e-3 * STRENGTH);
        let grid = Grid::over([-0.1, -0.1], [0.3, 0.16], H).unwrap();
        let settings = QuasiStaticSettings {
            step: 0.5 * CRITICAL,
            tolerance: 1e-5,
            ..QuasiStaticSettings::default()
        };
        let solver = QuasiStatic::new(grid, shape::Linear, settings).unwrap();
        let mut solver = solver.with_embedded(weak).unwrap();
        let report = solver.step(&mut scene, 0.5 * CRITICAL).unwrap();
        assert!(report.iterations <= 12, "{:?}", solver.statistics());
        let normal = Vector3::new(cos, sin, 0.0);
        for stress in scene.bodies()[0].motion().stress {
            let left = stress.traction(&normal).norm() / STRENGTH;
            assert!(left <= 1e-2, "{degrees}°: {left}");
        }
        for cell in solver.embedded_jumps() {
            let jump = Vector2::from(cell.jump) - Vector2::new(cos, sin) * (0.5 * CRITICAL);
            assert!(jump.norm() <= 1e-2 * CRITICAL, "{degrees}°: {cell:?}");
        }
    }
}

#[test]
fn a_restarted_run_has_the_same_bits() {
    let form = EmbeddedForm::Optimal;
    let make = || {
        solver(0.1 * CRITICAL)
            .with_embedded(crack(0.3, form, STRENGTH))
            .unwrap()
    };
    let direction = vector![0.3_f64.cos(), 0.3_f64.sin()];
    let run = |restart: bool| {
        let mut scene = bar(direction);
        let mut solver = make();
        for step in 1..=8 {
            if restart && step == 6 {
                let mut again = bar(direction);
                again.restore(&scene.save().unwrap()).unwrap();
                let memory = solver.memory();
                solver = make();
                solver.recall(&memory);
                scene = again;
            }
            solver
                .step(&mut scene, 0.1 * CRITICAL * f64::from(step))
                .unwrap();
        }
        (
            scene.energy().dissipated,
            scene.bodies()[0].motion().position.to_vec(),
        )
    };
    let whole = run(false);
    assert!(whole.0 > 0.0);
    assert_eq!(whole, run(true));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let good = crack(0.0, EmbeddedForm::Optimal, STRENGTH);
    let flat = EmbeddedCrack {
        normal: [0.0, 0.0],
        ..good
    };
    let mut soft = good;
    soft.law.stiffness = 0.0;
    for bad in [flat, soft] {
        assert!(solver(1.0).with_embedded(bad).is_err());
    }
    let settings = QuasiStaticSettings {
        averaging: fissure_solvers::Averaging::Volume,
        ..QuasiStaticSettings::default()
    };
    let grid = Grid::over([-0.1, -0.1], [0.3, 0.16], H).unwrap();
    let averaging = QuasiStatic::new(grid, shape::Linear, settings).unwrap();
    let mut averaging = averaging.with_embedded(good).unwrap();
    let refused = averaging.step(&mut bar(vector![1.0, 0.0]), 1.0);
    assert!(matches!(refused, Err(SolveError::Unsupported { .. })));
}
