//! Implicit-explicit integration: softening without iterations, and what it costs.

use fissure_grid::{Grid, shape};
use fissure_materials::{Implex, Isotropic, RankineDamage, ScalarDamage, Scale, softening};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Constant, Hold, Plane, Scene, Solver};
use fissure_solvers::{QuasiStatic, QuasiStaticSettings};
use nalgebra::vector;

const SPACING: f64 = 0.02;
const SECTION: f64 = 0.06 * 0.06;
const STRENGTH: f64 = 2.7e6;
const TOUGHNESS: f64 = 61.35;
const YOUNG: f64 = 24.9e9;

/// A bar with one weak cell; without Poisson's effect its curve is two straight lines.
fn bar(length: f64) -> Scene<2> {
    let law = ScalarDamage {
        elastic: Isotropic {
            density: 2350.0,
            young: YOUNG,
            poisson: 0.0,
        },
        evolution: RankineDamage {
            strength: 10.0 * STRENGTH,
            toughness: 100.0 * TOUGHNESS,
            softening: softening::Linear,
        },
    };
    let weak = Scale {
        strength: 0.1,
        toughness: 0.01,
        ..Scale::default()
    };
    let cell = (0.5 * length / SPACING).floor() * SPACING;
    let spacing = Spacing(0.5 * SPACING);
    let block = |from, to| Block::new([from, 0.0], [to, 0.06]);
    let mut scene = Scene::plane(Plane::Strain { thickness: 0.06 });
    scene
        .fill("bar", Implex(law), &block(0.0, length), &spacing)
        .unwrap()
        .set_scale("bar", |x| (cell..cell + SPACING).contains(&x[0]), weak)
        .unwrap();
    for (name, from, speed) in [("left", -SPACING, 0.0), ("right", length, 1.0)] {
        let hold = Hold::Component(vector![1.0, 0.0]);
        scene
            .rigid(
                name,
                &block(from, from + SPACING),
                &spacing,
                hold,
                Constant(speed),
            )
            .unwrap();
    }
    scene
}

/// Pulls a bar to 1.2 critical openings; errors of the load halfway down and of the energy, and the greatest gap over
/// the strength.
fn pulled(length: f64, steps: u32) -> (f64, f64, f64) {
    let mut scene = bar(length);
    let grid = Grid::over([-0.1, -0.1], [length + 0.1, 0.16], SPACING).unwrap();
    let critical = 2.0 * TOUGHNESS / STRENGTH;
    let peak = STRENGTH * length / YOUNG;
    let end = 1.2 * critical.max(peak);
    let settings = QuasiStaticSettings {
        step: end / f64::from(steps),
        max_cuts: 0,
        tolerance: 1e-6,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid, shape::Linear, settings).unwrap();
    let middle = 0.5 * (critical + peak);
    let (mut halfway, mut gap) = (f64::NAN, 0.0_f64);
    while scene.time() < end {
        let report = solver.step(&mut scene, end).unwrap();
        let solution = report.solution.unwrap();
        assert!(report.iterations <= 2, "{report:?}");
        assert_eq!(solution.negative_pivots, Some(0));
        if scene.time() <= middle {
            let load = report.reactions[1][0] / (SECTION * STRENGTH);
            let exact = (critical - scene.time()) / (critical - peak);
            halfway = (load - exact.min(scene.time() / peak)).abs();
        }
        let gaps = scene.bodies()[0].value("implex_gap").unwrap();
        gap = gaps.iter().fold(gap, |gap, g| gap.max(g / STRENGTH));
    }
    let spent = scene.energy().dissipated / (SECTION * TOUGHNESS);
    (halfway, (spent - 1.0).abs(), gap)
}

/// Every step is one linear system with a positive matrix; the error falls with the step, and the gap says how large
/// it is.
#[test]
fn a_softening_bar_takes_no_iterations() {
    let (coarse, fine) = (pulled(0.2, 400), pulled(0.2, 3200));
    let order = (coarse.2 / fine.2).log2() / 3.0;
    // Where in a step the crack starts changes the gap by a factor.
    assert!(order >= 0.7, "{coarse:?} {fine:?}");
    assert!(fine.2 <= 0.01, "{coarse:?} {fine:?}");
    for (load, energy, _) in [coarse, fine] {
        assert!(load <= 0.02 && energy <= 0.02, "{coarse:?} {fine:?}");
    }
}

/// A bar that snaps back is passed without a cut. What it holds beyond the toughness has nowhere to go in
/// equilibrium: the gap shows that the jump was not followed.
#[test]
fn a_snap_is_passed() {
    let (_, _, gap) = pulled(0.6, 800);
    assert!(gap >= 0.1, "{gap}");
}
