//! One scene, two solvers: the bar of `01_bar`, explicit and in equilibrium.
//!
//! New here: `QuasiStatic`. A scene knows no solver, so nothing but the solver value changes.
#![allow(clippy::print_stdout)]

use fissure::prelude::*;

#[path = "01_bar.rs"]
mod bar;
use bar::{AREA, H, TOUGHNESS, bar};

fn pull(name: &str, solver: &mut dyn Solver<2>) -> Result<(), Error> {
    let mut scene = bar()?;
    let mut pull = LoadDisplacement::of("right").against("left");
    let end = Until::Time(6.5e-3);
    let summary = run(&mut scene, solver, end, &mut [&mut pull])?;
    println!(
        "{name:12} {:5} steps   peak {:7.1} N   work {:.5} J   dissipated {:.5} J",
        summary.steps,
        pull.curve().peak(),
        pull.curve().work(),
        scene.energy().dissipated
    );
    Ok(())
}

fn main() -> Result<(), Error> {
    let grid = Grid::over([-0.08, -0.08], [0.28, 0.14], H)?;
    let settings = ExplicitSettings::default();
    let mut solver = Explicit::new(grid.clone(), shape::Linear, settings)?;
    pull("explicit", &mut solver)?;

    // Load steps of 50 µs: the prescribed speeds times this are the displacement increments.
    let settings = QuasiStaticSettings {
        step: 5e-5,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid, shape::Linear, settings)?;
    pull("quasi-static", &mut solver)?;

    println!("W·D·G_f {:.5} J", AREA * TOUGHNESS);
    Ok(())
}
