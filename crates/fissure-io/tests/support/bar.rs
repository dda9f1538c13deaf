//! A bar of concrete, 60 × 20 mm, weak in one row of cells, between two rigid grips.

use fissure_grid::{Grid, shape};
use fissure_materials::{Decohesive, Isotropic, Normal, Scale, softening};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Hold, Plane, Scene, Velocity};
use fissure_solvers::{Explicit, ExplicitSettings};
use nalgebra::Vector2;

const LENGTH: f64 = 0.06;
const WIDTH: f64 = 0.02;
const CELL: f64 = 0.01;
const RAMP: f64 = 1.8e-4;

/// Time, s, at which the crack has softened about half.
pub const HALF_BROKEN: f64 = 1.4e-3;

/// The bar and an elastic block that nothing touches, so that there are two laws.
pub fn scene(plane: Plane) -> Scene<2> {
    let elastic = Isotropic {
        density: 2350.0,
        young: 24.9e9,
        poisson: 0.18,
    };
    let concrete = Decohesive {
        elastic,
        strength: 2.7e6,
        toughness: 61.35,
        softening: softening::Linear,
        normal: Normal::Rankine,
    };
    let weak = Scale {
        strength: 0.9,
        ..Scale::default()
    };
    let spacing = Spacing(CELL / 2.0);
    let roller = Hold::Component(Vector2::x());
    let grip = |x: f64| Block::new([x, 0.0], [x + CELL, WIDTH]);
    let mut scene = Scene::plane(plane);
    scene
        .fill(
            "bar",
            concrete,
            &Block::new([0.0, 0.0], [LENGTH, WIDTH]),
            &spacing,
        )
        .unwrap()
        .fill(
            "block",
            elastic,
            &Block::new([0.0, 0.05], [0.02, 0.06]),
            &spacing,
        )
        .unwrap()
        .rigid("left", &grip(-CELL), &spacing, roller, Velocity(|_| 0.0))
        .unwrap()
        .rigid(
            "right",
            &grip(LENGTH),
            &spacing,
            roller,
            Velocity(|t: f64| 0.02 * (t / RAMP).min(1.0)),
        )
        .unwrap()
        .set_scale(
            "bar",
            |x| x[0] > LENGTH / 2.0 && x[0] < LENGTH / 2.0 + CELL,
            weak,
        )
        .unwrap()
        .set_velocity("block", |x| Vector2::new(0.3, -0.1 * x[0]))
        .unwrap();
    scene
}

pub fn solver(settings: ExplicitSettings) -> Explicit<shape::Linear, 2> {
    let grid = Grid::over([-0.04, -0.04], [LENGTH + 0.04, 0.1], CELL).unwrap();
    Explicit::new(grid, shape::Linear, settings).unwrap()
}
