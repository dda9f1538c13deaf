//! Geological flow: the surface, the flow rule, energy.

use super::*;
use crate::{contract::Random, criteria::OnPlane};

const BAND: Band = Band::Uniform(0.01);

/// P5 and 3.5.64: a plane that moved and has not failed is on the surface, and its jump followed the
/// gradient there.
#[test]
fn moving_planes_are_on_the_surface_and_follow_the_flow() -> Result<(), MaterialError> {
    let law = geological::<1>(None, Planes::Fixed);
    let mut random = Random::new(64);
    let mut sliding = 0;
    for _ in 0..400 {
        let pressed = Sym::IDENTITY * random.uniform(1e-3, 6e-3);
        let to = random.strain_direction(false) * random.log_uniform(1e-3, 1.5e-2) - pressed;
        let Ok(response) = law.update(&step_to(&Sym::ZERO, &to, BAND), &law.initial()) else {
            panic!("no answer to {to:?}");
        };
        let Some(plane) = response.state.planes().first() else {
            continue;
        };
        if plane.failed || plane.opening == 0.0 {
            continue;
        }
        let f = Matrix3::identity() + to.to_matrix();
        let stress = Biot::new(&f)?.conjugate(&response.stress);
        let on_plane = OnPlane::new(&stress, &plane.normal());
        let partials = law
            .decohesion
            .surface
            .flow_partials(&on_plane, 1.0 - 0.5 * plane.softened);
        assert!(partials.value.abs() < 1e-8, "{}", partials.value);
        let shear = on_plane.shear_squared.sqrt();
        if shear > 1e-3 * 2.7e6 {
            sliding += 1;
            let flow = (partials.normal, 2.0 * shear * partials.shear_squared);
            let cross = plane.opening * flow.1 - plane.slip().norm() * flow.0;
            let size = plane.jump().norm() * flow.0.hypot(flow.1);
            assert!(cross.abs() < 1e-6 * size, "{:e}", cross / size);
        }
    }
    assert!(sliding > 10, "{sliding}");
    Ok(())
}

/// P8: without lateral contraction opening is pure, and the energy is G on any path.
#[test]
fn energy_to_failure_in_pure_opening_is_the_toughness() -> Result<(), MaterialError> {
    let mut law = geological::<1>(Some(0.6), Planes::Fixed);
    law.elastic.poisson = 0.0;
    let mut random = Random::new(8);
    for _ in 0..100 {
        let width = random.log_uniform(1e-3, 0.99) * law.limit();
        let failure = 2.7e6 / law.elastic.young + 2.0 * 61.35 / 2.7e6 / width;
        let (mut state, mut from, mut dissipated) = (law.initial(), Sym::ZERO, 0.0);
        for part in 1..=40 {
            let level = match part {
                40 => 1.2,
                _ if random.chance(0.3) => random.uniform(-1e-4 / failure, 0.5),
                _ => f64::from(part) / 40.0,
            };
            let to = Sym::diagonal(failure * level, 0.0, 0.0);
            let step = step_to(&from, &to, Band::Uniform(width));
            let response = law.update(&step, &state)?;
            dissipated += response.dissipated;
            (state, from) = (response.state, to);
        }
        assert!(state.planes()[0].failed);
        let error = dissipated * width / 61.35 - 1.0;
        assert!(error.abs() < 1e-6, "{error:e}");
    }
    Ok(())
}

/// Under pressure the shear traction stays under that of large pressure, τ_sm, and the law gives no
/// energy: every step dissipates, stored and dissipated energy are the work as steps shrink.
#[test]
fn sheared_under_pressure_it_slides_and_dissipates() -> Result<(), MaterialError> {
    let law = geological::<1>(None, Planes::Fixed);
    let mut errors = Vec::new();
    for steps in [100, 1000] {
        let (mut state, mut from) = (law.initial(), Sym::ZERO);
        let (mut stress, mut work, mut dissipated, mut stored) = (Sym::ZERO, 0.0, 0.0, 0.0);
        let corners = [
            Sym::diagonal(-4e-3, -4e-3, -4e-3),
            Sym::new(-4e-3, -4e-3, -4e-3, 0.0, 0.0, 8e-3),
        ];
        for corner in corners {
            let start = from;
            for part in 1..=steps {
                let share = f64::from(part) / f64::from(steps);
                let to = start * (1.0 - share) + corner * share;
                let step = step_to(&from, &to, BAND);
                let response = law.update(&step, &state)?;
                let next = Biot::new(&step.f_new)?.conjugate(&response.stress);
                work += 0.5 * (next + stress).dot(&(to - from));
                dissipated += response.dissipated;
                stored = response.stored;
                (state, from, stress) = (response.state, to, next);
            }
        }
        let plane = state.planes()[0];
        let shear = Vector3::from(plane.traction)
            - plane.normal() * plane.normal().dot(&Vector3::from(plane.traction));
        assert!(shear.norm() <= Geological::CONCRETE.confined_shear_strength);
        assert!(plane.slip().norm() > 0.0 && dissipated > 0.0);
        errors.push(((stored + dissipated) / work - 1.0).abs());
    }
    assert!(
        errors[1] < 0.3 * errors[0] + 1e-9 && errors[1] < 1e-4,
        "{errors:?}"
    );
    Ok(())
}
