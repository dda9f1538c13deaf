//! The decohesive law with every softening shape: the battery, and energies to failure (P8).
// The figures of the pages in `docs/laws/` come from here.
#![allow(clippy::print_stdout)]

use fissure_materials::{
    Band, Cracking, Decohesive, DecohesiveState, Increment, Isotropic, Material, MaterialError,
    Matrix3, Normal, Softening, Vector3, check_parameter,
    contract::{self, Contract, Random},
    softening::{Bilinear, CubicStep, DoubleExponential, Exponential, Linear, PowerLaw},
};

const STEEP_FIRST: Bilinear = Bilinear {
    kink_opening: 0.8,
    kink_ratio: 1.0 / 3.0,
};
const STEEP_LAST: Bilinear = Bilinear {
    kink_opening: 1.0,
    kink_ratio: 0.9,
};
const POWER: PowerLaw = PowerLaw { exponent: 3.0 };
const FLAT_START: DoubleExponential = DoubleExponential {
    decay_ratio: 4.0,
    weight: 0.25,
};
const LONG_TAIL: DoubleExponential = DoubleExponential {
    decay_ratio: 10.0,
    weight: -2.0,
};

fn law<S>(softening: S) -> Decohesive<S> {
    Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: 2.7e6,
        toughness: 61.35,
        softening,
        normal: Normal::Prescribed(Vector3::x()),
    }
}

fn passes<S: Softening>(softening: S) {
    for normal in [
        Normal::Rankine,
        Normal::Prescribed(Vector3::new(1.0, 2.0, -0.5)),
    ] {
        let law = Decohesive {
            normal,
            ..law(softening)
        };
        let contract = Contract {
            step_error_steps: 200,
            ..Contract::default()
        };
        let message = contract.check_cracking(&law).err().map(|v| v.to_string());
        assert_eq!(message.unwrap_or_default(), "");
    }
}

#[test]
fn bilinear_passes_the_battery() {
    passes(STEEP_FIRST);
    passes(STEEP_LAST);
}

#[test]
fn power_law_passes_the_battery() {
    passes(POWER);
}

#[test]
fn exponential_passes_the_battery() {
    passes(Exponential);
}

#[test]
fn cubic_step_passes_the_battery() {
    passes(CubicStep);
}

#[test]
fn double_exponential_passes_the_battery() {
    passes(FLAT_START);
    passes(LONG_TAIL);
}

/// Two straight lines that meet smoothly, by hand: `cos²`, scaled to unit area.
#[derive(Clone, Copy, Debug)]
struct Cosine {
    critical: f64,
}

impl Softening for Cosine {
    fn check(&self) -> Result<(), MaterialError> {
        let critical = self.critical;
        check_parameter("cosine", "critical", critical, critical == 2.0, "2")
    }
    fn ratio(&self, s: f64) -> f64 {
        let x = std::f64::consts::FRAC_PI_4 * s;
        if s < 2.0 { x.cos().powi(2) } else { 0.0 }
    }
    fn slope(&self, s: f64) -> f64 {
        let x = std::f64::consts::FRAC_PI_4 * s;
        if s < 2.0 {
            -std::f64::consts::FRAC_PI_4 * (2.0 * x).sin()
        } else {
            0.0
        }
    }
    fn area(&self, s: f64) -> f64 {
        let s = s.min(2.0);
        0.5 * s + (std::f64::consts::FRAC_PI_2 * s).sin() / std::f64::consts::PI
    }
    fn critical(&self) -> f64 {
        self.critical
    }
    fn steepest(&self) -> f64 {
        std::f64::consts::FRAC_PI_4
    }
}

#[test]
fn a_shape_of_ones_own_passes_and_its_parameters_are_checked() {
    assert_eq!(contract::check_softening(&Cosine { critical: 2.0 }), Ok(()));
    passes(Cosine { critical: 2.0 });
    let refused = law(Cosine { critical: 2.1 }).check();
    assert!(matches!(
        refused,
        Err(MaterialError::Parameter {
            parameter: "critical",
            ..
        })
    ));
    let refused = law(PowerLaw { exponent: 0.5 }).check();
    assert!(matches!(
        refused,
        Err(MaterialError::Parameter {
            parameter: "exponent",
            ..
        })
    ));
}

/// Opening at which at most `1e-13` of the toughness is left.
fn end<S: Softening>(shape: &S) -> f64 {
    let mut end = 1.0;
    while shape.area(end) < 1.0 - 1e-13 {
        end *= 1.25;
    }
    end
}

/// Strain along x at which the law has been opened to the dimensionless opening `s`.
fn strain_at<S: Softening>(law: &Decohesive<S>, width: f64, s: f64) -> f64 {
    let traction = law.strength * law.softening.ratio(s);
    traction / law.elastic.p_wave_modulus() + s * law.toughness / law.strength / width
}

/// `Σ dissipated × band` over toughness, along these strains.
fn energy<S: Softening>(
    law: &Decohesive<S>,
    width: f64,
    strains: impl Iterator<Item = f64>,
) -> Result<f64, MaterialError> {
    let mut state = DecohesiveState::default();
    let mut dissipated = 0.0;
    let mut f_old = Matrix3::identity();
    for strain in strains {
        let f_new = Matrix3::from_diagonal(&Vector3::new(1.0 + strain, 1.0, 1.0));
        let increment = Increment {
            f_old,
            band: Band::Uniform(width),
            ..Increment::to(f_new)
        };
        let response = law.update(&increment, &state)?;
        assert!(response.dissipated >= 0.0);
        dissipated += response.dissipated;
        (state, f_old) = (response.state, f_new);
    }
    Ok(dissipated * width / law.toughness)
}

/// Loading, unloading, reloading and contact up to beyond the end, never below F = 0.5.
fn wander<S: Softening>(random: &mut Random, law: &Decohesive<S>, width: f64) -> Vec<f64> {
    let last = strain_at(law, width, 1.05 * end(&law.softening));
    let parts = random.integer(1, 60);
    let mut strains = Vec::new();
    for part in 1..=parts {
        // Log-uniform: most of the toughness is spent at the first openings.
        let reached = last * (part as f64 / parts as f64).powi(3);
        strains.push(reached);
        if random.chance(0.3) {
            strains.push(random.uniform(0.0, 1.0) * reached);
        }
        if random.chance(0.2) {
            strains.push((-random.log_uniform(1e-6, 1.0) * reached).max(-0.5));
        }
    }
    strains
}

fn spends_its_toughness<S: Softening>(name: &str, shape: S) -> Result<(), MaterialError> {
    let law = law(shape);
    let limit = law.band_limit(&Default::default());
    let mut random = Random::new(8);
    let (mut closed_form, mut paths): (f64, f64) = (0.0, 0.0);
    for fraction in [1e-3, 0.1, 0.5, 0.9, 0.99] {
        let width = fraction * limit;
        // One step to beyond failure, and one to each of four openings on the way: both are the
        // area under the curve.
        let whole = [strain_at(&law, width, 1.05 * end(&shape))];
        closed_form = closed_form.max((energy(&law, width, whole.into_iter())? - 1.0).abs());
        for s in [0.1, 0.7, 1.3, 1.8] {
            let to = [strain_at(&law, width, s)].into_iter();
            closed_form = closed_form.max((energy(&law, width, to)? - shape.area(s)).abs());
        }
        for _ in 0..200 {
            let path = wander(&mut random, &law, width);
            paths = paths.max((energy(&law, width, path.into_iter())? - 1.0).abs());
        }
    }
    println!(
        "{name:<20} eta {:.4}  closed form {closed_form:.1e}  1000 paths {paths:.1e}",
        shape.stability()
    );
    assert!(closed_form < 1e-8, "{name}: {closed_form:e}");
    assert!(paths < 1e-6, "{name}: {paths:e}");
    Ok(())
}

/// P8 for bands up to 0.99 of the limit. `cargo test -p fissure-materials --test softening_shapes
/// energy -- --nocapture` prints the figures of `docs/laws/softening.md`.
#[test]
fn energy_to_failure_is_the_toughness_for_every_shape() -> Result<(), MaterialError> {
    spends_its_toughness("linear", Linear)?;
    spends_its_toughness("bilinear (Petersson)", STEEP_FIRST)?;
    spends_its_toughness("bilinear (1, 0.9)", STEEP_LAST)?;
    spends_its_toughness("power law n = 3", POWER)?;
    spends_its_toughness("exponential", Exponential)?;
    spends_its_toughness("cubic step", CubicStep)?;
    spends_its_toughness("double exp. (4, 1/4)", FLAT_START)?;
    spends_its_toughness("double exp. (10, -2)", LONG_TAIL)?;
    spends_its_toughness("cosine", Cosine { critical: 2.0 })
}
