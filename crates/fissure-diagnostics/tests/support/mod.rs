//! The bar of the tests: 60 × 20 mm of concrete between two rigid grips, weak in one row of cells.
#![allow(dead_code, reason = "each test binary uses a part")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are tests")]

use fissure_diagnostics::EnergyHistory;
use fissure_grid::{Grid, shape};
use fissure_materials::{Decohesive, Isotropic, Normal, Scale, softening};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Hold, Plane, Scene, Until, Velocity, run};
use fissure_solvers::{Explicit, ExplicitSettings};
use fissure_tensor::Vector3;
use nalgebra::Vector2;

pub struct Bar {
    pub length: f64,
    pub width: f64,
    pub thickness: f64,
    pub cell: f64,
    pub strength: f64,
    pub toughness: f64,
    /// Final speed of the right grip, m/s.
    pub speed: f64,
}

impl Default for Bar {
    fn default() -> Self {
        Self {
            length: 0.06,
            width: 0.02,
            thickness: 0.05,
            cell: 0.01,
            strength: 2.7e6,
            toughness: 61.35,
            speed: 0.02,
        }
    }
}

impl Bar {
    pub const WEAKNESS: f64 = 0.9;

    /// Opening at which the weak row carries nothing, m.
    pub fn critical_opening(&self) -> f64 {
        2.0 * self.toughness / (Self::WEAKNESS * self.strength)
    }

    /// Energy of a crack across the bar, J.
    pub fn fracture_energy(&self) -> f64 {
        self.toughness * self.area()
    }

    pub fn area(&self) -> f64 {
        self.width * self.thickness
    }

    /// Time until the grip has its full speed, s.
    pub fn ramp(&self) -> f64 {
        10.0 * self.length / 3340.0
    }

    /// Time at which the grip has moved by this way, s.
    pub fn time_at(&self, way: f64) -> f64 {
        0.5 * self.ramp() + way / self.speed
    }

    pub fn build(&self) -> (Scene<2>, Explicit<shape::Linear, 2>) {
        let (l, w, h) = (self.length, self.width, self.cell);
        let concrete = Decohesive {
            elastic: Isotropic {
                density: 2350.0,
                young: 24.9e9,
                poisson: 0.18,
            },
            strength: self.strength,
            toughness: self.toughness,
            softening: softening::Linear,
            normal: Normal::Prescribed(Vector3::x()),
        };
        let (ramp, speed) = (self.ramp(), self.speed);
        let weak = Scale {
            strength: Self::WEAKNESS,
            ..Scale::default()
        };
        let spacing = Spacing(h / 2.0);
        let roller = Hold::Component(Vector2::x());
        let mut scene = Scene::plane(Plane::Strain {
            thickness: self.thickness,
        });
        scene
            .fill("bar", concrete, &Block::new([0.0, 0.0], [l, w]), &spacing)
            .unwrap()
            .rigid(
                "left",
                &Block::new([-h, 0.0], [0.0, w]),
                &spacing,
                roller,
                Velocity(|_| 0.0),
            )
            .unwrap()
            .rigid(
                "right",
                &Block::new([l, 0.0], [l + h, w]),
                &spacing,
                roller,
                Velocity(move |t: f64| speed * (t / ramp).min(1.0)),
            )
            .unwrap()
            .set_scale("bar", |x| x[0] > l / 2.0 && x[0] < l / 2.0 + h, weak)
            .unwrap();
        let grid = Grid::over([-4.0 * h, -4.0 * h], [l + 4.0 * h, w + 4.0 * h], h).unwrap();
        let solver = Explicit::new(grid, shape::Linear, ExplicitSettings::default()).unwrap();
        (scene, solver)
    }
}

/// The bar after the crack has opened fully, and its energies on the way.
pub fn broken(bar: &Bar) -> (Scene<2>, EnergyHistory) {
    let (mut scene, mut solver) = bar.build();
    let mut energy = EnergyHistory::new().every(20);
    let end = Until::Time(bar.time_at(1.3 * bar.critical_opening()));
    run(&mut scene, &mut solver, end, &mut [&mut energy]).unwrap();
    (scene, energy)
}
