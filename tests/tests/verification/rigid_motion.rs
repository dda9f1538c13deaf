//! D6. A body that moves as a whole across cells and tiles is neither strained nor stressed, and
//! arrives where it should.

use fissure::nalgebra::SVector;
use fissure::prelude::*;
use fissure_tests::{Build, Case, Space, Table, cases, rubber};

const H: f64 = 0.125;
const EXACT: f64 = 1e-12;

fn translation<const D: usize>(case: &Case)
where
    Table: Build<D>,
{
    let cells = if D == 3 { 3.0 } else { 5.0 };
    let mut scene = Table::scene(case.space);
    let block = Block::new([0.0; D], [cells * H; D]);
    scene
        .fill("block", rubber(), &block, &Spacing(H / 2.0))
        .unwrap();
    let speed = 0.5 * rubber().elastic.p_wave_speed();
    let velocity = SVector::<f64, D>::from_fn(|axis, _| match (case.space, axis) {
        // A radial velocity is a strain.
        (Space::Axisymmetric, 0) => 0.0,
        _ => speed * [0.8, -0.55, 0.3][axis],
    });
    scene.set_velocity("block", |_| velocity).unwrap();
    let grid = Grid::over([-8.0 * H; D], [16.0 * H; D], H).unwrap();
    let mut solver = Table::row(case, grid, 0.4).unwrap();
    let start = by_id(&scene);
    run(&mut scene, &mut *solver, Until::Steps(40), &mut []).unwrap();

    let way = velocity * scene.time();
    assert!(way.norm() > 3.0 * H, "{case:?}: only {way}");
    for (now, start) in by_id(&scene).iter().zip(&start) {
        let error = (now - start - way).norm();
        assert!(error <= EXACT, "{case:?}: x is off by {error:e}");
    }
    let motion = scene.bodies()[0].motion();
    for (row, f) in motion.deformation_gradient.iter().enumerate() {
        let strain = (f - Matrix3::identity()).norm();
        assert!(strain <= EXACT, "{case:?}: strain {strain:e}");
        let stress = motion.stress[row].norm() / rubber().elastic.young;
        assert!(stress <= 2.0 * EXACT, "{case:?}: stress {stress:e} E");
        let error = (motion.velocity[row] - velocity).norm() / speed;
        assert!(error <= EXACT, "{case:?}: v is off by {error:e}");
    }
    let lost = scene.energy().transfer_loss / scene.energy().kinetic;
    assert!(lost.abs() <= EXACT, "{case:?}: transfers lose {lost:e}");
}

fn by_id<const D: usize>(scene: &Scene<D>) -> Vec<SVector<f64, D>> {
    let particles = scene.bodies()[0].particles();
    let mut pairs: Vec<_> = particles
        .id
        .iter()
        .zip(&particles.motion.position)
        .collect();
    pairs.sort_unstable_by_key(|(id, _)| **id);
    pairs.into_iter().map(|(_, x)| *x).collect()
}

#[test]
fn d6_translation_strains_nothing_in_plane() {
    cases(Space::Plane).iter().for_each(translation::<2>);
}

#[test]
fn d6_translation_strains_nothing_axisymmetric() {
    cases(Space::Axisymmetric).iter().for_each(translation::<2>);
}

#[test]
fn d6_translation_strains_nothing_in_space() {
    cases(Space::Solid).iter().for_each(translation::<3>);
}
