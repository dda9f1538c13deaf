//! A plate with a centre crack is pulled: stress intensity by the interaction integral.
//!
//! Half of the plate is computed, with the middle of the crack on a plane of symmetry. The exact value for a long
//! plate is K_I = σ √(π a) F(a/b), F = (1 − 0.025 λ² + 0.06 λ⁴) √sec(π λ / 2) [Tada].

#![allow(clippy::print_stdout)]

use std::f64::consts::PI;

use fissure::diagnostics::fracture::{Annulus, PlaneElastic, TipField, TipFrame, interaction};
use fissure::prelude::*;

const WIDTH: f64 = 0.1;
const HEIGHT: f64 = 0.2;
const STRESS: f64 = 1e6;

/// K_I of a crack of half length `a` on a grid of spacing `h`. The tip may lie anywhere in a cell.
fn intensity(h: f64, a: f64) -> Result<f64, Error> {
    let steel = Isotropic {
        density: 7800.0,
        young: 207e9,
        poisson: 0.3,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let up = Vector2::new(0.0, STRESS * WIDTH);
    scene
        .fill(
            "plate",
            steel,
            &Block::new([0.0, -HEIGHT], [WIDTH, HEIGHT]),
            &Spacing(h / 2.0),
        )?
        .crack(
            "crack",
            &[[-h, 0.0], [a, 0.0]],
            CrackSettings {
                first: EndState::Mouth,
                ..CrackSettings::default()
            },
        )?
        .hold(
            "symmetry",
            "plate",
            |x| x[0] < 0.5 * h,
            Hold::Component(Vector2::x()),
            Constant(0.0),
        )?
        .force("top", "plate", |x| x[1] > HEIGHT - 0.5 * h, move |_| up)?
        .force(
            "bottom",
            "plate",
            |x| x[1] < -HEIGHT + 0.5 * h,
            move |_| -up,
        )?;
    let grid = Grid::over(
        [-4.0 * h, -HEIGHT - 4.0 * h],
        [WIDTH + 4.0 * h, HEIGHT + 4.0 * h],
        h,
    )?;
    let mut solver = QuasiStatic::new(grid, shape::Linear, QuasiStaticSettings::default())?;
    run(&mut scene, &mut solver, Until::Steps(1), &mut [])?;
    let tip = TipFrame::of(&scene.cracks()[0], End::Last);
    let elastic = PlaneElastic {
        young: 207e9,
        poisson: 0.3,
        plane_stress: false,
    };
    let annulus = Annulus {
        inner: 0.2 * a,
        outer: 0.4 * a,
    };
    let field = TipField::of(&scene, "plate", &tip.position, 0.5 * a, &elastic, None)?;
    Ok(interaction(&field, &tip, &annulus, &elastic)?.k1)
}

fn main() -> Result<(), Error> {
    for (cells, part) in [(10.0, 0.0), (10.0, 0.5), (20.0, 0.0), (20.0, 0.5)] {
        let h = 0.05 / cells;
        let a = 0.05 + part * h;
        let ratio = a / WIDTH;
        let shape = 1.0 - 0.025 * ratio.powi(2) + 0.06 * ratio.powi(4);
        let exact = STRESS * (PI * a).sqrt() * shape / (PI * ratio / 2.0).cos().sqrt();
        let k1 = intensity(h, a)?;
        let error = 100.0 * (k1 / exact - 1.0);
        println!(
            "a/h {:5.2}   K_I {k1:.4e}   exact {exact:.4e} Pa √m   {error:+.2} %",
            a / h
        );
    }
    Ok(())
}
