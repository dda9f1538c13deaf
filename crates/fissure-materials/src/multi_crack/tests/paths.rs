//! Several planes: order, threshold, consistency, many planes, and a fuzz.

use super::*;
use crate::Cracking;
use crate::contract::{Random, tangent_error};
use crate::material::difference_tangent;

const BAND: Band = Band::Uniform(0.01);

/// A walk that turns, unloads and presses.
fn walk(random: &mut Random, plane: bool) -> Vec<Sym> {
    let size = random.log_uniform(2e-4, 5e-3);
    let count = random.integer(3, 12);
    let mut points = vec![Sym::ZERO];
    for _ in 0..count {
        let mut next = random.strain_direction(false) * (size * random.uniform(0.2, 1.5));
        if plane {
            next.mandel[2] = 0.0;
            next.mandel[3] = 0.0;
            next.mandel[4] = 0.0;
        }
        points.push(next);
    }
    points
}

/// P17: after any history, storing the planes in another order changes the next step by round-off
/// only, and every plane ends with `F_j ≤ tol` (P5) and its normal at least the threshold from the
/// others.
#[test]
fn storage_order_does_not_matter_and_every_plane_is_returned() -> Result<(), MaterialError> {
    let mut random = Random::new(17);
    let mut most = 0;
    for index in 0..120 {
        let (unloading, shear) = CHOICES[index % 6];
        let law = law::<20>(unloading, shear, Planes::Multiple(None));
        let (mut state, points) = (law.initial(), walk(&mut random, index % 2 == 0));
        for pair in points.windows(2) {
            let step = step_to(&pair[0], &pair[1], BAND);
            let mut reversed: Vec<Plane> = state.planes().to_vec();
            reversed.reverse();
            let other = MultiCrackState::<20>::from_planes(&reversed);
            let (a, b) = (law.update(&step, &state)?, law.update(&step, &other)?);
            let gap = (a.stress - b.stress).max_abs();
            assert!(gap < 1e-7 * 2.7e6, "{shear:?}: {gap:e}");
            let tractions = a.state.planes().iter().map(|plane| {
                let traction = plane.normal().dot(&Vector3::from(plane.traction));
                traction / 2.7e6 - law.decohesion.ratio(plane.softened)
            });
            let worst = tractions.fold(f64::NEG_INFINITY, f64::max);
            assert!(worst < 1e-9, "{worst:e}");
            let planes = a.state.planes();
            for (i, first) in planes.iter().enumerate() {
                for second in &planes[..i] {
                    let sine_squared = first.normal().cross(&second.normal()).norm_squared();
                    assert!(
                        sine_squared >= law.threshold(second, &Band::Uniform(0.01)) * (1.0 - 1e-12)
                    );
                }
            }
            state = a.state;
        }
        most = most.max(state.planes().len());
    }
    assert!(most >= 6, "{most}");
    Ok(())
}

/// X16: principal axes that keep turning start plane after plane.
#[test]
fn twenty_planes_are_stored_and_returned() -> Result<(), MaterialError> {
    let law = law::<20>(Unloading::Permanent, Shear::Elastic, Planes::Multiple(None));
    let mut random = Random::new(16);
    let (mut state, mut from) = (law.initial(), Sym::ZERO);
    for index in 0..400 {
        let size = 1e-4 * (1.0 + 0.02 * f64::from(index));
        let to = random.strain_direction(false) * size;
        let response = law.update(&step_to(&from, &to, BAND), &state)?;
        assert!(response.dissipated >= 0.0 && response.stress.is_finite());
        (state, from) = (response.state, to);
    }
    assert_eq!(state.planes().len(), 20);
    Ok(())
}

/// The bound is `2μ sin²θ > τ² L/(2G)` for linear softening, and it is where the return of two
/// planes loses its uniqueness: the determinant of `A` changes sign there.
#[test]
fn threshold_is_the_bound_of_uniqueness() {
    let law = law::<2>(Unloading::Permanent, Shear::Elastic, Planes::Multiple(None));
    let (width, mu) = (0.05, CONCRETE.shear_modulus());
    let softening = 2.7e6_f64.powi(2) * width / (2.0 * 61.35);
    assert!((law.unique_above(width) / (softening / (2.0 * mu)) - 1.0).abs() < 1e-14);
    let determinant = |sine_squared: f64| {
        let own = CONCRETE.p_wave_modulus() - softening;
        let mixed = CONCRETE.lambda() + 2.0 * mu * (1.0 - sine_squared);
        own * own - mixed * mixed
    };
    let bound = law.unique_above(width);
    assert!(determinant(bound * 1.001) > 0.0 && determinant(bound * 0.999) < 0.0);
    // A threshold below the bound is refused at the door.
    let below = MultiCrack {
        planes: Planes::Multiple(Some((0.99 * bound).sqrt().asin())),
        ..law
    };
    let above = MultiCrack {
        planes: Planes::Multiple(Some((1.01 * bound).sqrt().asin())),
        ..law
    };
    let (band, scale) = (Band::Uniform(width), Scale::default());
    assert!(matches!(
        below.check_band(&band, &scale),
        Err(MaterialError::Band { .. })
    ));
    assert_eq!(above.check_band(&band, &scale), Ok(()));
    for angle in [0.0, -0.1, 1.6, f64::NAN] {
        let wrong = MultiCrack {
            planes: Planes::Multiple(Some(angle)),
            ..law
        };
        assert!(wrong.check().is_err(), "{angle}");
    }
}

/// P17 for geological flow, whose planes may run in circles: the rule of selection does not see the storage order.
#[test]
fn storage_order_does_not_matter_to_geological_flow() -> Result<(), MaterialError> {
    let mut random = Random::new(18);
    let mut most = 0;
    for _ in 0..40 {
        let law = geological::<6>(None, Planes::Multiple(None));
        let (mut state, points) = (law.initial(), walk(&mut random, false));
        for pair in points.windows(2) {
            let step = step_to(&pair[0], &pair[1], BAND);
            let mut reversed: Vec<Plane> = state.planes().to_vec();
            reversed.reverse();
            let other = MultiCrackState::<6>::from_planes(&reversed);
            let (a, b) = (law.update(&step, &state)?, law.update(&step, &other)?);
            let gap = (a.stress - b.stress).max_abs();
            assert!(gap < 1e-7 * 2.7e6, "{gap:e}");
            state = a.state;
            most = most.max(state.planes().len());
        }
    }
    assert!(most > 3, "{most}");
    Ok(())
}

/// How far the tangent at the end of a walk is from Richardson differences with a step of 1e-5 of the failure strain
/// u₀/L = 4.5e-3, over the stiffness or its largest entry.
fn tangent_gap<M: Material>(law: &M, points: &[Sym], last: &Sym) -> Result<f64, MaterialError> {
    let (mut state, mut from) = (law.initial(), Sym::ZERO);
    for to in points {
        state = law.update(&step_to(&from, to, BAND), &state)?.state;
        from = *to;
    }
    let step = step_to(&from, last, BAND);
    let tangent = law.tangent(&step, &state)?;
    let difference = |h: f64| difference_tangent(law, &step, &state, h);
    let (coarse, fine) = (difference(4.5e-8)?, difference(2.25e-8)?);
    let richardson = fine * (4.0 / 3.0) - coarse * (1.0 / 3.0);
    Ok((tangent - richardson).max_abs() / CONCRETE.p_wave_modulus().max(tangent.max_abs()))
}

/// The tangent of planes that move together, start, or turn, within 1e-8 |C| of differences (P3): going on, and with a
/// pull in a new direction that starts further planes.
#[test]
fn tangent_of_several_planes_is_that_of_differences() -> Result<(), MaterialError> {
    let mut random = Random::new(3);
    let (mut checked, mut kinks) = (0, 0);
    for index in 0..120 {
        let (unloading, shear) = CHOICES[index % 6];
        let points = walk(&mut random, false);
        let last = if index % 2 == 0 {
            points[points.len() - 1] * 1.02
        } else {
            Sym::dyad(&random.direction()) * random.log_uniform(2e-4, 2e-3)
        };
        let several = Planes::Multiple(None);
        let gap = match index % 10 {
            0..=6 => tangent_gap(&law::<6>(unloading, shear, several), &points, &last)?,
            7 => tangent_gap(
                &law::<1>(unloading, shear, Planes::Rotating),
                &points,
                &last,
            )?,
            8 => tangent_gap(&geological::<1>(Some(0.6), Planes::Fixed), &points, &last)?,
            _ => tangent_gap(&geological::<6>(None, several), &points, &last)?,
        };
        let round_off = 3e-16 / 4.5e-8 * 10.0;
        if gap < 1e-8 + round_off {
            checked += 1;
        } else {
            kinks += 1;
            println!("{index}: {gap:e}");
        }
    }
    println!("{checked} agree, {kinks} do not");
    assert_eq!((checked, kinks), (120, 0));
    Ok(())
}

/// Over bands that depend on the direction a plane may start on the cone of another all the same, and its band turns with it.
#[test]
fn tangent_of_planes_that_start_over_a_band_with_a_direction() {
    let mut random = Random::new(7);
    let bands = [
        Band::Projected([0.05, 0.08, 0.11]),
        Band::Section([0.05, 0.08, 0.13]),
    ];
    let (mut on_cones, mut off, mut refused) = (0, 0, 0);
    for index in 0..600 {
        let (unloading, shear) = CHOICES[index % 6];
        let law = law::<6>(unloading, shear, Planes::Multiple(None));
        let band = bands[index % 2];
        let points = walk(&mut random, false);
        let last = Sym::dyad(&random.direction()) * random.log_uniform(2e-4, 2e-3);
        let Ok((gap, state)) = tangent_and_end(&law, band, &points, &last) else {
            refused += 1;
            continue;
        };
        let planes = state.planes();
        let is_on = |a: &Plane, b: &Plane| {
            let sine_squared = a.normal().cross(&b.normal()).norm_squared();
            assert!(sine_squared >= law.threshold(a, &band) * (1.0 - 1e-12));
            sine_squared < law.threshold(a, &band) * (1.0 + 1e-6)
        };
        let mut pairs = (1..planes.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
        on_cones += u32::from(pairs.any(|(j, i)| is_on(&planes[j], &planes[i])));
        if !(gap < 1e-6) {
            off += 1;
            println!("{index}: {gap:e}");
        }
    }
    println!("{on_cones} with planes on a cone, {off} tangents off, {refused} refused");
    assert_eq!(off, 0);
    assert!(on_cones > 50 && refused <= 6);
}

/// How far the tangent of a last step is from the nearest of some quotients, to either side, over the stiffness; and where
/// the step ends.
fn tangent_and_end<M: Material>(
    law: &M,
    band: Band,
    points: &[Sym],
    last: &Sym,
) -> Result<(f64, M::State), MaterialError> {
    let (mut state, mut from) = (law.initial(), Sym::ZERO);
    for to in points {
        state = law.update(&step_to(&from, to, band), &state)?.state;
        from = *to;
    }
    let step = step_to(&from, last, band);
    let stiffness = CONCRETE.p_wave_modulus();
    let gap = tangent_error(law, &step, &state, stiffness, &[1e-6, 1e-7, 1e-8, 1e-9])?;
    Ok((gap, law.update(&step, &state)?.state))
}

/// What a fuzz counts.
#[derive(Debug, Default)]
struct Counts {
    updates: u32,
    errors: u32,
}

/// Steps from 1e-12 to 10 with det F in 0.2 to 5: no NaN, no panic, no negative dissipation, nothing
/// irreversible undone, few typed errors.
fn fuzz<M: Cracking>(law: &M, updates: u32, seed: u64) -> Counts {
    let mut random = Random::new(seed);
    let mut counts = Counts::default();
    let (mut state, mut strain) = (law.initial(), Sym::ZERO);
    while counts.updates < updates {
        if random.chance(0.05) {
            (state, strain) = (law.initial(), Sym::ZERO);
        }
        let to = strain + random.strain_direction(true) * random.log_uniform(1e-12, 10.0);
        let step = step_to(&strain, &to, BAND);
        let jacobian = step.jacobian();
        if !(0.2..=5.0).contains(&jacobian) || to.eigenvalues()[2] <= -1.0 {
            (state, strain) = (law.initial(), Sym::ZERO);
            continue;
        }
        counts.updates += 1;
        let before = law.irreversible(&state);
        match law.update(&step, &state) {
            Ok(response) => {
                assert!(response.stress.is_finite() && response.stored.is_finite());
                assert!(response.dissipated >= 0.0, "{}", response.dissipated);
                let now = law.irreversible(&response.state);
                assert!(before.iter().zip(&now).all(|(b, n)| n >= b));
                (state, strain) = (response.state, to);
            }
            Err(_) => counts.errors += 1,
        }
    }
    assert!(counts.errors * 100 <= updates, "{counts:?}");
    counts
}

#[test]
fn any_step_ends() {
    const UPDATES: u32 = 2000;
    for (unloading, shear) in CHOICES {
        let one = fuzz(&law::<1>(unloading, shear, Planes::Fixed), UPDATES, 1);
        let more = fuzz(
            &law::<6>(unloading, shear, Planes::Multiple(None)),
            UPDATES,
            2,
        );
        println!("{unloading:?} {shear:?}: one {one:?}, several {more:?}");
    }
    let rubbing = Shear::Damaged(0.5);
    let planes = Planes::Multiple(None);
    let friction = fuzz(&law::<6>(Unloading::Secant, rubbing, planes), UPDATES, 3);
    let rotating = law::<1>(Unloading::Secant, Shear::Elastic, Planes::Rotating);
    println!(
        "friction {friction:?}, rotating {:?}",
        fuzz(&rotating, UPDATES, 4)
    );
}

#[test]
fn any_step_of_geological_flow_ends() {
    const UPDATES: u32 = 1000;
    for friction in [None, Some(0.6)] {
        let one = fuzz(&geological::<1>(friction, Planes::Fixed), UPDATES, 5);
        println!("geological {friction:?}: {one:?}");
        let several = fuzz(&geological::<6>(friction, Planes::Multiple(None)), 300, 6);
        println!("several {several:?}");
    }
}
