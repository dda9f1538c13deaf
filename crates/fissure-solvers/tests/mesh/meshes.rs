//! Meshes for the tests, and the particles that fill them.

use fissure_grid::QuadMesh;
use fissure_particles::Seeds;
use fissure_scene::{Body, Scene};
use nalgebra::{Matrix2, Vector2};

/// A mesh of the topology of a lattice with its nodes where `place` puts those of whole numbers.
pub fn mapped(columns: usize, rows: usize, place: impl Fn(f64, f64) -> Vector2<f64>) -> QuadMesh {
    let node = |i: usize, j: usize| (j * (columns + 1) + i) as u32;
    let nodes = (0..=rows)
        .flat_map(|j| (0..=columns).map(move |i| (i as f64, j as f64)))
        .map(|(i, j)| place(i, j))
        .collect();
    let elements = (0..rows)
        .flat_map(|j| {
            (0..columns).map(move |i| {
                [
                    node(i, j),
                    node(i + 1, j),
                    node(i + 1, j + 1),
                    node(i, j + 1),
                ]
            })
        })
        .collect();
    QuadMesh::new(nodes, elements).unwrap()
}

/// A lattice of spacing `h` with nodes moved without a pattern by up to 0.3 h along each axis, also at the border.
pub fn distorted(columns: usize, rows: usize, h: f64) -> QuadMesh {
    mapped(columns, rows, |i, j| {
        let wobble = |a: f64, b: f64| 0.3 * (7.3 * i + a * j + b).sin();
        Vector2::new(i + wobble(3.1, 0.4), j + wobble(5.7, 1.9)) * h
    })
}

/// Four particles in each of these elements.
pub fn filled(mesh: &QuadMesh, elements: &[usize]) -> Seeds<2> {
    let (position, volume) = mesh.parts(elements, 2).into_iter().unzip();
    Seeds {
        position,
        volume,
        half_edges: Matrix2::identity() * (0.25 * mesh.grid().spacing()),
    }
}

/// Rows of a body's particles in the order of their ids.
pub fn by_id(body: &Body<2>) -> Vec<usize> {
    let id = &body.particles().id;
    let mut rows: Vec<usize> = (0..id.len()).collect();
    rows.sort_by_key(|&row| id[row]);
    rows
}

/// Largest differences between the particles of two scenes: positions over `length`, velocities over `speed`, stresses
/// over `stress`.
pub fn difference(a: &Scene<2>, b: &Scene<2>, (length, speed, stress): (f64, f64, f64)) -> f64 {
    let mut most = 0.0_f64;
    for (a, b) in a.bodies().iter().zip(b.bodies()) {
        let (x, y) = (a.motion(), b.motion());
        for (i, j) in by_id(a).into_iter().zip(by_id(b)) {
            let apart = [
                (x.position[i] - y.position[j]).amax() / length,
                (x.velocity[i] - y.velocity[j]).amax() / speed,
                (x.stress[i] - y.stress[j]).norm() / stress,
            ];
            for part in apart {
                assert!(part.is_finite());
                most = most.max(part);
            }
        }
    }
    most
}
