//! One plane: against the single-crack law, energies, contact.

use super::*;
use crate::Cracking;
use crate::contract::{Random, tangent_error};
use crate::{Decohesive, Normal};

/// With the choices of the document the law is the single-crack one.
#[test]
fn one_plane_is_the_single_crack_law() -> Result<(), MaterialError> {
    let several = law::<1>(Unloading::Permanent, Shear::Elastic, Planes::Fixed);
    let single = Decohesive {
        elastic: CONCRETE,
        strength: 2.7e6,
        toughness: 61.35,
        softening: Linear,
        normal: Normal::Rankine,
    };
    let (mut random, band) = (Random::new(1), Band::Projected([0.01, 0.02, 0.015]));
    for _ in 0..100 {
        let (mut a, mut b) = (several.initial(), single.initial());
        let main = random.strain_direction(false) * random.log_uniform(1e-4, 2e-2);
        let mut from = Sym::ZERO;
        for _ in 0..10 {
            let to = main * random.uniform(-0.3, 1.0)
                + random.strain_direction(false) * random.log_uniform(1e-6, 1e-3);
            let step = step_to(&from, &to, band);
            let (x, y) = (several.update(&step, &a)?, single.update(&step, &b)?);
            let round_off = 1e-13 * CONCRETE.young * (to.norm() + 1e-4);
            assert!((x.stress - y.stress).max_abs() < round_off);
            assert!((x.dissipated - y.dissipated).abs() < 1e-10 * 61.35 / 0.01);
            assert!((x.stored - y.stored).abs() < 1e-10 * (y.stored + 1.0));
            (a, b, from) = (x.state, y.state, to);
        }
    }
    Ok(())
}

/// P8 along 1000 random load-unload-contact paths in opening: the energy to failure is G.
#[test]
fn energy_to_failure_is_the_toughness_on_random_paths() -> Result<(), MaterialError> {
    let mut random = Random::new(8);
    for index in 0..1000 {
        let unloading = CHOICES[index % 6].0;
        let law = law::<1>(unloading, CHOICES[index % 6].1, Planes::Fixed);
        let width = random.log_uniform(1e-3, 0.99) * law.band_limit(&Scale::default());
        let pull = Sym::dyad(&random.direction());
        let failure = 2.7e6 / CONCRETE.young + 2.0 * 61.35 / 2.7e6 / width;
        let (mut state, mut from, mut dissipated) = (law.initial(), Sym::ZERO, 0.0);
        for part in 1..=40 {
            let level = if part == 40 {
                1.2
            } else if random.chance(0.3) {
                random.uniform(-0.5, 0.5)
            } else {
                f64::from(part) / 40.0
            };
            let to = pull * (failure * level);
            let step = step_to(&from, &to, Band::Uniform(width));
            let response = law.update(&step, &state)?;
            dissipated += response.dissipated;
            (state, from) = (response.state, to);
        }
        assert!(state.planes()[0].failed);
        assert!((dissipated * width / 61.35 - 1.0).abs() < 1e-6);
    }
    Ok(())
}

#[test]
fn secant_unloading_goes_to_the_origin_and_shuts() -> Result<(), MaterialError> {
    let law = law::<1>(Unloading::Secant, Shear::Coulomb(0.0), Planes::Fixed);
    let band = Band::Uniform(0.01);
    let along = |strain: f64| Sym::diagonal(strain, 0.0, 0.0);
    let open = law.update(&step_to(&Sym::ZERO, &along(2e-3), band), &law.initial())?;
    let rest = law.update(&step_to(&along(2e-3), &Sym::ZERO, band), &open.state)?;
    assert!(rest.stress.max_abs() < 1e-9 && rest.state.planes()[0].opening == 0.0);
    assert!(rest.stored.abs() < 1e-12 && rest.dissipated == 0.0);
    let half = law.update(&step_to(&along(2e-3), &along(1e-3), band), &open.state)?;
    let ratio = half.state.planes()[0].opening / open.state.planes()[0].opening;
    assert!((ratio - 0.5).abs() < 1e-12, "{ratio}");
    let shut = law.update(&step_to(&along(2e-3), &along(-1e-3), band), &open.state)?;
    let sound = law.update(&step_to(&Sym::ZERO, &along(-1e-3), band), &law.initial())?;
    let gap = (shut.stress - sound.stress).max_abs();
    assert!(gap < 1e-6, "{gap:e} of {:e}", sound.stress.max_abs());
    Ok(())
}

/// X17: failed, pressed shut, sheared past the friction limit, and pulled open again.
#[test]
fn a_failed_plane_slides_by_coulomb_and_lets_go() -> Result<(), MaterialError> {
    let friction = 0.4;
    let law = law::<1>(
        Unloading::Permanent,
        Shear::Coulomb(friction),
        Planes::Fixed,
    );
    let band = Band::Uniform(0.01);
    let path = [
        Sym::diagonal(2e-2, 0.0, 0.0),
        Sym::diagonal(-1e-4, 0.0, 0.0),
        Sym::new(-1e-4, 0.0, 0.0, 0.0, 0.0, 1e-5),
        Sym::new(-1e-4, 0.0, 0.0, 0.0, 0.0, 3e-4),
        Sym::new(1e-3, 0.0, 0.0, 0.0, 0.0, 3e-4),
    ];
    let (mut state, mut from, mut seen) = (law.initial(), Sym::ZERO, Vec::new());
    for to in path {
        let response = law.update(&step_to(&from, &to, band), &state)?;
        assert!(response.dissipated >= 0.0);
        seen.push((response.stress, response.dissipated));
        (state, from) = (response.state, to);
    }
    let pressure = CONCRETE.p_wave_modulus() * 1e-4;
    assert!((seen[1].0.xx() / -pressure - 1.0).abs() < 1e-3);
    let stuck = 2.0 * CONCRETE.shear_modulus() * 1e-5;
    assert!((seen[2].0.xy() / stuck - 1.0).abs() < 1e-3 && seen[2].1 == 0.0);
    assert!((seen[3].0.xy() / (friction * pressure) - 1.0).abs() < 2e-3);
    assert!(seen[3].1 > 0.0);
    assert!(seen[4].0.xx().abs() < 1e-3 && seen[4].0.xy().abs() < 1e-3);
    Ok(())
}

/// P3 under pressure, where an opening of round-off is none: neither may it part the faces, nor take the friction away.
#[test]
fn a_plane_open_by_round_off_is_shut() -> Result<(), MaterialError> {
    let rest = Sym::diagonal(-4e-5, 0.0, 0.0);
    for (failed, softened) in [(false, 0.02), (true, 2.0)] {
        let law = law::<1>(Unloading::Secant, Shear::Coulomb(0.5), Planes::Fixed);
        let plane = Plane {
            normal: [1.0, 0.0, 0.0],
            opening: 3e-21,
            traction: [-1e6, 0.0, 0.0],
            width: 0.01,
            softened,
            failed,
            ..Plane::default()
        };
        let state = MultiCrackState::from_planes(&[plane]);
        for shear in [1e-5, 2e-4] {
            let pressed = Sym::new(-1e-4, 0.0, 0.0, 0.0, 0.0, shear);
            let step = step_to(&rest, &pressed, Band::Uniform(0.01));
            let stiffness = CONCRETE.p_wave_modulus();
            let error = tangent_error(&law, &step, &state, stiffness, &[1e-6, 1e-7])?;
            assert!(error < 1e-8, "{failed} {shear}: {error:e}");
            let traction = law.update(&step, &state)?.stress.traction(&Vector3::x());
            let held = 2.0 * CONCRETE.shear_modulus() * shear;
            let carried = traction.y.abs() / held.min(-0.5 * traction.x);
            assert!((carried - 1.0).abs() < 1e-3, "{failed} {shear}: {carried}");
        }
    }
    Ok(())
}
