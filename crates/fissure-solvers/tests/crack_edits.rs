//! Cracks as lines in explicit steps: what a user's edit of the velocities changes, and that a plate comes to the same rest
//! whichever way it went there.

#![allow(clippy::unwrap_used)]

use std::cell::Cell;

use fissure_grid::{Grid, shape};
use fissure_materials::Isotropic;
use fissure_particles::{Block, ParticleId, Spacing};
use fissure_scene::{CrackSettings, EndState, Plane, Scene, Solver};
use fissure_solvers::{Explicit, ExplicitSettings, StressUpdate, Transfer};
use nalgebra::{Vector2, vector};

const H: f64 = 0.01;
const WIDTH: f64 = 0.08;
const HEIGHT: f64 = 0.16;
const STRESS: f64 = 1e6;
/// s.
const PULSE: f64 = 1e-4;
const UPDATES: [StressUpdate; 3] = [StressUpdate::First, StressUpdate::Last, StressUpdate::Musl];

/// A plate with a crack from its side, `off` cells above a line of nodes, pulled by a load of `first` times what it is from
/// `until` (s) on.
fn scene(off: f64, first: f64, until: f64) -> Scene<2> {
    let steel = Isotropic {
        density: 7800.0,
        young: 207e9,
        poisson: 0.3,
    };
    let force = move |t: f64| {
        let times = if t < until { first } else { 1.0 };
        vector![0.0, STRESS * WIDTH * times]
    };
    let mouth = CrackSettings {
        first: EndState::Mouth,
        ..CrackSettings::default()
    };
    let block = Block::new([0.0, -HEIGHT], [WIDTH, HEIGHT]);
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene
        .fill("plate", steel, &block, &Spacing(0.5 * H))
        .unwrap()
        .crack("crack", &[[-H, off * H], [4.5 * H, off * H]], mouth)
        .unwrap()
        .force("top", "plate", |x| x.y > HEIGHT - 0.5 * H, force)
        .unwrap()
        .force(
            "bottom",
            "plate",
            |x| x.y < -HEIGHT + 0.5 * H,
            move |t| -force(t),
        )
        .unwrap();
    scene
}

fn solver(transfer: Transfer, stress_update: StressUpdate) -> Explicit<shape::Linear, 2> {
    let margin = 4.0 * H;
    let (low, high) = (
        [-margin, -HEIGHT - margin],
        [WIDTH + margin, HEIGHT + margin],
    );
    let settings = ExplicitSettings {
        transfer,
        stress_update,
        ..ExplicitSettings::default()
    };
    Explicit::new(Grid::over(low, high, H).unwrap(), shape::Linear, settings).unwrap()
}

/// Steps of one length, below the stable one: that is found from the velocities, and an edit asks for it anew.
fn steps(scene: &mut Scene<2>, solver: &mut dyn Solver<2>, count: usize) {
    const STEP: f64 = 5e-7;
    for _ in 0..count {
        let until = (scene.step() + 1) as f64 * STEP;
        assert_eq!(solver.step(scene, until).unwrap().time, until);
    }
}

fn rest(scene: &mut Scene<2>) {
    scene.set_velocity("plate", |_| Vector2::zeros()).unwrap();
}

/// Sets the velocities that there are.
fn same(scene: &mut Scene<2>) {
    let velocities = scene.bodies()[0].motion().velocity.to_vec();
    let next = Cell::new(0);
    let velocity = |_: &Vector2<f64>| velocities[next.replace(next.get() + 1)];
    scene.set_velocity("plate", velocity).unwrap();
}

/// Everything that steps change, by particle, and the jumps of the crack.
fn state(scene: &Scene<2>) -> (Vec<(ParticleId, Vec<f64>)>, Vec<f64>) {
    let body = &scene.bodies()[0];
    let motion = body.motion();
    let row = |i: usize| {
        let mut numbers = motion.position[i].as_slice().to_vec();
        numbers.extend(motion.velocity[i].iter());
        numbers.extend(motion.deformation_gradient[i].iter());
        numbers.extend(motion.stress[i].mandel);
        (body.particles().id[i], numbers)
    };
    let mut rows: Vec<_> = (0..body.particles().len()).map(row).collect();
    rows.sort_by_key(|(id, _)| *id);
    let crack = &scene.cracks()[0];
    let points = crack.line().points();
    let faces = points
        .iter()
        .flat_map(|x| [x.x, x.y, crack.face_at(x).1.x, crack.face_at(x).1.y]);
    (rows, faces.collect())
}

fn mouth_opening(scene: &Scene<2>) -> f64 {
    let crack = &scene.cracks()[0];
    crack.face_at(&vector![0.0, crack.line().points()[0].y]).1.y
}

/// An edit that changes nothing changes no bit of what follows: no step relies on what only the last one knew.
#[test]
fn the_same_velocities_give_the_same_bits() {
    for update in UPDATES {
        for transfer in [Transfer::Flip { pic: 0.01 }, Transfer::Xpic { order: 2 }] {
            let run = |edits: bool| {
                let (mut scene, mut solver) = (scene(0.3, 2.0, 5e-5), solver(transfer, update));
                for _ in 0..20 {
                    steps(&mut scene, &mut solver, 10);
                    if edits {
                        same(&mut scene);
                    }
                }
                state(&scene)
            };
            assert!(run(true) == run(false), "{update:?} {transfer:?}");
        }
    }
}

/// Put to rest on its way, a plate goes on as one that another solver finds in that state.
#[test]
fn from_rest_it_goes_on_as_a_new_run() {
    for update in UPDATES {
        let made = || solver(Transfer::Xpic { order: 2 }, update);
        let (mut first, mut solver) = (scene(0.3, 2.0, 5e-5), made());
        let (mut second, mut before) = (scene(0.3, 2.0, 5e-5), made());
        steps(&mut first, &mut solver, 150);
        steps(&mut second, &mut before, 150);
        let mut fresh = made();
        fresh.recall(&before.memory());
        rest(&mut first);
        rest(&mut second);
        steps(&mut first, &mut solver, 150);
        steps(&mut second, &mut fresh, 150);
        assert!(state(&first) == state(&second), "{update:?}");
    }
}

/// A plate at rest has no memory of the gradients that APIC carried.
#[test]
fn what_is_put_to_rest_stays_there() {
    let mut solver = solver(Transfer::Apic, StressUpdate::Last);
    let mut scene = scene(0.0, 0.0, 1.0);
    scene.set_velocity("plate", |x| vector![-x.y, x.x]).unwrap();
    steps(&mut scene, &mut solver, 1);
    let spinning = scene.energy().kinetic;
    rest(&mut scene);
    assert_eq!(scene.energy().kinetic, 0.0);
    steps(&mut scene, &mut solver, 1);
    let left = scene.energy().kinetic / spinning;
    assert!(left < 1e-5, "{left:e}");
}

/// How far the mouth is open and what is stored when all has come to rest, and the least opening before, after the pulse. From `damped` (s)
/// on velocities are set to zero wherever the kinetic energy has passed its largest: kinetic damping.
fn at_rest(mut scene: Scene<2>, update: StressUpdate, damped: f64) -> [f64; 3] {
    let mut solver = solver(Transfer::Xpic { order: 2 }, update);
    let (mut before, mut least) = (0.0, f64::INFINITY);
    while scene.time() < damped + 1.5e-3 {
        solver.step(&mut scene, f64::INFINITY).unwrap();
        let kinetic = scene.energy().kinetic;
        if scene.time() < damped {
            if scene.time() > PULSE {
                least = least.min(mouth_opening(&scene));
            }
        } else if kinetic < before {
            rest(&mut scene);
            before = 0.0;
        } else {
            before = kinetic;
        }
    }
    [mouth_opening(&scene), scene.energy().stored, least]
}

/// Equilibrium of an elastic plate knows no history: the crack that a pulse has thrown open and let shut is open as one that
/// never was. A crack along the nodes is on neither side of them but for round-off.
#[test]
fn a_crack_that_was_shut_opens_as_one_that_never_was() {
    for off in [0.0, 0.3] {
        let [opening, stored, _] = at_rest(scene(off, 1.0, 0.0), StressUpdate::Musl, 0.0);
        for update in UPDATES {
            let [swung, energy, least] = at_rest(scene(off, 6.0, PULSE), update, 1e-3);
            let errors = [swung / opening - 1.0, energy / stored - 1.0];
            println!("{off} {update:?}: {errors:?}, shut to {}", least / opening);
            assert!(least < 0.01 * opening, "it never shut: {least:e}");
            assert!(
                errors.iter().all(|e| e.abs() < 2e-3),
                "{update:?}, {off}: {errors:?}"
            );
        }
    }
}
