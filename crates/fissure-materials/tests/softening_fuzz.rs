//! Steps of any size through all states of the laws that soften: never a panic, a NaN, negative
//! dissipation or a state that recovers, and few refusals.
// The figures of the pages in `docs/laws/` come from here.
#![allow(clippy::print_stdout)]

use fissure_materials::{
    Band, Decohesive, Increment, Isotropic, LoweredStrength, Material, MaterialError, Matrix3,
    MazarsDamage, MazarsSoftening, Normal, RankineDamage, ScalarDamage, Softening,
    contract::Random,
    softening::{Bilinear, CubicStep, DoubleExponential, Exponential, Linear, PowerLaw},
};

const UPDATES: u32 = 20_000;

const ELASTIC: Isotropic = Isotropic {
    density: 2350.0,
    young: 24.9e9,
    poisson: 0.18,
};

fn decohesive<S: Softening>(softening: S) -> Decohesive<S> {
    Decohesive {
        elastic: ELASTIC,
        strength: 2.7e6,
        toughness: 61.35,
        softening,
        normal: Normal::Rankine,
    }
}

fn mazars(softening: MazarsSoftening) -> ScalarDamage<MazarsDamage> {
    ScalarDamage {
        elastic: ELASTIC,
        evolution: MazarsDamage {
            threshold_strain: 8.5e-5,
            softening,
        },
    }
}

fn rankine<S: Softening>(softening: S) -> ScalarDamage<RankineDamage<S>> {
    ScalarDamage {
        elastic: ELASTIC,
        evolution: RankineDamage {
            strength: 2.7e6,
            toughness: 61.35,
            softening,
        },
    }
}

/// A step with `|Δε|` log-uniform in 1e-12 to 10 that keeps det F in 0.2 to 5.
fn step(random: &mut Random, from: &Matrix3<f64>) -> Matrix3<f64> {
    loop {
        let strain = random.strain_direction(true) * random.log_uniform(1e-12, 10.0);
        let stretched = (Matrix3::identity() + strain.to_matrix()) * from;
        let to = if random.chance(0.3) {
            random.rotation() * stretched
        } else {
            stretched
        };
        if (0.2..=5.0).contains(&to.determinant()) {
            return to;
        }
    }
}

/// `kept` are the quantities of a state that never fall.
fn survives<M: Material, const N: usize>(
    name: &str,
    law: &M,
    widest: f64,
    kept: impl Fn(&M::State) -> [f64; N],
) {
    let mut random = Random::new(1);
    let mut refused = 0;
    let (mut f_old, mut state) = (Matrix3::identity(), law.initial());
    let mut band = Band::Uniform(widest);
    for index in 0..UPDATES {
        if index % 12 == 0 {
            (f_old, state) = (Matrix3::identity(), law.initial());
            let width = random.log_uniform(1e-6, 1.0) * widest;
            band = random.band(width);
        }
        let f_new = step(&mut random, &f_old);
        let increment = Increment {
            f_old,
            band,
            ..Increment::to(f_new)
        };
        let answer = law.update(&increment, &state);
        if let Err(error) = &answer {
            let typed = matches!(
                error,
                MaterialError::Deformation { .. } | MaterialError::Band { .. }
            );
            assert!(typed, "{name}: {error}");
            refused += 1;
        }
        let Ok(response) = answer else { continue };
        let finite = response.stress.is_finite() && response.stored.is_finite();
        assert!(finite && response.dissipated >= 0.0, "{name}: {response:?}");
        let (before, after) = (kept(&state), kept(&response.state));
        let rises = before.iter().zip(&after).all(|(b, a)| a >= b);
        assert!(rises, "{name}: {before:?} {after:?}");
        (f_old, state) = (f_new, response.state);
    }
    println!("{name}: {UPDATES} updates, {refused} refused");
    assert!(
        refused * 100 <= UPDATES,
        "{name}: {refused} of {UPDATES} refused"
    );
}

fn cracks<S: Softening>(name: &str, softening: S) {
    let law = decohesive(softening);
    let limit = fissure_materials::Cracking::band_limit(&law, &Default::default());
    survives(name, &law, 0.99 * limit, |state| {
        [state.softened, f64::from(u8::from(state.failed))]
    });
    let lowered = LoweredStrength(law);
    survives(
        &format!("{name}, lowered"),
        &lowered,
        100.0 * limit,
        |state| {
            [
                state.inner.softened,
                f64::from(u8::from(state.inner.failed)),
            ]
        },
    );
    let scalar = rankine(softening);
    survives(&format!("{name}, scalar"), &scalar, 0.99 * limit, |state| {
        [state.largest, state.damage]
    });
}

#[test]
fn every_shape_survives_steps_of_any_size() {
    cracks("linear", Linear);
    cracks("bilinear", Bilinear::default());
    cracks("power law", PowerLaw { exponent: 4.0 });
    cracks("exponential", Exponential);
    cracks("cubic step", CubicStep);
    let (decay_ratio, weight) = (4.0, 0.25);
    cracks(
        "double exponential",
        DoubleExponential {
            decay_ratio,
            weight,
        },
    );
}

#[test]
fn mazars_survives_steps_of_any_size() {
    let printed = mazars(MazarsSoftening::Constants { a: 0.9, b: 7300.0 });
    survives("Mazars, printed", &printed, 1.0, |state| {
        [state.largest, state.damage]
    });
    let regularised = mazars(MazarsSoftening::Toughness(61.35));
    let limit = regularised.band_limit(&Default::default());
    survives("Mazars, toughness", &regularised, 0.99 * limit, |state| {
        [state.largest, state.damage]
    });
}
