//! X20: two particles at one place add up to one of twice the volume; no volume is an error.

use fissure::nalgebra::Matrix2;
use fissure::particles::ParticleError;
use fissure::prelude::*;
use fissure_tests::{Build, ShapeKind, Space, Table, rubber};

const H: f64 = 0.125;

/// A row of particles, each given `copies` times with its share of the volume.
fn row(copies: usize) -> Scene<2> {
    let mut scene = Table::scene(Space::Plane);
    let (mut position, mut volume) = (Vec::new(), Vec::new());
    for i in 0..12 {
        for _ in 0..copies {
            position.push(Vector2::new(H * (0.25 + 0.5 * f64::from(i)), 0.03));
            volume.push(H * H / 4.0 / copies as f64);
        }
    }
    let half_edges = Matrix2::identity() * (H / 4.0);
    let seeds = Seeds {
        position,
        volume,
        half_edges,
    };
    scene
        .add_body("row", rubber(), seeds)
        .unwrap()
        .set_velocity("row", |x| Vector2::new((9.0 * x[0]).sin(), 0.0))
        .unwrap();
    scene
}

#[test]
fn x20_twins_move_as_one_particle_of_their_volume() {
    for shape in ShapeKind::ALL {
        let ends = [1, 2].map(|copies| {
            let mut scene = row(copies);
            let grid = Grid::over([-1.0; 2], [2.0; 2], H).unwrap();
            let settings = ExplicitSettings {
                mass_cutoff: 0.0,
                ..Default::default()
            };
            let mut solver = Table::solver(shape, grid, settings).unwrap();
            run(&mut scene, &mut *solver, Until::Steps(50), &mut []).unwrap();
            scene
        });
        let (twins, single) = (ends[1].bodies()[0].motion(), ends[0].bodies()[0].motion());
        for (i, v) in single.velocity.iter().enumerate() {
            assert!(
                twins.position[2 * i] == twins.position[2 * i + 1],
                "{shape:?}"
            );
            let error = (twins.velocity[2 * i] - v).norm();
            assert!(error <= 1e-12, "{shape:?}: {error:e}");
        }
        assert!(ends[0].energy().stored > 0.0);
    }
}

#[test]
fn x20_no_volume_is_a_typed_error() {
    for wrong in [0.0, -1.0, f64::NAN] {
        let mut scene: Scene<2> = Table::scene(Space::Plane);
        let seeds = Seeds {
            position: vec![Vector2::new(0.1, 0.1)],
            volume: vec![wrong],
            half_edges: Matrix2::identity() * (H / 4.0),
        };
        let error = scene.add_body("b", rubber(), seeds).err();
        let Some(SceneError::Particles { source, .. }) = error else {
            panic!("{error:?}");
        };
        assert!(
            matches!(source, ParticleError::OutOfRange { .. }),
            "{source:?}"
        );
    }
}
