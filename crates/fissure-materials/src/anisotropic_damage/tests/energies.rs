//! P8: energy to failure of one mode along random paths, for every softening shape.

use super::*;
use crate::softening::{Bilinear, CubicStep, DoubleExponential, Exponential, PowerLaw};

/// Paths of each shape and mode.
const PATHS: usize = 1000;

/// Dimensionless opening at which at most `1e-13` of the toughness is left.
fn end<S: Softening>(shape: &S) -> f64 {
    let mut end: f64 = 1.0;
    while shape.area(end) < 1.0 - 1e-13 {
        end *= 1.25;
    }
    end.min(shape.critical())
}

/// One mode of a crack across x.
struct OneMode<S> {
    law: AnisotropicDamage<S, S>,
    opens: bool,
    strength: f64,
    toughness: f64,
    end: f64,
}

impl<S: Softening> OneMode<S> {
    fn new(softening: S, opens: bool) -> Self {
        let mode = |strength, toughness| Mode {
            strength,
            toughness,
            softening,
        };
        let law = AnisotropicDamage {
            onset: Onset::Prescribed(Vector3::x()),
            ..AnisotropicDamage::new(ELASTIC, mode(3e6, 1e3), mode(2e6, 1.5e3))
        };
        let (strength, toughness) = if opens { (3e6, 1e3) } else { (2e6, 1.5e3) };
        Self {
            law,
            opens,
            strength,
            toughness,
            end: end(&softening),
        }
    }

    /// A band up to 0.99 of the limit, and not so narrow that the strain at the end exceeds 1.
    fn band(&self, random: &mut Random) -> f64 {
        let limit = self.law.band_limit(&Scale::default());
        let narrowest = (1e-2 * limit).max(self.end * self.toughness / self.strength);
        random.log_uniform(narrowest.min(0.9 * limit), 0.99 * limit)
    }

    /// Loading, unloading, reversal or contact, to beyond the end: energy over toughness, less 1.
    fn error(&self, random: &mut Random) -> Result<f64, MaterialError> {
        let width = self.band(random);
        let mut step = increment(Matrix3::identity(), Matrix3::identity());
        step.band = Band::cube(width);
        let modulus = if self.opens {
            ELASTIC.p_wave_modulus()
        } else {
            ELASTIC.shear_modulus()
        };
        let last =
            1.01 * (self.end * self.toughness / self.strength / width + self.strength / modulus);
        let angle = random.uniform(0.0, std::f64::consts::TAU);
        let mut levels: Vec<f64> = (0..random.integer(0, 30))
            .map(|_| random.uniform(-0.5, 1.0).powi(3) * last)
            .collect();
        levels.push(last);
        let (mut state, mut dissipated) = (self.law.initial(), 0.0);
        for level in levels {
            step.f_old = step.f_new;
            step.f_new = if self.opens {
                gradient(level, 0.0, 0.0)
            } else {
                // Reversed at will; shear alone, so that no pressure is needed to close.
                gradient(0.0, level * angle.cos(), level * angle.sin())
            };
            let response = self.law.update(&step, &state)?;
            assert!(response.dissipated >= 0.0);
            dissipated += response.dissipated;
            state = response.state;
        }
        assert!(state.failed || self.law.opening.softening.critical().is_infinite());
        Ok((dissipated * width / self.toughness - 1.0).abs())
    }
}

fn spends_its_toughness<S: Softening>(name: &str, softening: S) -> Result<(), MaterialError> {
    let mut random = Random::new(3);
    for opens in [true, false] {
        let mode = OneMode::new(softening, opens);
        let mut worst = 0.0_f64;
        for _ in 0..PATHS {
            worst = worst.max(mode.error(&mut random)?);
        }
        let way = if opens { "opening" } else { "sliding" };
        println!("{name}, {way}: energy to failure over {PATHS} paths within {worst:e}");
        assert!(worst < 1e-12, "{name}, {way}: {worst:e}");
    }
    Ok(())
}

/// For a fixed normal without friction. `cargo test -p fissure-materials --lib energies -- --nocapture` prints the figures
/// of `docs/laws/anisotropic-damage.md`.
#[test]
fn random_paths_to_failure_dissipate_the_toughness_of_every_shape() -> Result<(), MaterialError> {
    spends_its_toughness("linear", Linear)?;
    spends_its_toughness("bilinear", Bilinear::default())?;
    spends_its_toughness("power law n = 3", PowerLaw { exponent: 3.0 })?;
    spends_its_toughness("exponential", Exponential)?;
    spends_its_toughness("cubic step", CubicStep)?;
    for (decay_ratio, weight) in [(4.0, 0.25), (10.0, -2.0)] {
        let shape = DoubleExponential {
            decay_ratio,
            weight,
        };
        spends_its_toughness(
            &format!("double exponential ({decay_ratio}, {weight})"),
            shape,
        )?;
    }
    Ok(())
}
