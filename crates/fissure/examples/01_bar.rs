//! The tensile bar [Sanchez 2010, ch. 5]: pulled until it breaks at a weak line.
//!
//! New here: a scene, an explicit solver, watches. Read before: `00_point`.
#![allow(clippy::print_stdout)]

use fissure::prelude::*;

pub(crate) const STRENGTH: f64 = 2.7e6; // Pa
pub(crate) const TOUGHNESS: f64 = 61.35; // J/m²
pub(crate) const AREA: f64 = 0.06 * 0.06; // m²
pub(crate) const H: f64 = 0.02; // m

pub(crate) fn bar() -> Result<Scene<2>, Error> {
    let concrete = Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: STRENGTH,
        toughness: TOUGHNESS,
        softening: softening::Linear,
        normal: Normal::Rankine,
    };
    let weaker = Scale {
        strength: 0.9,
        ..Scale::default()
    };
    let block = |from, to| Block::new([from, 0.0], [to, 0.06]);
    let particles = Spacing(H / 2.0); // two per cell and axis
    // Grips hold the axial velocity of the nodes they reach; the right one speeds up over 0.6 ms,
    // ten transits of the bar by a wave.
    let axial = Hold::Component(Vector2::x());
    let speed = Velocity(|t: f64| 0.01 * (t / 6e-4).min(1.0));
    let mut scene = Scene::plane(Plane::Strain { thickness: 0.06 });
    scene
        .fill("bar", concrete, &block(0.0, 0.2), &particles)?
        .set_scale("bar", |x| (0.10..0.12).contains(&x[0]), weaker)?
        .rigid(
            "left",
            &block(-H, 0.0),
            &particles,
            axial,
            Velocity(|_| 0.0),
        )?
        .rigid("right", &block(0.2, 0.2 + H), &particles, axial, speed)?;
    Ok(scene)
}

#[allow(dead_code)] // `03_quasi_static` takes the scene only
fn main() -> Result<(), Error> {
    let mut scene = bar()?;
    let grid = Grid::over([-0.08, -0.08], [0.28, 0.14], H)?;
    let mut solver = Explicit::new(grid, shape::Linear, ExplicitSettings::default())?;
    let mut pull = LoadDisplacement::of("right").against("left");
    let mut table = Record::new()
        .column("time [s]", |scene, _| scene.time())
        .column("load [N]", |_, report| report.reactions[1][0])
        .column("dissipated [J]", |scene, _| scene.energy().dissipated)
        .every_interval(5e-4);
    let end = Until::Time(6.5e-3);
    let summary = run(&mut scene, &mut solver, end, &mut [&mut pull, &mut table])?;

    println!("time/ms   load/N   dissipated/J");
    for row in table.rows() {
        println!("{:7.3}  {:7.1}   {:12.5}", row[0] * 1e3, row[1], row[2]);
    }
    let (curve, energy) = (pull.curve(), AREA * TOUGHNESS);
    let peak = curve.peak() / (0.9 * STRENGTH * AREA);
    println!("steps {}", summary.steps);
    println!("peak / (0.9·strength·W·D)  {peak:.4}");
    println!("work / (W·D·G_f)           {:.4}", curve.work() / energy);
    let dissipated = scene.energy().dissipated / energy;
    println!("dissipated / (W·D·G_f)     {dissipated:.4}");
    Ok(())
}
