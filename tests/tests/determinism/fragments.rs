//! The scene of these tests: a bar that is torn while it flies, and a ball that meets it.

use fissure::grid::simd::Simd;
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

/// Dyadic, as are all lengths below.
pub const H: f64 = 0.0625;

/// The setting of one run.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    pub shape: ShapeKind,
    pub transfer: Transfer,
    pub update: StressUpdate,
}

pub const SETTINGS: [Setting; 6] = [
    Setting {
        shape: ShapeKind::Linear,
        transfer: Transfer::Flip { pic: 0.0 },
        update: StressUpdate::Musl,
    },
    Setting {
        shape: ShapeKind::Gimp,
        transfer: Transfer::Flip { pic: 0.02 },
        update: StressUpdate::First,
    },
    Setting {
        shape: ShapeKind::Cpdi,
        transfer: Transfer::Xpic { order: 2 },
        update: StressUpdate::Musl,
    },
    Setting {
        shape: ShapeKind::Bspline2,
        transfer: Transfer::Apic,
        update: StressUpdate::Last,
    },
    Setting {
        shape: ShapeKind::Bspline2,
        transfer: Transfer::Mls,
        update: StressUpdate::Last,
    },
    Setting {
        shape: ShapeKind::Bspline3,
        transfer: Transfer::Fmpm { order: 2 },
        update: StressUpdate::Musl,
    },
];

/// A brittle bar pulled at one end, and a ball; everything shifted by `offset`.
pub fn scene(offset: f64) -> Scene<2> {
    scene_of(Table::scene(Space::Plane), brittle(), offset)
}

/// The bar's law.
pub fn brittle() -> Decohesive {
    Decohesive {
        elastic: rubber().elastic,
        strength: 2e4,
        toughness: 30.0,
        softening: softening::Linear,
        normal: Normal::Rankine,
    }
}

/// The same in an empty scene, with any law for the bar.
pub fn scene_of<M: Material>(mut scene: Scene<2>, brittle: M, offset: f64) -> Scene<2> {
    let at = |x: f64, y: f64| [x + offset, y + offset];
    scene
        .fill(
            "bar",
            brittle,
            &Block::new(at(5.0, 5.0), at(6.0, 5.25)),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .fill(
            "ball",
            rubber(),
            &Ball::new(at(5.5, 5.5), 0.1875),
            &Spacing(H / 2.0),
        )
        .unwrap()
        .rigid(
            "grip",
            &Block::new(at(5.0 - H, 5.0), at(5.0, 5.25)),
            &Spacing(H / 2.0),
            Hold::All(Vector2::new(-1.0, 0.25)),
            Velocity(|_| 3.0),
        )
        .unwrap()
        .set_velocity("bar", |_| Vector2::new(2.0, 0.0))
        .unwrap()
        .set_velocity("ball", |_| Vector2::new(1.0, -8.0))
        .unwrap()
        .set_scale(
            "bar",
            move |x| x[0] < 5.5 + offset,
            Scale {
                strength: 0.875,
                ..Default::default()
            },
        )
        .unwrap();
    scene
}

/// The solver on a grid shifted by `offset`.
pub fn solver(setting: &Setting, offset: f64) -> Box<dyn Solver<2>> {
    solver_on(setting, offset, Simd::widest())
}

/// The same on a vector unit.
pub fn solver_on(setting: &Setting, offset: f64, simd: Simd) -> Box<dyn Solver<2>> {
    let grid = Grid::over([4.0 + offset; 2], [7.0 + offset; 2], H).unwrap();
    let settings = ExplicitSettings {
        transfer: setting.transfer,
        stress_update: setting.update,
        cfl: 0.25,
        simd,
        ..Default::default()
    };
    Table::solver(setting.shape, grid, settings).unwrap()
}

/// Steps a scene.
pub fn advance(scene: &mut Scene<2>, solver: &mut dyn Solver<2>, steps: u64) {
    run(scene, solver, Until::Steps(steps), &mut []).unwrap();
}

/// Number of particles with a crack that has softened but not failed.
pub fn softening(scene: &Scene<2>) -> usize {
    let softened = scene.bodies()[0].value("softened").unwrap();
    softened.iter().filter(|s| **s > 0.0 && **s < 1.0).count()
}

/// Whether a body's particles are out of the order in which they were made.
pub fn sorted_anew(scene: &Scene<2>) -> bool {
    let sorted = |body: &Body<2>| body.particles().id.is_sorted();
    !scene.bodies().iter().all(sorted)
}
