//! X3: the bar of Sanchez 2010, sec. 5.2, with so little toughness that a cell stores more than its crack can take.

use fissure_grid::{Grid, shape};
use fissure_materials::{Decohesive, Isotropic, LoweredStrength, Normal, Scale, softening};
use fissure_particles::{Block, Spacing};
use fissure_scene::{Hold, Plane, Scene, SceneError, SolveError, Solver, Velocity};
use fissure_solvers::{Explicit, ExplicitSettings};
use nalgebra::{Vector3, vector};

const H: f64 = 0.02;
const SIDE: f64 = 0.06;
const LENGTH: f64 = 0.2;
const STRENGTH: f64 = 2.7e6;

fn law(toughness: f64) -> Decohesive {
    Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: STRENGTH,
        toughness,
        softening: softening::Linear,
        normal: Normal::Prescribed(Vector3::x()),
    }
}

/// The toughness at which a cell is so many times over the limit `2 E₁ G/τ²`.
fn toughness(times: f64) -> f64 {
    let modulus = law(1.0).elastic.p_wave_modulus();
    0.5 * H * STRENGTH * STRENGTH / modulus / times
}

fn bar<M: fissure_materials::Material>(law: M, speed: f64) -> Result<Scene<2>, SceneError> {
    let spacing = Spacing(0.5 * H);
    let mut scene = Scene::plane(Plane::Strain { thickness: SIDE });
    scene.fill(
        "bar",
        law,
        &Block::new([0.0, 0.0], [LENGTH, SIDE]),
        &spacing,
    )?;
    // The middle is weaker, so that the bar breaks there.
    let weak = Scale {
        strength: 0.9,
        toughness: 0.81,
        ..Scale::default()
    };
    scene.set_scale("bar", |x| (0.1..0.1 + H).contains(&x[0]), weak)?;
    let along = Hold::Component(vector![1.0, 0.0]);
    for (name, from, speed) in [("left", -H, 0.0), ("right", LENGTH, speed)] {
        let grip = Block::new([from, 0.0], [from + H, SIDE]);
        scene.rigid(name, &grip, &spacing, along, Velocity(move |_| speed))?;
    }
    Ok(scene)
}

fn solver() -> Explicit<shape::Linear, 2> {
    let grid = Grid::over([-0.1, -0.1], [0.3, 0.16], H).unwrap();
    Explicit::new(grid, shape::Linear, ExplicitSettings::default()).unwrap()
}

#[test]
fn x3_without_toughness_enough_a_cell_is_refused_before_the_first_step() {
    for times in [1.01, 10.0, 1e3] {
        let mut scene = bar(law(toughness(times)), 0.05).unwrap();
        let refused = solver().step(&mut scene, 1.0);
        assert!(
            matches!(refused, Err(SolveError::Band { .. })),
            "{times}: {refused:?}"
        );
        assert_eq!(scene.step(), 0);
    }
    assert!(bar(law(0.0), 0.05).is_err());
}

/// With the strength that the cell allows the bar breaks at that strength; its crack takes its toughness, and never more than
/// was put in.
#[test]
fn x3_a_lowered_strength_breaks_the_bar_with_the_energy_there_is() {
    for times in [1.01, 10.0, 1e3] {
        // As slow against the strength for all: a sudden start alone is a stress of ρ c v.
        let speed = 0.05 / f64::sqrt(times);
        let mut scene = bar(LoweredStrength(law(toughness(times))), speed).unwrap();
        let mut solver = solver();
        let strength = 0.9 * STRENGTH * (0.99 / times).sqrt();
        let strain = strength / law(1.0).elastic.young;
        let end = 3.0 * strain * LENGTH / speed;
        let mut peak: f64 = 0.0;
        while scene.time() < end {
            let report = solver.step(&mut scene, end).unwrap();
            assert!(report.energy.dissipated >= 0.0);
            peak = peak.max(scene.reaction("right").unwrap()[0] / (SIDE * SIDE));
            let energy = scene.energy();
            assert!(energy.dissipated <= energy.external * (1.0 + 1e-9) + 1e-15);
        }
        let spent = scene.energy().dissipated / (0.81 * toughness(times) * SIDE * SIDE);
        // Waves from the crack may open its neighbours.
        assert!((0.99..=4.0).contains(&spent), "{times}: {spent}");
        let peak = peak / strength;
        assert!((0.95..=1.05).contains(&peak), "{times}: {peak}");
    }
}
