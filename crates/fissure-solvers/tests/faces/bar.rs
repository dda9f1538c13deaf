//! A bar that a cohesive line cuts in two follows the law, in equilibrium.

use fissure_grid::{Grid, shape};
use fissure_materials::{Cohesive, Isotropic, Jump, TractionSeparation, softening};
use fissure_particles::{Block, Spacing};
use fissure_scene::{CrackSettings, EndState, Hold, Plane, Scene, SceneError, Solver, Velocity};
use fissure_solvers::{Implicit, ImplicitSettings, QuasiStatic, QuasiStaticSettings};
use nalgebra::{Vector3, vector};

pub const H: f64 = 0.01;
pub const LENGTH: f64 = 8.0 * H;
pub const WIDTH: f64 = 2.0 * H;
pub const THICKNESS: f64 = 0.5;
pub const AREA: f64 = WIDTH * THICKNESS;
/// Of the bar that is cut aslant.
const BROAD: f64 = 8.0 * H;
const YOUNG: f64 = 1e10;
pub const LAW: TractionSeparation = TractionSeparation {
    strength: 1e6,
    toughness: 100.0,
    stiffness: 2e10,
    shear_weight: 0.7,
    softening: softening::Linear,
};

/// A bar with a line between these places a cell outside its lower and its upper side.
pub fn cut(young: f64, width: f64, [low, high]: [f64; 2]) -> Scene<2> {
    let mut scene = Scene::plane(Plane::Strain {
        thickness: THICKNESS,
    });
    let law = Isotropic {
        density: 1000.0,
        young,
        poisson: 0.0,
    };
    let ends = CrackSettings {
        first: EndState::Mouth,
        last: EndState::Mouth,
        ..CrackSettings::default()
    };
    let block = Block::new([0.0, 0.0], [LENGTH, width]);
    scene
        .fill("bar", law, &block, &Spacing(0.5 * H))
        .unwrap()
        .crack("cut", &[[low, -H], [high, width + H]], ends)
        .unwrap()
        .bond("cut", LAW, |_| true)
        .unwrap();
    scene
}

pub fn grid() -> Grid<2> {
    Grid::over([-6.0 * H, -6.0 * H], [LENGTH + 6.0 * H, BROAD + 6.0 * H], H).unwrap()
}

/// Opens to half of what the law bears, shuts again, presses a little, and opens until it has failed.
fn speed(t: f64) -> f64 {
    match t {
        t if t < 1.01 => 1e-4,
        t if t < 2.11 => -1e-4,
        _ => 1e-4,
    }
}

fn pulled(width: f64, ends: [f64; 2], mut see: impl FnMut(&Scene<2>, f64)) -> Scene<2> {
    let mut scene = cut(YOUNG, width, ends);
    let along = Hold::Component(vector![1.0, 0.0]);
    let across = Hold::Component(vector![0.0, 1.0]);
    let left = |x: &nalgebra::Vector2<f64>| x.x < 0.5 * H;
    let right = |x: &nalgebra::Vector2<f64>| x.x > LENGTH - 0.5 * H;
    scene
        .hold("left", "bar", left, along, Velocity(|_| 0.0))
        .unwrap()
        .hold("right", "bar", right, along, Velocity(speed))
        .unwrap()
        .hold("left, across", "bar", left, across, Velocity(|_| 0.0))
        .unwrap()
        .hold("right, across", "bar", right, across, Velocity(|_| 0.0))
        .unwrap();
    let settings = QuasiStaticSettings {
        step: 0.05,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid(), shape::Linear, settings).unwrap();
    let mut way = 0.0;
    while scene.time() < 4.6 {
        let before = scene.time();
        solver.step(&mut scene, 4.6).unwrap();
        way += speed(scene.time()) * (scene.time() - before);
        see(&scene, way);
    }
    scene
}

#[test]
fn load_unload_close_and_tear() {
    // In the middle of a cell, elsewhere in one.
    for x in [4.5 * H, 4.3 * H] {
        let (mut state, mut steps) = (Default::default(), 0);
        let scene = pulled(WIDTH, [x, x], |scene, way| {
            let load = scene.reaction("right").unwrap().x;
            let points = scene.cracks()[0].bonded();
            let area: f64 = points.iter().map(|point| point.area).sum();
            assert!((area / AREA - 1.0).abs() < 1e-3, "{area}");
            let open = points[0].jump.x.abs();
            // Faces that touch are held by contact.
            if open > 1e-9 && load > 0.0 {
                let jump = Jump::new(Vector3::new(open, 0.0, 0.0), Vector3::x());
                let found = LAW.update(&jump, &state).unwrap();
                state = found.state;
                let error = (load / AREA - found.traction.x).abs() / LAW.strength;
                assert!(error < 1e-3, "at {way:e} m: {error:e}");
                // Nodes at both ends of the first and of the last cell are held.
                let elastic = load / AREA / YOUNG * (LENGTH - 2.0 * H);
                assert!((open + elastic - way).abs() < 2e-8, "{open:e} {way:e}");
                steps += 1;
            }
        });
        assert!(steps > 60, "{steps}");
        let energy = scene.energy();
        let spent = energy.dissipated / (LAW.toughness * AREA);
        let imbalance = energy.imbalance() / energy.external;
        println!(
            "x/h = {:.1}: {spent:.6} of G_f A, imbalance {imbalance:.2e}",
            x / H
        );
        assert!((spent - 1.0).abs() < 1e-3, "{spent}");
        assert!(imbalance.abs() < 5e-3, "{energy:?}");
        assert!(
            (energy.external / energy.dissipated - 1.0).abs() < 5e-3,
            "{energy:?}"
        );
        assert!(energy.stored.abs() < 1e-6 * energy.dissipated, "{energy:?}");
        let points = scene.cracks()[0].bonded();
        let full = |spent: f64| (spent / LAW.toughness - 1.0).abs() < 1e-9;
        assert!(points.iter().all(|point| full(point.dissipated)));
    }
}

#[test]
fn aslant_it_follows_the_law_nearly() {
    // By 16°; the faces cannot slide, since both ends are held across.
    let (low, high) = (2.6 * H, 5.47 * H);
    let mut peak: f64 = 0.0;
    let scene = pulled(BROAD, [low, high], |scene, _| {
        peak = peak.max(scene.reaction("right").unwrap().x);
    });
    let slope: f64 = (high - low) / (BROAD + 2.0 * H);
    let area = BROAD * THICKNESS * slope.hypot(1.0);
    let points = scene.cracks()[0].bonded();
    let nodes: f64 = points.iter().map(|point| point.area).sum();
    let spent = scene.energy().dissipated / (LAW.toughness * area);
    // Of a jump along the bar: λ = w √(cos² + β² sin²), and the load is along it too.
    let effective = (1.0 + (LAW.shear_weight * slope).powi(2)).sqrt();
    let peak = peak / (LAW.strength * BROAD * THICKNESS * effective);
    println!(
        "aslant: areas {:.4}, energy {spent:.4}, peak {peak:.4}",
        nodes / area
    );
    assert!((nodes / area - 1.0).abs() < 0.04, "{nodes}");
    assert!((spent - 1.0).abs() < 0.04, "{spent}");
    assert!((peak - 1.0).abs() < 0.05, "{peak}");
}

#[test]
fn what_cannot_be_is_refused() {
    let mut scene = cut(YOUNG, WIDTH, [4.5 * H; 2]);
    let unknown = scene.bond("cot", LAW, |_| true);
    assert!(matches!(unknown, Err(SceneError::UnknownCrack { .. })));
    let brittle = TractionSeparation {
        toughness: f64::NAN,
        ..LAW
    };
    let refused = scene.bond("cut", brittle, |_| true);
    assert!(matches!(refused, Err(SceneError::Bond { .. })));
    let mut solver = Implicit::new(grid(), shape::Linear, ImplicitSettings::default()).unwrap();
    assert!(solver.step(&mut scene, 1.0).is_err());
}
