//! The patch test: a linear motion of the border of a distorted mesh is one of all of it.

use fissure_grid::shape;
use fissure_materials::{Hencky, Isotropic, Matrix3};
use fissure_scene::{Constant, Hold, Plane, Scene, Solver};
use fissure_solvers::{QuasiStatic, QuasiStaticSettings};
use nalgebra::{Matrix2, Vector2};

use crate::meshes::{distorted, filled};

/// Particles at the middles of parts that are equal in natural coordinates integrate ∇N exactly, since det J ∇N is
/// bilinear: the forces of a uniform stress balance at every inner node.
#[test]
fn a_uniform_stress_is_in_equilibrium() {
    let (columns, rows) = (6, 5);
    let mesh = distorted(columns, rows, 0.1);
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: 0.3,
    };
    // Also far beyond small strains.
    for size in [1e-6, 0.2] {
        // What round-off leaves of so small a strain.
        let bound = f64::max(1e-15 / size, 1e-11);
        let gradient = Matrix2::new(-0.7, 0.4, -0.2, -0.5) * size;
        // Towards the middle, so that no particle leaves the mesh.
        let middle = Vector2::new(0.3, 0.25);
        let mut scene = Scene::plane(Plane::Strain { thickness: 2.0 });
        let all: Vec<usize> = (0..columns * rows).collect();
        scene
            .add_body("patch", Hencky { elastic }, filled(&mesh, &all))
            .unwrap();
        for (node, x) in mesh.nodes().iter().enumerate() {
            let (i, j) = (node % (columns + 1), node / (columns + 1));
            if i == 0 || i == columns || j == 0 || j == rows {
                let way = gradient * (x - middle);
                let along = if way.norm() > 0.0 { way } else { Vector2::x() };
                let name = format!("node {node}");
                scene
                    .hold_places(&name, &[*x], Hold::All(along), Constant(way.norm()))
                    .unwrap();
            }
        }
        let settings = QuasiStaticSettings {
            tolerance: bound,
            max_cuts: 0,
            ..QuasiStaticSettings::default()
        };
        let start = scene.bodies()[0].motion().position.to_vec();
        let ids = scene.bodies()[0].particles().id.clone();
        let grid = mesh.grid();
        let mut solver =
            QuasiStatic::new(grid, shape::Isoparametric(mesh.clone()), settings).unwrap();
        solver.step(&mut scene, 1.0).unwrap();

        let body = &scene.bodies()[0];
        let motion = body.motion();
        let expected = Matrix3::new(
            1.0 + gradient.m11,
            gradient.m12,
            0.0,
            gradient.m21,
            1.0 + gradient.m22,
            0.0,
            0.0,
            0.0,
            1.0,
        );
        let strains = |f: &Matrix3<f64>| (f - expected).norm();
        let most = motion
            .deformation_gradient
            .iter()
            .map(strains)
            .fold(0.0, f64::max);
        println!("strains of {size}: {:.1e} of them", most / size);
        assert!(most <= bound * size, "{size}: {most}");
        let stress = motion.stress[0];
        assert!(stress.norm() > 0.1 * size * 1e6);
        for other in motion.stress {
            assert!((*other - stress).norm() <= 10.0 * bound * stress.norm());
        }
        for (row, x) in motion.position.iter().enumerate() {
            let before = ids
                .iter()
                .position(|id| *id == body.particles().id[row])
                .unwrap();
            let way = gradient * (start[before] - middle);
            assert!((x - start[before] - way).norm() <= bound * size);
        }
    }
}
