//! A bar that lies at 15°, on a mesh that lies along it: what the grid's axes do to a crack, and how to be rid of it.
//!
//! New here: `GmshMesh`, a mesh of quadrilaterals with named groups from gmsh; `shape::Isoparametric`, its functions;
//! `hold_places`, a condition on nodes.
#![allow(clippy::print_stdout)]

use fissure::nalgebra::Rotation2;
use fissure::prelude::*;

const STRENGTH: f64 = 0.9 * 2.7e6; // Pa, of the weak column
const TOUGHNESS: f64 = 61.35; // J/m²
const AREA: f64 = 0.06 * 0.06; // m²

/// A bar of 0.2 m × 0.06 m with its lower left corner at the origin, weak across its middle, pulled by the nodes at its ends.
fn bar(mesh: &GmshMesh, axis: Vector2<f64>) -> Result<Scene<2>, Error> {
    let concrete = Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: STRENGTH / 0.9,
        toughness: TOUGHNESS,
        softening: softening::Linear,
        normal: Normal::Rankine,
    };
    let weaker = Scale {
        strength: 0.9,
        ..Scale::default()
    };
    let weak = |x: &Vector2<f64>| (0.1..0.11).contains(&x.dot(&axis));
    let hold = Hold::Component(axis);
    let mut scene = Scene::plane(Plane::Strain { thickness: 0.06 });
    scene
        .add_body("bar", concrete, mesh.seeds("bar", 2)?)?
        .set_scale("bar", weak, weaker)?
        .hold_places("left", &mesh.places("left end")?, hold, Constant(0.0))?
        .hold_places("right", &mesh.places("right end")?, hold, Constant(1.0))?;
    Ok(scene)
}

fn pull(
    name: &str,
    solver: &mut dyn Solver<2>,
    scene: &mut Scene<2>,
    axis: Vector2<f64>,
) -> Result<(), Error> {
    let end = 1.25 * 2.0 * TOUGHNESS / STRENGTH; // m at 1 m/s: beyond the opening at which the crack is free
    let (mut peak, mut load) = (0.0_f64, 0.0);
    while scene.time() < end {
        load = solver.step(scene, end)?.reactions[1].dot(&axis);
        peak = peak.max(load);
    }
    let energy = scene.energy();
    println!(
        "{name:6} peak {:.3}, at last {:.3} of f A   work {:.3}, dissipated {:.3} of G_f A",
        peak / (STRENGTH * AREA),
        load / (STRENGTH * AREA),
        energy.external / (TOUGHNESS * AREA),
        energy.dissipated / (TOUGHNESS * AREA)
    );
    Ok(())
}

fn main() -> Result<(), Error> {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../fissure-io/tests/data/bar_15.msh"
    );
    let mesh = GmshMesh::read(file)?;
    let axis = Rotation2::new(15_f64.to_radians()) * Vector2::x();
    let settings = QuasiStaticSettings {
        step: 1e-6,
        ..QuasiStaticSettings::default()
    };

    let shape = shape::Isoparametric(mesh.mesh.clone());
    let mut solver = QuasiStatic::new(mesh.mesh.grid(), shape, settings)?;
    pull("mesh", &mut solver, &mut bar(&mesh, axis)?, axis)?;

    // The same particles and places on a grid along the axes. A place holds all nodes of its cell.
    let grid = Grid::over([-0.08, -0.08], [0.28, 0.18], 0.01)?;
    let mut solver = QuasiStatic::new(grid, shape::Linear, settings)?;
    pull("grid", &mut solver, &mut bar(&mesh, axis)?, axis)
}
