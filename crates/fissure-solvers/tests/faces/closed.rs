//! A crack that is pressed shut and slides against friction.

use fissure_grid::{Grid, shape};
use fissure_materials::Isotropic;
use fissure_particles::{Block, Spacing};
use fissure_scene::{ContactLaw, CrackSettings, Hold, Plane, Scene, Solver, Velocity};
use fissure_solvers::{QuasiStatic, QuasiStaticSettings};
use nalgebra::Vector2;

/// At 45° in a plate of five times its length. The fields of nodes that it grazes hold slivers: what their faces overlap
/// by in an iterate must not drive them. It slips in its middle by 4 τ a/E′ with the shear `τ = σ (1 − μ)/2` that friction
/// leaves, as in an infinite plate.
#[test]
fn a_pressed_crack_slips_by_what_friction_leaves() {
    const H: f64 = 2e-3;
    const FRICTION: f64 = 0.6;
    const STRESS: f64 = 1e6;
    let steel = Isotropic {
        density: 7850.0,
        young: 207e9,
        poisson: 0.3,
    };
    let (a, half) = (25.5 * H, 0.25);
    let along = Vector2::new(1.0, 1.0).normalize();
    let across = Vector2::new(-along.y, along.x);
    let middle = Vector2::new(0.31 * H, 0.17 * H);
    let end = |sign: f64| (middle + along * (sign * a)).into();
    let contact = ContactLaw::Coulomb { friction: FRICTION };
    let settings = CrackSettings {
        contact,
        ..CrackSettings::default()
    };
    let edge = move |sign: f64| move |x: &Vector2<f64>| sign * x.y > half - 0.5 * H;
    let press = |sign: f64| move |t: f64| Vector2::new(0.0, -sign * STRESS * 2.0 * half * t);
    // A plate that dead loads press and nothing guides turns over.
    let upright = move |x: &Vector2<f64>| x.x.abs() < H && x.y.abs() > half - 0.5 * H;
    let guide = Hold::Component(Vector2::x());
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    scene
        .fill(
            "plate",
            steel,
            &Block::new([-half; 2], [half; 2]),
            &Spacing(0.5 * H),
        )
        .unwrap()
        .crack("crack", &[end(-1.0), end(1.0)], settings)
        .unwrap()
        .force("top", "plate", edge(1.0), press(1.0))
        .unwrap()
        .force("bottom", "plate", edge(-1.0), press(-1.0))
        .unwrap()
        .hold("upright", "plate", upright, guide, Velocity(|_| 0.0))
        .unwrap();
    let start = scene.bodies()[0].motion().position.to_vec();
    let id: Vec<_> = scene.bodies()[0].particles().id.clone();
    let grid = Grid::over([-half - 3.0 * H; 2], [half + 3.0 * H; 2], H).unwrap();
    let settings = QuasiStaticSettings {
        max_cuts: 0,
        ..QuasiStaticSettings::default()
    };
    let mut solver = QuasiStatic::new(grid, shape::Linear, settings).unwrap();
    let report = solver.step(&mut scene, f64::INFINITY).unwrap();

    let body = &scene.bodies()[0];
    // Of the particle nearest to a place beside the crack's middle.
    let moved = |side: f64| {
        let place = middle + across * (side * H);
        let near = |x: &Vector2<f64>| (x - place).norm();
        let first = (0..start.len())
            .min_by(|&i, &j| near(&start[i]).total_cmp(&near(&start[j])))
            .unwrap();
        let now = body
            .particles()
            .id
            .iter()
            .position(|now| *now == id[first])
            .unwrap();
        body.motion().position[now] - start[first]
    };
    let slip = (moved(1.0) - moved(-1.0)).dot(&along).abs();
    let modulus = steel.young / (1.0 - steel.poisson * steel.poisson);
    let exact = 4.0 * 0.5 * STRESS * (1.0 - FRICTION) * a / modulus;
    println!(
        "{} iterations, slip over that in an infinite plate {:.3}",
        report.iterations,
        slip / exact
    );
    assert!(report.iterations <= 12, "{}", report.iterations);
    assert!((slip / exact - 1.0).abs() <= 0.1, "{}", slip / exact);
}
