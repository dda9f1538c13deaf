//! Every entry of the assembled matrix is the derivative of a force.

use fissure_grid::{Grid, shape, simd::Simd};
use fissure_materials::NeoHookean;
use fissure_particles::{Block, Spacing};
use fissure_scene::{Plane, Scene};
use nalgebra::SVector;

use super::balance::{At, strain, stress_forces};
use super::one_strain::Deviations;
use super::system::System;
use crate::band::BandSource;
use crate::constraints::Constraints;
use crate::nodes::NodeSums;
use crate::placement::Placement;
use crate::quasi_static::Averaging;
use crate::transfers::Transfers;

const H: f64 = 0.5;

const RUBBER: NeoHookean = NeoHookean {
    density: 1000.0,
    young: 1e6,
    poisson: 0.3,
};

/// Largest difference between the matrix of a distorted block and centred differences of the forces, over the largest entry.
fn difference<const D: usize>(mut scene: Scene<D>, averaging: Averaging, strain_of: f64) -> f64 {
    // Off the lattice of nodes, so that particles reach unlike patches.
    let block = Block::new([1.1; D], [2.1; D]);
    scene.fill("block", RUBBER, &block, &Spacing(0.25)).unwrap();
    let grid = Grid::over([0.0; D], [4.0; D], H).unwrap();
    let mut placement = Placement::default();
    placement.update(&grid, &shape::Linear, &mut scene).unwrap();
    let transfers = Transfers {
        grid: &grid,
        shape: &shape::Linear,
        placement: &placement,
        kinematics: scene.kinematics(),
        simd: Simd::widest(),
    };
    let mut system = System::<D>::default();
    system
        .find(&transfers, &scene, &Constraints::default())
        .unwrap();
    let count = placement.node_count();
    if let Averaging::Strain { hourglass } = averaging {
        let links = &mut system.links;
        links.one_strain(&scene, &Deviations::default(), hourglass);
    }
    let mut tangents = vec![Vec::new(); 1];
    let mut sums = NodeSums::default();
    sums.clear(count);
    let mut forces = |system: &mut System<D>, u: &[SVector<f64, D>]| {
        let links = &mut system.links;
        if averaging == Averaging::Volume {
            links.average(&scene, u);
        }
        links.increase(&scene, u);
        let band = BandSource::default();
        strain(
            &mut scene,
            &transfers,
            u,
            band,
            1.0,
            links,
            Some(&mut tangents),
        )
        .unwrap();
        stress_forces(links, &transfers, &scene, &mut sums, At::End).unwrap();
        let at = |&node: &u32| sums.internal_force(node as usize);
        let forces: Vec<f64> = links.active.iter().flat_map(|n| at(n).data.0[0]).collect();
        system.assemble(&scene, &tangents);
        forces
    };
    // Strains and turns that differ from node to node.
    let mut u: Vec<SVector<f64, D>> = (0..count)
        .map(|node| SVector::from_fn(|k, _| strain_of * H * ((7 * node + 3 * k) as f64).sin()))
        .collect();
    forces(&mut system, &u);
    let (active, size) = (system.links.active.clone(), system.stiffness.matrix.size());
    let matrix = system.stiffness.matrix.clone();
    let (mut most, mut largest) = (0.0_f64, 0.0_f64);
    let step = 1e-5 * H;
    for column in 0..size {
        let (node, k) = (active[column / D] as usize, column % D);
        let here = u[node][k];
        u[node][k] = here + step;
        let ahead = forces(&mut system, &u);
        u[node][k] = here - step;
        let behind = forces(&mut system, &u);
        u[node][k] = here;
        let (mut unit, mut entries) = (vec![0.0; size], vec![0.0; size]);
        unit[column] = 1.0;
        matrix.multiply(&unit, &mut entries);
        for (row, entry) in entries.iter().enumerate() {
            let slope = (behind[row] - ahead[row]) / (2.0 * step);
            most = most.max((entry - slope).abs());
            largest = largest.max(entry.abs());
        }
    }
    most / largest
}

fn plane() -> Scene<2> {
    Scene::plane(Plane::Strain { thickness: 0.7 })
}

#[test]
fn every_entry_is_the_derivative_of_a_force() {
    let sheet = Scene::plane(Plane::Stress { thickness: 0.7 });
    let one_strain = Averaging::Strain { hourglass: 0.0 };
    for (name, difference) in [
        ("plane strain", difference(plane(), Averaging::None, 0.1)),
        ("plane stress", difference(sheet, Averaging::None, 0.1)),
        (
            "axisymmetric",
            difference(Scene::axisymmetric(), Averaging::None, 0.1),
        ),
        ("space", difference(Scene::solid(), Averaging::None, 0.1)),
        ("one strain a cell", difference(plane(), one_strain, 0.1)),
    ] {
        println!("{name}: {difference:.1e}");
        assert!(difference <= 1e-8, "{name}: {difference:e}");
    }
}

/// With one volume change a cell the tangent leaves out what is of the order of the strain.
#[test]
fn volume_averages_are_differentiated_up_to_the_strain() {
    for strain_of in [0.1, 1e-2, 1e-3] {
        for scene in [plane(), Scene::axisymmetric()] {
            let difference = difference(scene, Averaging::Volume, strain_of);
            println!("{strain_of}: {difference:.1e}");
            assert!(difference <= 0.5 * strain_of, "{strain_of}: {difference:e}");
        }
    }
}
