//! The history integral against quadratures and closed forms.

use super::*;

/// A path of strain along one axis, `strain(t)` over `[0, end]` in equal steps, against the
/// integral of eq. 4 by a fine midpoint rule. Returns the largest error of the damage.
fn history_error(
    relaxation: Relaxation,
    strain: impl Fn(f64) -> f64,
    end: f64,
    steps: usize,
) -> f64 {
    let law = lagging(relaxation);
    let at = |t: f64| {
        let strain = strain(t);
        let mut f = Matrix3::identity();
        f.m11 += strain;
        f
    };
    let kappa = |t: f64| {
        let f = at(t);
        law.surface
            .equivalent(&Sym::diagonal(f.m11 - 1.0, 0.0, 0.0))
    };
    let dt = end / steps as f64;
    let (mut state, mut largest) = (law.initial(), 0.0_f64);
    let mut parcels = Vec::new();
    let mut highest = 0.0_f64;
    for step in 1..=steps {
        let (from, to) = (dt * (step as f64 - 1.0), dt * step as f64);
        const PARTS: usize = 20;
        for part in 0..PARTS {
            let (a, b) = (
                part as f64 / PARTS as f64,
                (part as f64 + 1.0) / PARTS as f64,
            );
            let (a, b) = (from + (to - from) * a, from + (to - from) * b);
            let rate = (kappa(b) - kappa(a)) / (b - a);
            let grown = law.static_damage(kappa(b).max(highest)).0 - law.static_damage(highest).0;
            highest = highest.max(kappa(b));
            if grown > 0.0 {
                parcels.push((0.5 * (a + b), grown, relaxation.time_at(rate).0));
            }
        }
        let increment = between(at(from), at(to), dt);
        state = law.update(&increment, &state).expect("a sound step").state;
        let left: f64 = parcels
            .iter()
            .map(|(at, grown, time)| grown * relaxation.remaining((to - at) / time))
            .sum();
        largest = largest.max((state.static_damage - state.damage - left).abs());
    }
    largest
}

/// Eq. 4 against a direct quadrature that forgets nothing: rates constant, varying and stopping.
#[test]
fn the_history_integral_is_that_of_the_source() {
    let steady = |t: f64| 6e-4 * t;
    let uneven = |t: f64| 6e-4 * (t + 0.12 * (8.0 * t).sin());
    let stopped = |t: f64| 6e-4 * (2.0 * t).min(0.7).max(t);
    let base = Relaxation {
        time: 0.002,
        rate_exponent: 0.5,
        ..FITTED
    };
    for (name, exponent, bounds) in [
        ("exponential", 1.0, [1e-5, 1e-3, 1e-4]),
        ("stretched", 0.6, [1e-2, 1e-2, 1e-2]),
        ("compressed", 1.5, [1e-2, 1e-2, 1e-2]),
    ] {
        let relaxation = Relaxation { exponent, ..base };
        let errors = [
            history_error(relaxation, steady, 1.0, 500),
            history_error(relaxation, uneven, 1.0, 500),
            history_error(relaxation, stopped, 1.0, 500),
        ];
        println!(
            "{name}: largest error of the damage, steady {:.1e}, uneven {:.1e}, stopped {:.1e}",
            errors[0], errors[1], errors[2]
        );
        for (error, bound) in errors.iter().zip(bounds) {
            assert!(*error < bound, "{name}: {errors:?}");
        }
    }
}

/// The mean of `H` over a step, in closed form and against a quadrature.
#[test]
fn the_mean_over_a_step_is_the_incomplete_gamma_function() {
    for exponent in [0.3, 0.6, 1.0, 1.7, 4.0] {
        let relaxation = Relaxation { exponent, ..FITTED };
        for x in [1e-9, 1e-5, 0.01, 0.5, 3.0, 200.0] {
            let (mean, slope) = relaxation.mean(x);
            // With ξ = x s^(8/g) the integrand is smooth at 0.
            let (count, power) = (20_000, 8.0 / exponent);
            let sum: f64 = (0..count)
                .map(|i| {
                    let s = (f64::from(i) + 0.5) / f64::from(count);
                    relaxation.remaining(x * s.powf(power)) * power * s.powf(power - 1.0)
                })
                .sum();
            near(mean, sum / f64::from(count), 1e-5);
            let h = 1e-4 * x;
            let difference = (relaxation.mean(x + h).0 - relaxation.mean(x - h).0) / (2.0 * h);
            assert!(
                (difference - slope).abs() <= 1e-6 * slope.abs() + 1e-11 / x,
                "{exponent} {x}"
            );
        }
    }
}

/// Held after damage, a lag of one time falls exponentially, to the last digits, in any steps.
#[test]
fn a_held_strain_relaxes_exponentially() -> Result<(), MaterialError> {
    let relaxation = Relaxation {
        time: 0.3,
        rate_exponent: 0.0,
        ..FITTED
    };
    let law = lagging(relaxation);
    let mut f = Matrix3::identity();
    f.m11 += 3e-4;
    let loaded = Increment::to(f);
    let mut state = law.update(&loaded, &law.initial())?.state;
    let lag = state.static_damage - state.damage;
    assert!(lag > 0.1);
    let mut time = 0.0;
    for dt in [0.01, 0.2, 0.003, 1.0, 0.05] {
        let response = law.update(&between(f, f, dt), &state)?;
        assert!(response.dissipated > 0.0);
        state = response.state;
        time += dt;
        near(
            state.static_damage - state.damage,
            lag * (-time / 0.3).exp(),
            1e-12,
        );
    }
    Ok(())
}

/// Relaxation that is not exponential: in 64 steps or 4096 the stress is the same but for what
/// joining parcels loses, which more steps do not take away.
#[test]
fn a_stretched_lag_depends_on_the_steps_by_what_joining_loses() -> Result<(), MaterialError> {
    let law = lagging(STRETCHED);
    let strain = Sym::new(1.76e-4, 8.76e-5, 0.0, 0.0, 0.0, -1.51e-4).to_matrix();
    let stress_in = |steps: i32| -> Result<f64, MaterialError> {
        let (mut state, mut f, mut stress) = (law.initial(), Matrix3::identity(), 0.0);
        for step in 1..=steps {
            let f_new = Matrix3::identity() + strain * (f64::from(step) / f64::from(steps));
            let response = law.update(&between(f, f_new, 1.0 / f64::from(steps)), &state)?;
            (state, f, stress) = (response.state, f_new, response.stress.xx());
        }
        Ok(stress)
    };
    let few = stress_in(64)?;
    for steps in [128, 256, 512, 1024, 2048, 4096] {
        let many = stress_in(steps)?;
        println!("{steps} steps against 64: {:.1e}", many / few - 1.0);
        near(many, few, 6e-3);
    }
    Ok(())
}
