//! Columns: ids, reordering, trial and commit, optional columns and their bytes.

use fissure_particles::{
    Column, Extra, ExtraError, ParticleError, ParticleId, Particles, Seeds, sort_permutation,
};
use nalgebra::{Matrix2, SMatrix, Vector2, Vector3};
use proptest::prelude::*;
use serde::{Deserialize, Serialize};

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Affine<const D: usize>(SMatrix<f64, D, D>);

impl<const D: usize> Default for Affine<D> {
    fn default() -> Self {
        Self(SMatrix::zeros())
    }
}

impl<const D: usize> Column for Affine<D> {
    const NAME: &'static str = if D == 2 { "affine-2d" } else { "affine" };
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Heat {
    temperature: f64,
    zone: u16,
}

impl Column for Heat {
    const NAME: &'static str = "heat";
}

#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct OtherHeat;

impl Column for OtherHeat {
    const NAME: &'static str = "heat";
}

fn row_of_particles(count: usize) -> Particles<2> {
    let mut particles = Particles::default();
    for i in 0..count {
        let x = i as f64;
        particles
            .push(
                Vector2::new(x, -x),
                Vector2::new(0.5 * x, 0.0),
                2.0 + x,
                1.0 + x,
            )
            .expect("valid numbers");
        particles.motion.deformation_gradient[i][(0, 1)] = x;
        particles.motion.stress[i].mandel[5] = 3.0 * x;
    }
    for (i, heat) in particles
        .extra
        .ensure::<Heat>()
        .expect("valid numbers")
        .iter_mut()
        .enumerate()
    {
        heat.temperature = 300.0 + i as f64;
    }
    particles
}

fn seeds(position: Vec<Vector2<f64>>, volume: Vec<f64>) -> Seeds<2> {
    let half_edges = SMatrix::identity();
    Seeds {
        position,
        volume,
        half_edges,
    }
}

#[test]
fn a_new_particle_is_undeformed_and_free_of_stress() {
    let particles = row_of_particles(1);
    assert_eq!(
        particles.motion.deformation_gradient[0],
        nalgebra::Matrix3::identity()
    );
    assert_eq!(particles.motion.stress[0], fissure_tensor::Sym::ZERO);
    assert_eq!(particles.len(), 1);
    assert!(particles.trial.is_empty());
}

#[test]
fn ids_are_unique_and_survive_reordering() {
    let mut particles = row_of_particles(4);
    particles
        .extend_from_seeds(
            &seeds(vec![Vector2::zeros(); 3], vec![0.5; 3]),
            1000.0,
            0.02,
        )
        .unwrap();
    particles.reorder(&[6, 5, 4, 3, 2, 1, 0]).unwrap();
    let ids: Vec<u32> = particles.id.iter().map(|id| id.0).collect();
    assert_eq!(ids, [6, 5, 4, 3, 2, 1, 0]);
    let last = particles
        .push(Vector2::zeros(), Vector2::zeros(), 1.0, 1.0)
        .unwrap();
    assert_eq!(last, ParticleId(7));
    particles.check().unwrap();
    assert!((particles.volume[0] - 0.01).abs() < 1e-15);
    assert!((particles.mass[0] - 10.0).abs() < 1e-12);
}

#[test]
fn stored_columns_go_on_with_fresh_ids_and_repeated_ones_are_refused() {
    let old = row_of_particles(3);
    let mut new = Particles::from_columns(
        vec![ParticleId(4), ParticleId(9), ParticleId(1)],
        old.mass.clone(),
        old.volume.clone(),
        old.motion.clone(),
    )
    .unwrap();
    assert_eq!(
        new.push(Vector2::zeros(), Vector2::zeros(), 1.0, 1.0)
            .unwrap(),
        ParticleId(10)
    );
    new.id[0] = ParticleId(9);
    assert!(matches!(
        new.check(),
        Err(ParticleError::RepeatedId { id: 9 })
    ));
    new.mass.pop();
    assert!(matches!(
        new.check(),
        Err(ParticleError::ColumnLength {
            column: "mass",
            found: 3,
            expected: 4
        })
    ));
}

#[test]
fn a_step_that_is_not_committed_leaves_the_present() {
    let mut particles = row_of_particles(5);
    assert!(
        particles.commit().is_err(),
        "there is no trial to commit yet"
    );
    particles.make_trial();
    let before = particles.motion.clone();
    particles.trial.position[3][0] = 77.0;
    assert_eq!(particles.motion, before);
    let storage = particles.trial.position.as_ptr();
    particles.commit().unwrap();
    assert_eq!(particles.motion.position[3][0], 77.0);
    assert_eq!(
        particles.motion.position.as_ptr(),
        storage,
        "swapped, not copied"
    );
    assert_eq!(particles.trial, before);
}

#[test]
fn a_wrong_order_moves_nothing() {
    let mut particles = row_of_particles(3);
    let before = (particles.id.clone(), particles.motion.clone());
    assert!(particles.reorder(&[0, 0, 1]).is_err());
    assert!(particles.reorder(&[0, 1]).is_err());
    assert!(particles.extra.reorder(&[0, 1, 3]).is_err());
    assert_eq!((particles.id, particles.motion), before);
}

#[test]
fn unusable_numbers_are_refused_and_leave_no_half_of_a_fill() {
    let mut particles = row_of_particles(2);
    let zero = Vector2::zeros();
    assert!(
        particles
            .push(Vector2::new(f64::NAN, 0.0), zero, 1.0, 1.0)
            .is_err()
    );
    assert!(
        particles
            .push(zero, Vector2::new(0.0, f64::INFINITY), 1.0, 1.0)
            .is_err()
    );
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert!(particles.push(zero, zero, bad, 1.0).is_err());
        assert!(particles.push(zero, zero, 1.0, bad).is_err());
        let good = seeds(vec![zero], vec![1.0]);
        assert!(particles.extend_from_seeds(&good, bad, 1.0).is_err());
        assert!(particles.extend_from_seeds(&good, 1.0, bad).is_err());
        let half = seeds(vec![zero; 2], vec![1.0, bad]);
        assert!(particles.extend_from_seeds(&half, 1.0, 1.0).is_err());
    }
    assert!(
        particles
            .extend_from_seeds(&seeds(vec![zero; 2], vec![1.0]), 1.0, 1.0)
            .is_err()
    );
    particles.check().unwrap();
    assert_eq!(particles.len(), 2);
    assert_eq!(particles.push(zero, zero, 1.0, 1.0).unwrap(), ParticleId(2));
    assert_eq!(particles.extra.get::<Heat>().unwrap().len(), 3);
}

#[test]
fn optional_columns_are_saved_and_loaded_bit_for_bit() {
    let mut extra = Extra::with_len(3);
    // A signalling pattern with a payload, the negative zero and a subnormal: equality of floats would not tell.
    let odd = [
        f64::from_bits(0x7FF8_0000_DEAD_BEEF),
        -0.0,
        f64::from_bits(3),
    ];
    for (entry, value) in extra.ensure::<Affine<2>>().unwrap().iter_mut().zip(odd) {
        entry.0 = Matrix2::new(value, 1.0 / 3.0, f64::MAX, value);
    }
    extra.ensure::<Heat>().unwrap()[1].zone = 513;
    assert_eq!(extra.names().collect::<Vec<_>>(), ["affine-2d", "heat"]);

    let mut restored = Extra::with_len(3);
    restored.ensure::<Heat>().unwrap();
    restored.ensure::<Affine<2>>().unwrap();
    for name in extra.names() {
        restored.load(name, &extra.save(name).unwrap()).unwrap();
    }
    let bits = |extra: &Extra| -> Vec<u64> {
        let column = extra.get::<Affine<2>>().unwrap();
        column
            .iter()
            .flat_map(|entry| entry.0.iter().map(|v| v.to_bits()))
            .collect()
    };
    assert_eq!(bits(&restored), bits(&extra));
    assert_eq!(restored.get::<Heat>(), extra.get::<Heat>());
}

#[test]
fn wrong_bytes_are_refused_and_leave_the_column() {
    let mut extra = Extra::with_len(2);
    extra.ensure::<Heat>().unwrap()[0].zone = 7;
    let bytes = extra.save("heat").unwrap();
    assert!(matches!(
        extra.load("cold", &bytes),
        Err(ExtraError::UnknownColumn { .. })
    ));
    assert!(matches!(
        extra.save("cold"),
        Err(ExtraError::UnknownColumn { .. })
    ));
    assert!(matches!(
        extra.load("heat", &bytes[..bytes.len() - 1]),
        Err(ExtraError::Decode { .. })
    ));
    assert!(matches!(
        extra.load("heat", &[]),
        Err(ExtraError::Decode { .. })
    ));
    let long: Vec<u8> = bytes.iter().copied().chain([0]).collect();
    assert!(matches!(
        extra.load("heat", &long),
        Err(ExtraError::LeftOver { left: 1, .. })
    ));
    let mut other = Extra::with_len(3);
    other.ensure::<Heat>().unwrap();
    assert!(matches!(
        other.load("heat", &bytes),
        Err(ExtraError::Length {
            found: 2,
            expected: 3,
            ..
        })
    ));
    assert_eq!(extra.get::<Heat>().unwrap()[0].zone, 7);
}

#[test]
fn columns_are_told_apart_by_type() {
    let mut extra = Extra::with_len(2);
    assert!(extra.get::<Heat>().is_none());
    extra.ensure::<Heat>().unwrap()[1].zone = 5;
    assert_eq!(
        extra.ensure::<Heat>().unwrap()[1].zone,
        5,
        "asking again keeps it"
    );
    assert!(matches!(
        extra.ensure::<OtherHeat>(),
        Err(ExtraError::NameTaken { name: "heat", .. })
    ));
    assert!(extra.get::<OtherHeat>().is_none());
    assert!(extra.get_mut::<OtherHeat>().is_none());
    assert!(extra.take::<OtherHeat>().is_none());
    assert!(extra.put(vec![OtherHeat; 2]).is_err());
    extra.ensure::<Affine<3>>().unwrap();
    let heat = extra.take::<Heat>().unwrap();
    assert!(extra.get::<Heat>().is_none());
    assert!(extra.put(vec![Heat::default()]).is_err());
    extra.put(heat).unwrap();
    assert_eq!(extra.clone().get::<Heat>().unwrap()[1].zone, 5);
}

#[test]
fn a_motion_survives_serde() {
    let mut particles = Particles::<3>::default();
    particles
        .push(Vector3::new(0.1, -0.0, 1e-310), Vector3::zeros(), 1.0, 1.0)
        .unwrap();
    let bytes = postcard::to_stdvec(&particles.motion).unwrap();
    let back: fissure_particles::Motion<3> = postcard::from_bytes(&bytes).unwrap();
    assert_eq!(back, particles.motion);
}

proptest! {
    #[test]
    fn reordering_moves_all_columns_together_and_back(keys in prop::collection::vec(any::<u64>(), 1..60)) {
        let before = row_of_particles(keys.len());
        let mut particles = before.clone();
        let mut order = Vec::new();
        sort_permutation(&keys, &mut order);
        particles.reorder(&order).unwrap();
        let heat = particles.extra.get::<Heat>().unwrap();
        for (row, &old) in order.iter().enumerate() {
            let x = f64::from(old);
            prop_assert_eq!(particles.id[row].0, old);
            prop_assert_eq!(particles.mass[row], 2.0 + x);
            prop_assert_eq!(particles.volume[row], 1.0 + x);
            prop_assert_eq!(particles.motion.position[row], Vector2::new(x, -x));
            prop_assert_eq!(particles.motion.velocity[row][0], 0.5 * x);
            prop_assert_eq!(particles.motion.deformation_gradient[row][(0, 1)], x);
            prop_assert_eq!(particles.motion.stress[row].mandel[5], 3.0 * x);
            prop_assert_eq!(heat[row].temperature, 300.0 + x);
        }
        let ids: Vec<u64> = particles.id.iter().map(|id| u64::from(id.0)).collect();
        sort_permutation(&ids, &mut order);
        particles.reorder(&order).unwrap();
        prop_assert_eq!(&particles.id, &before.id);
        prop_assert_eq!(&particles.mass, &before.mass);
        prop_assert_eq!(&particles.motion, &before.motion);
        prop_assert_eq!(particles.extra.get::<Heat>(), before.extra.get::<Heat>());
    }
}
