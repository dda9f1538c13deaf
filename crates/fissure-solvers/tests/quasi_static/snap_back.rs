//! The bar of Sanchez 2010, sec. 5.2, longer than its limit of 0.4331 m: it snaps back.

use fissure_grid::{Grid, shape};
use fissure_materials::{Decohesive, Isotropic, Normal, Scale, softening};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Hold, NewtonStop, Plane, Scene, SolveError, Solver, StepControl, Velocity};
use fissure_solvers::{LoadControl, QuasiStatic, QuasiStaticSettings};
use nalgebra::{SVector, Vector3, vector};

const SPACING: f64 = 0.02;
const SECTION: f64 = 0.06 * 0.06;
const STRENGTH: f64 = 2.7e6;
const TOUGHNESS: f64 = 61.35;
const MODULUS: f64 = 24.9e9 / (1.0 - 0.18 * 0.18);

fn grid(length: f64) -> Grid<2> {
    Grid::over([-0.1, -0.1], [length + 0.1, 0.16], SPACING).unwrap()
}

fn law() -> Decohesive {
    Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: 10.0 * STRENGTH,
        toughness: 100.0 * TOUGHNESS,
        softening: softening::Linear,
        normal: Normal::Prescribed(Vector3::x()),
    }
}

const WEAK: Scale = Scale {
    stiffness: 1.0,
    strength: 0.1,
    toughness: 0.01,
};

/// The cell in the middle.
fn weak(length: f64) -> impl Fn(&SVector<f64, 2>) -> bool {
    let cell = (0.5 * length / SPACING).floor() * SPACING;
    move |x| (cell..cell + SPACING).contains(&x[0])
}

fn block(from: f64, to: f64) -> Block<2> {
    Block::new([from, 0.0], [to, 0.06])
}

/// Only the cell in the middle can fail. The right grip moves by 1 m per second of load time.
fn bar(length: f64) -> Scene<2> {
    let along = Hold::Component(vector![1.0, 0.0]);
    let spacing = Spacing(0.5 * SPACING);
    let mut scene = Scene::plane(Plane::Strain { thickness: 0.06 });
    scene
        .fill("bar", law(), &block(0.0, length), &spacing)
        .unwrap()
        .set_scale("bar", weak(length), WEAK)
        .unwrap();
    for (name, from, speed) in [("left", -SPACING, 0.0), ("right", length, 1.0)] {
        let pull = Velocity(move |_| speed);
        scene
            .rigid(name, &block(from, from + SPACING), &spacing, along, pull)
            .unwrap();
    }
    scene
}

fn peak(length: f64) -> f64 {
    STRENGTH * length / MODULUS
}

fn solver(length: f64, control: LoadControl) -> QuasiStatic<shape::Linear, 2> {
    let settings = QuasiStaticSettings {
        step: peak(length) / 10.0,
        control,
        ..QuasiStaticSettings::default()
    };
    QuasiStatic::new(grid(length), shape::Linear, settings).unwrap()
}

const CONTROLS: [LoadControl; 2] = [
    LoadControl::ArcLength,
    LoadControl::Dissipation {
        energy: SECTION * TOUGHNESS / 20.0,
    },
];

/// Distance of a point, over peak elongation and load, from the exact curve.
fn distance(length: f64, x: f64, y: f64) -> f64 {
    let critical = 2.0 * TOUGHNESS / STRENGTH / peak(length);
    let corners = [[0.0, 0.0], [1.0, 1.0], [critical, 0.0], [10.0, 0.0]];
    let away = |ends: &[[f64; 2]]| {
        let [a, b] = [ends[0], ends[1]].map(|[x, y]| vector![x, y]);
        let (along, to) = (b - a, vector![x, y] - a);
        let share = (to.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        (to - along * share).norm()
    };
    corners.windows(2).map(away).fold(f64::INFINITY, f64::min)
}

/// Both controls follow the curve down the branch that displacement control cannot, where one direction is
/// unstable, to the end and beyond.
#[test]
fn a_bar_that_snaps_back_is_followed() {
    for length in [0.44, 0.6, 1.0] {
        for control in CONTROLS {
            let (mut scene, mut solver) = (bar(length), solver(length, control));
            let (mut worst, mut branch, mut turned) = (0.0_f64, 0, 0);
            let mut broken = 0;
            while broken < 3 {
                let report = solver.step(&mut scene, f64::INFINITY).unwrap();
                let solution = report.solution.unwrap();
                assert_eq!(solution.stop, NewtonStop::Converged);
                assert_eq!(solution.load_time, scene.load_time());
                let spent = scene.energy().dissipated / (SECTION * TOUGHNESS);
                let load = report.reactions[1][0] / (SECTION * STRENGTH);
                let away = distance(length, solution.load_time / peak(length), load);
                worst = worst.max(away);
                let open = spent > 0.0 && spent < 1.0 - 1e-3;
                if open {
                    branch += 1;
                    assert_eq!(solution.negative_pivots, Some(1), "{length} {spent}");
                    assert_ne!(solution.control, StepControl::Prescribed);
                }
                if solution.load_step < 0.0 {
                    turned += 1;
                }
                if spent > 1.0 - 1e-3 && solution.load_step > 0.0 {
                    broken += 1;
                    assert_eq!(solution.negative_pivots, Some(0), "{length}");
                    assert!(load.abs() <= 1e-2, "{load}");
                }
                assert!(scene.step() < 80, "{length} {control:?}");
            }
            assert!(worst <= 2e-3, "{length} {control:?}: {worst}");
            assert!(branch >= 3 && turned >= 3, "{length} {branch} {turned}");
            let spent = scene.energy().dissipated / (SECTION * TOUGHNESS);
            assert!((spent - 1.0).abs() <= 1e-3, "{length} {control:?}: {spent}");
        }
    }
}

/// Under a load the peak is a limit: beyond it the load falls, which an arc length follows.
#[test]
fn a_load_is_followed_past_its_limit() {
    let length = 0.2;
    let mut scene = bar(length);
    // A second bar of the same kind, pulled by a force instead of a grip, shows the same curve.
    let mut loaded = Scene::plane(Plane::Strain { thickness: 0.06 });
    loaded
        .fill("bar", law(), &block(0.0, length), &Spacing(0.5 * SPACING))
        .unwrap()
        .set_scale("bar", weak(length), WEAK)
        .unwrap()
        .rigid(
            "left",
            &block(-SPACING, 0.0),
            &Spacing(0.5 * SPACING),
            Hold::Component(vector![1.0, 0.0]),
            Velocity(|_| 0.0),
        )
        .unwrap()
        .force(
            "pull",
            "bar",
            move |x| x[0] > length - 0.5 * SPACING,
            |t| vector![t * SECTION * STRENGTH, 0.0],
        )
        .unwrap();
    let settings = QuasiStaticSettings {
        step: 0.1,
        control: LoadControl::ArcLength,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid(length), shape::Linear, settings).unwrap();
    let (mut highest, mut unstable) = (0.0_f64, 0);
    while loaded.energy().dissipated < 0.9 * SECTION * TOUGHNESS {
        let report = solver.step(&mut loaded, f64::INFINITY).unwrap();
        let solution = report.solution.unwrap();
        let load = -report.reactions[0][0] / (SECTION * STRENGTH);
        // What is held is the load that the path has found.
        assert!(
            (load - solution.load_time).abs() <= 1e-3,
            "{load} {solution:?}"
        );
        highest = highest.max(load);
        if solution.load_step < 0.0 {
            unstable += 1;
            // The crack opens, and the free half may turn about it.
            assert_eq!(solution.negative_pivots, Some(2));
        }
        assert!(loaded.step() < 80);
    }
    assert!(
        (highest - 1.0).abs() <= 0.1 && unstable >= 3,
        "{highest} {unstable}"
    );
    // Beside it the grip, which this bar of less than 0.4331 m lets pull it in equilibrium to the end.
    let settings = QuasiStaticSettings {
        step: peak(length) / 10.0,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid(length), shape::Linear, settings).unwrap();
    while scene.energy().dissipated < 0.9 * SECTION * TOUGHNESS {
        let report = solver.step(&mut scene, f64::INFINITY).unwrap();
        assert_eq!(report.solution.unwrap().negative_pivots, Some(0));
    }
}

/// Two cells that are equally weak may both open: in equilibrium, and unstable, which the pivots say. One that is weaker
/// opens alone, stably.
#[test]
fn a_branch_that_nature_leaves_has_negative_pivots() {
    let length = 0.2;
    let settings = QuasiStaticSettings {
        step: peak(length) / 20.0,
        ..QuasiStaticSettings::default()
    };
    for (imperfection, stable) in [(0.0, false), (0.1, true)] {
        let along = Hold::Component(vector![1.0, 0.0]);
        let spacing = Spacing(0.5 * SPACING);
        let mut scene = Scene::plane(Plane::Strain { thickness: 0.06 });
        let second = Scale {
            strength: WEAK.strength * (1.0 + imperfection),
            ..WEAK
        };
        scene
            .fill("bar", law(), &block(0.0, length), &spacing)
            .unwrap()
            .set_scale("bar", |x| (0.04..0.06).contains(&x[0]), WEAK)
            .unwrap()
            .set_scale("bar", |x| (0.14..0.16).contains(&x[0]), second)
            .unwrap();
        for (name, from, speed) in [("left", -SPACING, 0.0), ("right", length, 1.0)] {
            let pull = Velocity(move |_| speed);
            scene
                .rigid(name, &block(from, from + SPACING), &spacing, along, pull)
                .unwrap();
        }
        let mut solver = QuasiStatic::new(grid(length), shape::Linear, settings).unwrap();
        let mut pivots = None;
        while scene.energy().dissipated < 0.3 * SECTION * TOUGHNESS {
            let report = solver.step(&mut scene, f64::INFINITY).unwrap();
            pivots = report.solution.unwrap().negative_pivots;
        }
        assert_eq!(pivots == Some(0), stable, "{imperfection}: {pivots:?}");
    }
}

fn bytes(scene: &Scene<2>) -> Vec<Vec<u8>> {
    let sections = scene.save().unwrap();
    sections.into_iter().map(|section| section.bytes).collect()
}

/// A run that is interrupted on the branch ends with the same bits.
#[test]
fn a_restart_goes_on_along_the_path() {
    for control in CONTROLS {
        let length = 0.6;
        let (mut scene, mut first) = (bar(length), solver(length, control));
        for _ in 0..12 {
            first.step(&mut scene, f64::INFINITY).unwrap();
        }
        let mut again = bar(length);
        again.restore(&scene.save().unwrap()).unwrap();
        let mut second = solver(length, control);
        second.recall(&first.memory());
        assert_eq!(again.load_time(), scene.load_time());
        for _ in 0..3 {
            first.step(&mut scene, f64::INFINITY).unwrap();
            second.step(&mut again, f64::INFINITY).unwrap();
        }
        assert!(bytes(&scene) == bytes(&again), "{control:?}");
    }
}

/// A step that fails says why and changes nothing.
#[test]
fn a_failed_step_leaves_the_scene() {
    let length = 0.6;
    for control in CONTROLS {
        let mut scene = bar(length);
        let settings = QuasiStaticSettings {
            step: peak(length) / 10.0,
            control,
            // One correction leaves what strains and displacements of second order do.
            tolerance: 1e-12,
            max_iterations: 1,
            max_cuts: 1,
            ..QuasiStaticSettings::default()
        };
        let mut follow = solver(length, control);
        for _ in 0..12 {
            follow.step(&mut scene, f64::INFINITY).unwrap();
        }
        let mut strict = QuasiStatic::new(grid(length), shape::Linear, settings).unwrap();
        strict.recall(&follow.memory());
        let before = bytes(&scene);
        let stopped = strict.step(&mut scene, f64::INFINITY);
        let Err(SolveError::NoConvergence { cuts: 1, stop, .. }) = stopped else {
            panic!("{stopped:?}");
        };
        assert_ne!(stop, NewtonStop::Converged);
        assert_eq!(strict.statistics().stop.map(|_| ()), Some(()));
        assert!(bytes(&scene) == before);
    }
}

/// Prescribed steps through the snap, steadied by a viscous force whose work is what the snap sets free.
#[test]
fn a_viscous_force_books_what_a_snap_sets_free() {
    let length = 1.0;
    let mut scene = bar(length);
    let settings = QuasiStaticSettings {
        step: peak(length) / 100.0,
        stabilisation: 30.0,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid(length), shape::Linear, settings).unwrap();
    while scene.time() < 1.3 * peak(length) {
        solver.step(&mut scene, 1.3 * peak(length)).unwrap();
    }
    let energy = scene.energy();
    let broken = SECTION * TOUGHNESS;
    assert!((energy.dissipated / broken - 1.0).abs() <= 1e-3);
    // The bar holds P δ/2 at its peak, of which breaking takes the toughness.
    let held = 0.5 * SECTION * STRENGTH * peak(length);
    let freed = energy.stabilisation / (held - broken);
    assert!((freed - 1.0).abs() <= 0.1, "{freed}");
    let balance = energy.external - energy.internal - energy.stabilisation;
    assert!(
        balance.abs() <= 0.02 * energy.external,
        "{balance} {energy:?}"
    );
}

#[test]
fn settings_out_of_range_are_refused() {
    let refused = |settings| {
        let made = QuasiStatic::<_, 2>::new(grid(0.2), shape::Linear, settings);
        matches!(made, Err(SolveError::Setting { .. }))
    };
    for energy in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(QuasiStaticSettings {
            control: LoadControl::Dissipation { energy },
            ..QuasiStaticSettings::default()
        }));
    }
    for stabilisation in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(QuasiStaticSettings {
            stabilisation,
            ..QuasiStaticSettings::default()
        }));
    }
}
