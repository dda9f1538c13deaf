use fissure_tensor::Vector3;

use super::*;
use crate::contract::{self, Contract, Random};
use crate::softening::{Bilinear, CubicStep, Exponential, Linear, PowerLaw};
use crate::{Control, Leg, Path, Point, PointError, Softening, check_parameter};

const CONCRETE: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};

fn rankine<S>(softening: S) -> ScalarDamage<RankineDamage<S>> {
    ScalarDamage {
        elastic: CONCRETE,
        evolution: RankineDamage {
            strength: 2.7e6,
            toughness: 61.35,
            softening,
        },
    }
}

/// The constants of Rabczuk 2007's reference [36], and the toughness of the other law.
fn mazars(softening: MazarsSoftening) -> ScalarDamage<MazarsDamage> {
    ScalarDamage {
        elastic: CONCRETE,
        evolution: MazarsDamage {
            threshold_strain: 8.5e-5,
            softening,
        },
    }
}

const PRINTED: MazarsSoftening = MazarsSoftening::Constants { a: 1.0, b: 7300.0 };
const REGULARISED: MazarsSoftening = MazarsSoftening::Toughness(61.35);

fn along_x(strain: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(1.0 + strain, 1.0, 1.0))
}

fn passes(law: &impl Material) {
    let contract = Contract {
        step_error_steps: 200,
        ..Contract::default()
    };
    let message = contract.check(law).err().map(|v| v.to_string());
    assert_eq!(message.unwrap_or_default(), "");
}

#[test]
fn rankine_damage_passes_the_battery() {
    passes(&rankine(Linear));
    passes(&rankine(Exponential));
    passes(&rankine(CubicStep));
    passes(&rankine(Bilinear::default()));
}

#[test]
fn mazars_damage_passes_the_battery() {
    passes(&mazars(PRINTED));
    passes(&mazars(REGULARISED));
    passes(&mazars(MazarsSoftening::Constants { a: 0.8, b: 2e4 }));
}

/// Through these strains along x from rest; stresses, final state and Σ dissipated.
fn through<E: DamageEvolution>(
    law: &ScalarDamage<E>,
    width: f64,
    strains: &[f64],
) -> Result<(Vec<Sym>, ScalarDamageState, f64), MaterialError> {
    let (mut state, mut f_old) = (law.initial(), Matrix3::identity());
    let (mut stresses, mut dissipated) = (Vec::new(), 0.0);
    for &strain in strains {
        let increment = Increment {
            f_old,
            band: Band::Uniform(width),
            ..Increment::to(along_x(strain))
        };
        let response = law.update(&increment, &state)?;
        assert!(response.dissipated >= 0.0 && response.state.damage >= state.damage);
        dissipated += response.dissipated;
        stresses.push(response.stress);
        (state, f_old) = (response.state, increment.f_new);
    }
    Ok((stresses, state, dissipated))
}

/// Loading, unloading and compression, to `last` at the end.
fn wander(random: &mut Random, last: f64) -> Vec<f64> {
    let parts = random.integer(1, 60);
    let mut strains = Vec::new();
    for part in 1..=parts {
        let reached = last * (part as f64 / parts as f64).powi(3);
        strains.push(reached);
        if random.chance(0.4) {
            strains.push((random.uniform(-0.5, 1.0) * reached).max(-0.5));
        }
    }
    strains
}

/// P8 in uniaxial strain. `cargo test -p fissure-materials --lib scalar_damage -- --nocapture` prints
/// the figures of `docs/laws/scalar-damage.md`.
#[test]
fn uniaxial_strain_dissipates_the_toughness() -> Result<(), MaterialError> {
    fn ask<E: DamageEvolution>(
        name: &str,
        law: ScalarDamage<E>,
        toughness: f64,
        end: f64,
    ) -> Result<(), MaterialError> {
        let limit = law.band_limit(&Scale::default());
        let mut random = Random::new(3);
        let (mut closed_form, mut paths): (f64, f64) = (0.0, 0.0);
        for fraction in [1e-3, 0.1, 0.5, 0.9, 0.99] {
            let width = fraction * limit;
            // Beyond failure by this opening, in m, on top of ten onset strains.
            let last = 1.5e-3 + end / width;
            let (_, state, energy) = through(&law, width, &[last])?;
            assert!(state.damage > 1.0 - 1e-10);
            closed_form = closed_form.max((energy * width / toughness - 1.0).abs());
            for _ in 0..200 {
                let (_, _, energy) = through(&law, width, &wander(&mut random, last))?;
                paths = paths.max((energy * width / toughness - 1.0).abs());
            }
        }
        println!("{name:<22} closed form {closed_form:.1e}  1000 paths {paths:.1e}");
        assert!(
            closed_form < 1e-8 && paths < 1e-6,
            "{name}: {closed_form:e}, {paths:e}"
        );
        Ok(())
    }
    let unit = 61.35 / 2.7e6;
    ask("Rankine, linear", rankine(Linear), 61.35, 2.1 * unit)?;
    ask(
        "Rankine, power law 2",
        rankine(PowerLaw { exponent: 2.0 }),
        61.35,
        2.1 * unit,
    )?;
    ask(
        "Rankine, exponential",
        rankine(Exponential),
        61.35,
        32.0 * unit,
    )?;
    ask(
        "Mazars, regularised",
        mazars(REGULARISED),
        61.35,
        50.0 * unit,
    )
}

#[test]
fn the_band_follows_its_softening_curve_in_uniaxial_strain() -> Result<(), MaterialError> {
    let law = rankine(Exponential);
    let RankineDamage {
        strength,
        toughness,
        softening,
    } = law.evolution;
    let width = 0.02;
    for i in 1..40 {
        let s = 0.2 * f64::from(i);
        let traction = strength * softening.ratio(s);
        let strain = traction / CONCRETE.p_wave_modulus() + s * toughness / (strength * width);
        let (stresses, state, energy) = through(&law, width, &[strain])?;
        assert!((stresses[0].xx() / traction - 1.0).abs() < 1e-9);
        // The opening is what damage takes from the strain.
        let opening = state.damage * strain * width;
        assert!((opening * strength / toughness / s - 1.0).abs() < 1e-9);
        let expected = softening.dissipated_to_origin(s) * toughness / width;
        assert!((energy / expected - 1.0).abs() < 1e-9);
    }
    Ok(())
}

#[test]
fn printed_mazars_is_equation_32_and_its_energy_goes_with_the_band() -> Result<(), MaterialError> {
    let (a, b, start) = (0.8, 1.3e4, 8.5e-5);
    let law = mazars(MazarsSoftening::Constants { a, b });
    for strain in [8.6e-5, 1.2e-4, 3e-4, 2e-3] {
        let (stresses, state, _) = through(&law, 0.01, &[strain])?;
        let damage = 1.0 - (1.0 - a) * start / strain - a * (-b * (strain - start)).exp();
        assert!((state.damage - damage).abs() < 1e-11);
        let stress = (1.0 - damage) * CONCRETE.p_wave_modulus() * strain;
        assert!((stresses[0].xx() / stress - 1.0).abs() < 1e-9);
    }
    let law = mazars(PRINTED);
    let (_, _, energy) = through(&law, 0.01, &[0.02])?;
    let (_, _, wider) = through(&law, 0.5, &[0.02])?;
    let per_volume = CONCRETE.p_wave_modulus()
        * (0.5 * start * start + start / 7300.0 + 1.0 / (7300.0 * 7300.0));
    assert!((energy / per_volume - 1.0).abs() < 1e-9);
    assert!((energy - wider).abs() < 1e-12 * energy);
    Ok(())
}

/// What the theory page says of uniaxial stress.
#[test]
fn uniaxial_stress_dissipates_more_by_the_ratio_of_moduli() -> Result<(), PointError> {
    let width = 0.02;
    let law = rankine(Linear);
    let path = Path::new(Band::Uniform(width)).uniaxial(crate::Axis::X, 6e-3, 3000);
    let samples = Point::new(&law)?.drive(&path)?;
    let last = samples.last().map_or(0.0, |sample| sample.dissipated);
    let ratio = CONCRETE.p_wave_modulus() / CONCRETE.young;
    let spent = last * width / 61.35;
    println!("uniaxial stress: {spent:.4} of the toughness, C11/E = {ratio:.4}");
    assert!((spent / ratio - 1.0).abs() < 2e-3, "{spent} {ratio}");
    Ok(())
}

#[test]
fn energy_balances_on_a_winding_path_as_steps_shrink() -> Result<(), PointError> {
    let corners = [
        [2e-4, 1e-5, -2e-5, 3e-5, 0.0, 5e-5],
        [5e-5, -1e-4, 2e-5, 0.0, 4e-5, -2e-4],
        [1e-3, 1e-4, 0.0, 1e-4, 0.0, 3e-4],
        [-1e-4, 2e-3, 0.0, 0.0, 5e-4, 1e-4],
    ];
    fn ask<E: DamageEvolution>(
        law: ScalarDamage<E>,
        corners: &[[f64; 6]],
    ) -> Result<(), PointError> {
        let mut errors = Vec::new();
        for steps in [50, 500, 5000] {
            let path = corners
                .iter()
                .fold(Path::new(Band::Uniform(0.01)), |path, corner| {
                    path.leg(Leg {
                        control: corner.map(Control::Strain),
                        steps,
                        dt: 1.0,
                        spin: Vector3::new(0.3, 1.0, -0.5),
                    })
                });
            let samples = Point::new(&law)?.drive(&path)?;
            let Some(last) = samples.last() else {
                continue;
            };
            errors.push(((last.stored + last.dissipated) / last.work - 1.0).abs());
        }
        assert!(
            errors[2] < 1e-5 && errors[2] < 0.1 * errors[0],
            "{errors:?}"
        );
        Ok(())
    }
    ask(rankine(Linear), &corners)?;
    ask(mazars(REGULARISED), &corners)
}

/// P3 away from kinks: the same branch 2 % before and after, principal strains a tenth apart and off zero, since
/// beside them the difference steps cannot be short enough.
#[test]
fn tangent_is_within_1e_8_of_extrapolated_differences() -> Result<(), MaterialError> {
    fn ask<E: DamageEvolution>(name: &str, law: ScalarDamage<E>) -> Result<(), MaterialError> {
        let mut random = Random::new(21);
        let stiffness = law.elastic.p_wave_modulus();
        let (mut worst, mut judged): (f64, usize) = (0.0, 0);
        for _ in 0..300 {
            let strain = random.strain_direction(false) * random.log_uniform(5e-5, 3e-3);
            let values = strain.eigenvalues();
            let close = 0.1 * strain.norm();
            if values[0] - values[1] < close || values.iter().any(|e| e.abs() < close) {
                continue;
            }
            let turn = random.rotation();
            let at = |size: f64| turn * (Matrix3::identity() + strain.to_matrix() * size);
            let step = Increment {
                band: random.band(0.02),
                ..Increment::to(at(1.0))
            };
            let history = law.update(&step.with_end(along_x(2e-4)), &law.initial())?;
            for old in [law.initial(), history.state] {
                let branch = |size: f64| -> Result<_, MaterialError> {
                    let state = law.update(&step.with_end(at(size)), &old)?.state;
                    Ok((state == old, state.damage == 1.0))
                };
                if branch(0.98)? != branch(1.02)? {
                    continue;
                }
                judged += 1;
                let difference = |h: f64| crate::material::difference_tangent(&law, &step, &old, h);
                let analytic = law.tangent(&step, &old)?;
                let mut gap = f64::INFINITY;
                for h in [1e-6, 4e-7, 1e-7, 2.5e-8] {
                    let (far, near) = (difference(h)?, difference(0.5 * h)?);
                    let extrapolated = (near * 4.0 - far) * (1.0 / 3.0);
                    gap = gap.min((analytic - extrapolated).max_abs() / stiffness);
                }
                worst = worst.max(gap);
            }
        }
        println!("{name}: tangent error {worst:.1e} |C| in {judged} states");
        assert!(judged > 300 && worst < 1e-8, "{name}: {worst:e}");
        Ok(())
    }
    ask("Rankine, linear", rankine(Linear))?;
    ask("Rankine, exponential", rankine(Exponential))?;
    ask("Mazars, regularised", mazars(REGULARISED))
}

#[test]
fn parameters_and_bands_outside_their_range_are_refused() {
    fn refused(law: &impl Material, name: &str) {
        let answer = law.check();
        assert!(
            matches!(answer, Err(MaterialError::Parameter { parameter, .. }) if parameter == name),
            "{name}: {answer:?}"
        );
    }
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mut law = rankine(Linear);
        law.evolution.strength = bad;
        refused(&law, "strength");
        let mut law = rankine(Linear);
        law.evolution.toughness = bad;
        refused(&law, "toughness");
        let mut law = rankine(Linear);
        law.elastic.young = bad;
        refused(&law, "young");
        refused(&mazars(MazarsSoftening::Toughness(bad)), "toughness");
        refused(&mazars(MazarsSoftening::Constants { a: bad, b: 1.0 }), "a");
        refused(&mazars(MazarsSoftening::Constants { a: 1.0, b: bad }), "b");
        let mut law = mazars(PRINTED);
        law.evolution.threshold_strain = bad;
        refused(&law, "threshold_strain");
    }
    refused(&rankine(PowerLaw { exponent: 0.5 }), "exponent");
    refused(&mazars(MazarsSoftening::Constants { a: 1.01, b: 1.0 }), "a");
    fn bands<E: DamageEvolution>(law: ScalarDamage<E>) {
        let scale = Scale::default();
        let limit = law.band_limit(&scale);
        let accepts = |width: f64| law.check_band(&Band::Uniform(width), &scale).is_ok();
        assert!(accepts(limit.min(1e3) * 0.99));
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.01 * limit] {
            assert!(!accepts(width), "{width}");
        }
    }
    bands(rankine(Linear));
    bands(mazars(REGULARISED));
    bands(mazars(PRINTED));
}

/// An evolution of one's own: brittle, in the norm of the strain.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Norm(f64);

impl DamageEvolution for Norm {
    const NAME: &'static str = "norm";
    fn check(&self, _: &Isotropic) -> Result<(), MaterialError> {
        check_parameter(Self::NAME, "0", self.0, self.0 > 0.0, "finite and > 0")
    }
    fn threshold(&self, _: &Isotropic, scale: &Scale) -> f64 {
        self.0 * scale.strength / scale.stiffness
    }
    fn measure(&self, _: &Isotropic, strain: &Sym) -> Measure {
        let value = strain.norm();
        Measure {
            value,
            gradient: if value > 0.0 {
                *strain / value
            } else {
                Sym::ZERO
            },
        }
    }
    fn band_limit(&self, _: &Isotropic, _: &Scale) -> f64 {
        f64::INFINITY
    }
    fn evolve(&self, elastic: &Isotropic, scale: &Scale, measure: f64, _: f64) -> Evolved {
        // d = 1 − κ₀/κ: the stress in one direction stays where it is.
        let start = self.threshold(elastic, scale);
        Evolved {
            damage: 1.0 - start / measure,
            by_measure: start / (measure * measure),
            by_width: 0.0,
            spent: start * (measure - start),
        }
    }
}

#[test]
fn an_evolution_of_ones_own_passes() {
    let law = ScalarDamage {
        elastic: CONCRETE,
        evolution: Norm(1e-4),
    };
    let message = contract::check(&law).err().map(|v| v.to_string());
    assert_eq!(message.unwrap_or_default(), "");
}

#[test]
fn plane_stress_bears_until_nothing_is_left() -> Result<(), MaterialError> {
    let law = crate::PlaneStress(rankine(Linear));
    let (mut state, mut f_old) = (law.initial(), Matrix3::identity());
    for part in 1..=100 {
        let increment = Increment {
            f_old,
            band: Band::Uniform(0.02),
            ..Increment::to(along_x(4e-5 * f64::from(part)))
        };
        let response = law.update(&increment, &state)?;
        assert!(response.stress.zz() == 0.0 && response.stress.xx() < 2.7e6 * (1.0 + 1e-9));
        // Nothing is left that could give the thickness a stiffness.
        let tangent = law.tangent(&increment, &state);
        let spent = response.state.inner.damage == 1.0;
        assert_eq!(
            matches!(tangent, Err(MaterialError::NotFinite { .. })),
            spent
        );
        (state, f_old) = (response.state, increment.f_new);
    }
    assert!(state.inner.damage == 1.0);
    Ok(())
}
