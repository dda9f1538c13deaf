//! Of several particles that a kernel cannot move the one with the lowest id is reported, whatever
//! their order.

#![allow(clippy::panic, clippy::print_stdout, clippy::unwrap_used)]

use fissure_materials::Isotropic;
use fissure_particles::{Block, MotionSlices, MotionSlicesMut, ParticleId, Spacing};
use fissure_scene::{ByRun, Plane, Run, RunKernel, Scene, SolveError, SweepSettings};
use fissure_tensor::Band;

/// Cannot move particles beyond a place.
fn wall(place: f64) -> impl RunKernel<2> {
    ByRun(
        move |_: &Run, old: &MotionSlices<'_, 2>, new: &mut MotionSlicesMut<'_, 2>| {
            for row in 0..old.len() {
                new.deformation_gradient[row] = old.deformation_gradient[row];
                if old.position[row][0] > place {
                    return Err(row);
                }
            }
            Ok(())
        },
    )
}

#[test]
fn the_lowest_id_of_a_run_is_reported_whatever_the_order() {
    let elastic = Isotropic {
        density: 1000.0,
        young: 1e6,
        poisson: 0.25,
    };
    let mut scene = Scene::plane(Plane::Strain { thickness: 1.0 });
    let block = Block::new([0.0, 0.0], [1.0, 0.1]);
    scene.fill("bar", elastic, &block, &Spacing(0.05)).unwrap();
    let count = scene.particle_count() as u32;
    let runs = [
        Run {
            start: 0,
            end: 23,
            window: 0,
        },
        Run {
            start: 23,
            end: count,
            window: 1,
        },
    ];
    let settings = SweepSettings {
        dt: 1.0,
        band: Band::Uniform(0.1),
        viscosity: None,
        simd: fissure_tensor::simd::Simd::widest(),
        in_place: false,
    };
    let body = &mut scene.bodies_mut()[0];
    let beyond = |body: &fissure_scene::Body<2>| {
        let pairs = body.particles().id.iter().zip(body.motion().position);
        let ids: Vec<ParticleId> = pairs
            .filter(|(_, x)| x[0] > 0.5)
            .map(|(id, _)| *id)
            .collect();
        assert!(ids.len() > 10);
        ids.into_iter().min().unwrap()
    };
    let lowest = beyond(body);
    // As they are, backwards, and by strides of 7, which does not divide their number.
    let orders: [Vec<u32>; 3] = [
        (0..count).collect(),
        (0..count).rev().collect(),
        (0..count).map(|i| i * 7 % count).collect(),
    ];
    for order in orders {
        body.reorder(&order).unwrap();
        let failure = body.sweep(&runs, &wall(0.5), &settings).unwrap_err();
        let SolveError::Outside { id, position, .. } = failure.at(body, 1, 0.0) else {
            panic!("not the kernel's failure");
        };
        assert_eq!(id, lowest);
        let row = body.particles().id.iter().position(|i| *i == id).unwrap();
        assert_eq!(position, body.motion().position[row].as_slice());
    }
}
