//! A double cantilever beam with a law on the line ahead of its crack: the crack grows when J is the toughness.
//!
//! The loads P turn the arms' ends by θ, so that `J = Σ P θ/b` whatever the crack does (Paris and Paris 1988), and J is
//! the energy that the law has taken up at the end of the open crack.

use fissure_grid::{Grid, shape};
use fissure_materials::{Isotropic, TractionSeparation, softening};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Constant, CrackSettings, EndState, FacePoint, Hold, Plane, Scene, Solver};
use fissure_solvers::{QuasiStatic, QuasiStaticSettings};
use nalgebra::Vector2;

const H: f64 = 1e-3;
const ARM: f64 = 5.0 * H;
const LENGTH: f64 = 50.0 * H;
/// End of the open crack, in the middle between nodes.
const CRACK: f64 = 20.5 * H;
/// Modulus of the pads by which the arms are pulled, Pa: they hardly hold the arms' ends from turning.
const PAD: f64 = 0.7e9;
/// Of the grips, m/s.
const SPEED: f64 = 1e-4;
const LAW: TractionSeparation = TractionSeparation {
    strength: 20e6,
    toughness: 100.0,
    stiffness: 2e13,
    shear_weight: 1.0,
    softening: softening::Linear,
};

fn scene() -> Scene<2> {
    let law = Isotropic {
        density: 2500.0,
        young: 70e9,
        poisson: 0.0,
    };
    let mouths = CrackSettings {
        first: EndState::Mouth,
        last: EndState::Mouth,
        ..CrackSettings::default()
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let block = Block::new([0.0, -ARM], [LENGTH, ARM]);
    scene
        .fill("beam", law, &block, &Spacing(0.5 * H))
        .unwrap()
        .crack("line", &[[-H, 0.5 * H], [LENGTH + H, 0.5 * H]], mouths)
        .unwrap()
        .bond("line", LAW, |x| x.x > CRACK)
        .unwrap();
    for (name, sign) in [("upper", 1.0), ("lower", -1.0)] {
        let pad = Isotropic { young: PAD, ..law };
        let [low, high] = match sign {
            1.0 => [ARM, ARM + 3.0 * H],
            _ => [-ARM - 3.0 * H, -ARM],
        };
        let grip = move |x: &Vector2<f64>| sign * x.y > ARM + 2.5 * H;
        let up = Hold::Component(Vector2::y());
        scene
            .fill(
                &format!("{name} pad"),
                pad,
                &Block::new([0.0, low], [2.0 * H, high]),
                &Spacing(0.5 * H),
            )
            .unwrap()
            .hold(
                name,
                &format!("{name} pad"),
                grip,
                up,
                Constant(sign * SPEED),
            )
            .unwrap();
    }
    // The grips hold one another; this keeps the beam in its place.
    let far = |x: &Vector2<f64>| x.x > LENGTH - 0.5 * H;
    for (name, axis) in [("far, along", Vector2::x()), ("far, across", Vector2::y())] {
        scene
            .hold(name, "beam", far, Hold::Component(axis), Constant(0.0))
            .unwrap();
    }
    scene
}

/// How far an arm's end has turned, by the heights of its first columns of particles.
fn turned(scene: &Scene<2>, upper: bool) -> f64 {
    let position = scene.bodies()[0].motion().position;
    let mean = |from: f64, to: f64| {
        let own = |x: &&Vector2<f64>| (x.y > 0.5 * H) == upper && x.x >= from && x.x < to;
        let column: Vec<f64> = position.iter().filter(own).map(|x| x.y).collect();
        column.iter().sum::<f64>() / column.len() as f64
    };
    // Where the load is; the arm is all but straight here.
    (mean(0.0, H) - mean(H, 2.0 * H)) / H
}

/// Opening at the end of the open crack and what the law took there, by a straight line through the first two places.
fn at_the_end(points: &[FacePoint]) -> f64 {
    let opening = |x: f64| {
        let here = points
            .iter()
            .filter(|point| (point.place.x - x).abs() < 0.1 * H);
        let jumps: Vec<f64> = here.map(|point| point.jump.y).collect();
        jumps.iter().sum::<f64>() / jumps.len() as f64
    };
    1.5 * opening(21.0 * H) - 0.5 * opening(22.0 * H)
}

#[test]
fn a_crack_starts_when_j_is_the_toughness() {
    let mut scene = scene();
    let grid = Grid::over(
        [-4.0 * H, -ARM - 8.0 * H],
        [LENGTH + 4.0 * H, ARM + 8.0 * H],
        H,
    )
    .unwrap();
    let settings = QuasiStaticSettings {
        step: 0.025,
        tolerance: 1e-6,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid, shape::Linear, settings).unwrap();
    let critical = 2.0 * LAW.toughness / LAW.strength;
    let mut last = (0.0, 0.0);
    let at_onset = loop {
        solver.step(&mut scene, f64::INFINITY).unwrap();
        let work = |name, upper| scene.reaction(name).unwrap().y * turned(&scene, upper);
        let j = work("upper", true) + work("lower", false);
        let open = at_the_end(scene.cracks()[0].bonded());
        if open >= critical {
            let share = (critical - last.0) / (open - last.0);
            break last.1 + share * (j - last.1);
        }
        last = (open, j);
        assert!(scene.step() < 200, "{last:?}");
    };
    println!(
        "J at onset over the toughness: {:.4}, {} steps",
        at_onset / LAW.toughness,
        scene.step()
    );
    assert!((at_onset / LAW.toughness - 1.0).abs() < 0.03, "{at_onset}");
    let e = scene.energy();
    assert!((e.imbalance() / e.external).abs() < 0.01, "{e:?}");
}
