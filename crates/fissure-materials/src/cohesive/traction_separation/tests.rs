use fissure_tensor::rotation;

use super::*;
use crate::contract::Random;
use crate::softening::{Bilinear, CubicStep, Exponential};

fn law<S>(softening: S) -> TractionSeparation<S> {
    TractionSeparation {
        strength: 2.7e6,
        toughness: 61.35,
        stiffness: 1e13,
        shear_weight: 0.8,
        softening,
    }
}

fn at<S: Softening>(
    law: &TractionSeparation<S>,
    opening: Vector3<f64>,
    old: &TractionSeparationState,
) -> Result<Traction<TractionSeparationState>, MaterialError> {
    law.update(&Jump::new(opening, NORMAL), old)
}

const NORMAL: Vector3<f64> = Vector3::new(0.6, 0.0, 0.8);
const ALONG: Vector3<f64> = Vector3::new(-0.8, 0.0, 0.6);

/// Effective opening by which all but `1e-13` of the toughness is spent.
fn end<S: Softening>(law: &TractionSeparation<S>) -> f64 {
    let mut s = 1.0;
    while law.softening.dissipated_to_origin(s) < 1.0 - 1e-13 {
        s *= 1.25;
    }
    1.01 * law.strength / law.stiffness + s * law.toughness / law.strength
}

/// Opening, closing, reopening in one direction (in normal and shear), to beyond failure; P8.
/// `cargo test -p fissure-materials --lib cohesive -- --nocapture` prints the figures of
/// `docs/laws/cohesive.md`.
#[test]
fn every_mode_spends_the_toughness() -> Result<(), MaterialError> {
    fn ask<S: Softening>(name: &str, law: TractionSeparation<S>) -> Result<(), MaterialError> {
        let mut random = Random::new(4);
        let last = end(&law);
        let (mut closed_form, mut paths): (f64, f64) = (0.0, 0.0);
        for i in 0..1000 {
            // Mode I, mode II, and between.
            let angle = match i % 4 {
                0 => 0.0,
                1 => std::f64::consts::FRAC_PI_2,
                _ => random.uniform(0.0, std::f64::consts::FRAC_PI_2),
            };
            let direction = NORMAL * angle.cos() + ALONG * (angle.sin() / law.shear_weight);
            let whole = at(&law, direction * last, &Default::default())?;
            closed_form = closed_form.max((whole.dissipated / law.toughness - 1.0).abs());
            let parts = random.integer(1, 50);
            let (mut state, mut dissipated) = (TractionSeparationState::default(), 0.0);
            let mut levels = Vec::new();
            for part in 1..=parts {
                let level = last * (part as f64 / parts as f64).powi(2);
                levels.push(level);
                if random.chance(0.4) {
                    // Across into contact, which the law leaves to its caller.
                    levels.push(random.uniform(-0.3, 1.0) * level * angle.cos());
                }
            }
            for level in levels {
                let step = at(&law, direction * level, &state)?;
                assert!(step.dissipated >= 0.0 && step.stored >= 0.0);
                assert!(step.state.largest >= state.largest);
                dissipated += step.dissipated;
                state = step.state;
            }
            paths = paths.max((dissipated / law.toughness - 1.0).abs());
        }
        println!("{name:<12} closed form {closed_form:.1e}  1000 paths {paths:.1e}");
        assert!(closed_form < 1e-8 && paths < 1e-6, "{name}");
        Ok(())
    }
    ask("linear", law(Linear))?;
    ask("bilinear", law(Bilinear::default()))?;
    ask("exponential", law(Exponential))?;
    ask("cubic step", law(CubicStep))
}

#[test]
fn pure_modes_follow_the_curve() -> Result<(), MaterialError> {
    let law = law(Linear);
    let elastic = law.strength / law.stiffness;
    let critical = 2.0 * law.toughness / law.strength;
    assert!((law.critical_opening(&Scale::default()) / critical - 1.0).abs() < 1e-12);
    for part in [0.5, 1.0, 3.0, 20.0, 150.0, 200.0] {
        let opening = part * elastic;
        // The envelope of the nodal cohesion prototypes: σ(1 − (κ − δ_e)/(u₀ − δ_e)).
        let expected = if part <= 1.0 {
            law.stiffness * opening
        } else {
            law.strength * (1.0 - (opening - elastic) / (critical - elastic)).max(0.0)
        };
        let normal = at(&law, NORMAL * opening, &Default::default())?;
        let error = (normal.traction - NORMAL * expected).norm();
        assert!(error < 1e-11 * law.strength, "{part}");
        // In shear the same curve, β times as high and 1/β times as wide.
        let sliding = ALONG * (opening / law.shear_weight);
        let shear = at(&law, sliding, &Default::default())?;
        let error = (shear.traction - ALONG * (law.shear_weight * expected)).norm();
        assert!(error < 1e-11 * law.strength, "{part}");
        assert!((shear.stored - normal.stored).abs() < 1e-12 * law.toughness);
        assert_eq!(normal.state.failed, opening >= critical);
    }
    Ok(())
}

#[test]
fn unloading_goes_straight_to_the_origin_and_closing_meets_no_normal_traction()
-> Result<(), MaterialError> {
    let law = law(Exponential);
    let opening = NORMAL * 3e-5 + ALONG * 1e-5;
    let open = at(&law, opening, &Default::default())?;
    for part in [0.9, 0.5, 0.0] {
        let back = at(&law, opening * part, &open.state)?;
        assert!((back.traction - open.traction * part).norm() < 1e-12 * law.strength);
        assert!((back.stored - open.stored * part * part).abs() < 1e-12 * law.toughness);
        assert!(back.dissipated == 0.0 && back.state == open.state);
    }
    let again = at(&law, opening, &open.state)?;
    assert_eq!((again.traction, again.state), (open.traction, open.state));
    for state in [TractionSeparationState::default(), open.state] {
        let shut = at(&law, NORMAL * -1e-3, &state)?;
        assert!(shut.traction.norm() < 1e-12 * law.strength && shut.stored < 1e-12);
        assert!((shut.tangent * NORMAL).norm() < 1e-9 * law.stiffness);
        let sliding = at(&law, NORMAL * -1e-3 + ALONG * 1e-8, &state)?;
        assert!(sliding.traction.dot(&NORMAL).abs() < 1e-9 * law.strength);
        assert!(sliding.traction.dot(&ALONG) > 0.0);
    }
    Ok(())
}

/// Random jumps around the ends of the elastic part, of softening, and beyond.
fn draw<S: Softening>(law: &TractionSeparation<S>, random: &mut Random) -> Vector3<f64> {
    let low = 0.1 * law.strength / law.stiffness;
    random.direction() * random.log_uniform(low, 3.0 * law.toughness / law.strength)
}

/// P3 and P4, away from kinks: the same branch a percent before and after.
#[test]
fn tangent_is_symmetric_and_within_1e_8_of_extrapolated_differences() -> Result<(), MaterialError> {
    fn ask<S: Softening>(name: &str, law: TractionSeparation<S>) -> Result<(), MaterialError> {
        let mut random = Random::new(5);
        let (mut worst, mut judged): (f64, usize) = (0.0, 0);
        for _ in 0..1000 {
            let jump = draw(&law, &mut random);
            let history = at(&law, draw(&law, &mut random), &Default::default())?;
            for old in [TractionSeparationState::default(), history.state] {
                let branch = |size: f64| -> Result<_, MaterialError> {
                    let step = at(&law, jump * size, &old)?;
                    Ok((
                        step.state == old,
                        step.state.failed,
                        law.softening.slope(1.0),
                    ))
                };
                let skew = jump.dot(&NORMAL).abs() < 0.01 * jump.norm();
                if skew || branch(0.99)? != branch(1.01)? {
                    continue;
                }
                judged += 1;
                let here = at(&law, jump, &old)?;
                assert!((here.tangent - here.tangent.transpose()).norm() < 1e-12 * law.stiffness);
                let size = 1e-4 * jump.norm();
                for axis in 0..3 {
                    let mut unit = Vector3::zeros();
                    unit[axis] = 1.0;
                    let central = |h: f64| -> Result<Vector3<f64>, MaterialError> {
                        let there = at(&law, jump + unit * h, &old)?.traction;
                        Ok((there - at(&law, jump - unit * h, &old)?.traction) / (2.0 * h))
                    };
                    let slope = (central(0.5 * size)? * 4.0 - central(size)?) / 3.0;
                    let gap = (slope - here.tangent.column(axis)).norm();
                    worst = worst.max(gap / law.stiffness);
                }
            }
        }
        println!("{name:<12} tangent error {worst:.1e} K in {judged} states");
        assert!(judged > 1500 && worst < 1e-8, "{name}: {worst:e}, {judged}");
        Ok(())
    }
    ask("linear", law(Linear))?;
    ask("exponential", law(Exponential))?;
    ask("cubic step", law(CubicStep))
}

/// P6: stored plus dissipated energy is the work, along winding paths of jumps as steps shrink.
#[test]
fn stored_and_dissipated_energy_are_the_work() -> Result<(), MaterialError> {
    let law = law(Bilinear::default());
    let mut random = Random::new(6);
    for _ in 0..20 {
        let corners: Vec<_> = (0..5).map(|_| draw(&law, &mut random)).collect();
        let mut errors = Vec::new();
        for steps in [100, 1000, 10_000] {
            let mut last = at(&law, Vector3::zeros(), &Default::default())?;
            let (mut from, mut work, mut dissipated) = (Vector3::zeros(), 0.0, 0.0);
            for corner in &corners {
                let part = (corner - from) / f64::from(steps);
                for _ in 0..steps {
                    from += part;
                    let next = at(&law, from, &last.state)?;
                    work += 0.5 * (next.traction + last.traction).dot(&part);
                    dissipated += next.dissipated;
                    last = next;
                }
            }
            errors.push((last.stored + dissipated - work).abs() / law.toughness);
        }
        assert!(
            errors[2] < 1e-4 && errors[2] <= 0.2 * errors[0] + 1e-12,
            "{errors:?}"
        );
    }
    Ok(())
}

/// P9: the crack's frame turns and all turns with it; −n with the sides exchanged is the same.
#[test]
fn the_frame_does_not_matter() -> Result<(), MaterialError> {
    let law = law(Exponential);
    let mut random = Random::new(7);
    for _ in 0..500 {
        let (first, second) = (draw(&law, &mut random), draw(&law, &mut random));
        let turn = random.turn();
        let q = rotation(&turn, turn.norm());
        let history = at(&law, first, &Default::default())?;
        let base = at(&law, second, &history.state)?;
        let turned = |jump: Vector3<f64>, old: &TractionSeparationState| {
            law.update(&Jump::new(q * jump, q * NORMAL * 2.5), old)
        };
        let start = turned(first, &Default::default())?;
        let there = turned(second, &start.state)?;
        assert!((there.traction - q * base.traction).norm() < 1e-12 * law.strength);
        let expected = q * base.tangent * q.transpose();
        assert!((there.tangent - expected).norm() < 1e-11 * law.stiffness);
        assert!((there.dissipated - base.dissipated).abs() < 1e-12 * law.toughness);
        let other_side = law.update(&Jump::new(-second, -NORMAL), &history.state)?;
        assert_eq!(other_side.traction, -base.traction);
    }
    Ok(())
}

/// P1, P7, P19: no change without a step, nothing falls, units do not matter.
#[test]
fn steps_are_irreversible_and_free_of_units() -> Result<(), MaterialError> {
    let law = law(CubicStep);
    let mut random = Random::new(9);
    let unit = Scale {
        stiffness: 1024.0,
        strength: 1024.0,
        toughness: 1024.0,
    };
    let mut state = TractionSeparationState::default();
    for i in 0..20_000 {
        if i % 40 == 0 {
            state = TractionSeparationState::default();
        }
        let jump = Jump::new(
            draw(&law, &mut random) * random.log_uniform(1e-3, 1.0),
            NORMAL,
        );
        let step = law.update(&jump, &state)?;
        assert!(step.state.largest >= state.largest && step.state.failed >= state.failed);
        assert!(step.state.dissipated_fraction >= state.dissipated_fraction);
        assert!(step.dissipated >= 0.0 && step.state.dissipated_fraction <= 1.0);
        let again = law.update(&jump, &step.state)?;
        assert_eq!((again.state, again.dissipated), (step.state, 0.0));
        let scaled = law.update(
            &Jump {
                scale: unit,
                ..jump
            },
            &state,
        )?;
        assert_eq!(scaled.traction, step.traction * 1024.0);
        assert_eq!(scaled.state, step.state);
        state = step.state;
    }
    Ok(())
}

#[test]
fn what_is_not_sound_is_refused() {
    fn refused(law: TractionSeparation, name: &str) {
        let answer = law.check();
        assert!(
            matches!(answer, Err(MaterialError::Parameter { parameter, .. }) if parameter == name),
            "{name}: {answer:?}"
        );
    }
    let sound = law(Linear);
    assert_eq!(sound.check(), Ok(()));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(
            TractionSeparation {
                strength: bad,
                ..sound
            },
            "strength",
        );
        refused(
            TractionSeparation {
                toughness: bad,
                ..sound
            },
            "toughness",
        );
        refused(
            TractionSeparation {
                stiffness: bad,
                ..sound
            },
            "stiffness",
        );
        if bad != 0.0 {
            refused(
                TractionSeparation {
                    shear_weight: bad,
                    ..sound
                },
                "shear_weight",
            );
        }
        let jump = Vector3::new(bad, 0.0, 0.0);
        let answer = at(&sound, jump, &Default::default());
        assert_eq!(answer.is_ok(), bad.is_finite(), "{bad}");
        let normal = Jump::new(NORMAL, jump);
        let answer = sound.update(&normal, &Default::default());
        assert_eq!(answer.is_ok(), bad == -1.0, "{bad}");
    }
    // The elastic triangle would hold all of the toughness.
    let stiffness = 0.99 * sound.strength * sound.strength / (2.0 * sound.toughness);
    refused(TractionSeparation { stiffness, ..sound }, "stiffness");
    let mut weak = Jump::new(NORMAL * 1e-6, NORMAL);
    weak.scale.toughness = 1e-4;
    assert!(sound.update(&weak, &Default::default()).is_err());
}
