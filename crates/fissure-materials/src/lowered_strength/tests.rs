use super::*;
use crate::contract::Contract;
use crate::softening::{Exponential, Linear};
use crate::{
    Decohesive, Isotropic, MazarsDamage, MazarsSoftening, Normal, PlaneStress, ScalarDamage,
    Softening,
};

fn law<S>(softening: S) -> LoweredStrength<Decohesive<S>> {
    LoweredStrength(Decohesive {
        elastic: Isotropic {
            density: 2350.0,
            young: 24.9e9,
            poisson: 0.18,
        },
        strength: 2.7e6,
        toughness: 61.35,
        softening,
        normal: Normal::Rankine,
    })
}

fn limit<S: Softening>(law: &LoweredStrength<Decohesive<S>>) -> f64 {
    law.0.band_limit(&Scale::default())
}

fn along_x(strain: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(1.0 + strain, 1.0, 1.0))
}

#[test]
fn a_band_under_the_limit_changes_no_bit() -> Result<(), MaterialError> {
    let law = law(Linear);
    let increment = Increment {
        band: Band::Uniform(0.9 * limit(&law)),
        ..Increment::to(along_x(1e-3))
    };
    let (one, other) = (
        law.update(&increment, &law.initial())?,
        law.0.update(&increment, &law.0.initial())?,
    );
    assert_eq!((one.stress, one.state.inner), (other.stress, other.state));
    assert_eq!(one.state.factor, 1.0);
    assert_eq!(law.notice(&increment.band, &Scale::default()), Ok(None));
    Ok(())
}

/// X3: bands 1, 10 and 1000 times over the limit.
#[test]
fn a_wide_band_cracks_at_the_lowered_strength_and_spends_its_toughness() -> Result<(), MaterialError>
{
    fn ask<S: Softening>(law: LoweredStrength<Decohesive<S>>) -> Result<(), MaterialError> {
        for times in [1.01, 10.0, 1e3] {
            let width = times * limit(&law);
            let band = Band::Uniform(width);
            assert!(law.0.check_band(&band, &Scale::default()).is_err());
            assert_eq!(law.check_band(&band, &Scale::default()), Ok(()));
            let notice = law.notice(&band, &Scale::default())?;
            let expected = (0.99 / times).sqrt();
            assert!(notice.is_some_and(|n| (n.factor / expected - 1.0).abs() < 1e-12));
            assert!(notice.is_some_and(|n| n.to_string().contains("lowered")));

            let onset = expected * law.0.strength / law.0.elastic.p_wave_modulus();
            let (mut state, mut f_old) = (law.initial(), Matrix3::identity());
            let (mut peak, mut dissipated): (f64, f64) = (0.0, 0.0);
            // Finely past the onset, then to the end.
            let fine = (0..=2000).map(|part| onset * 1.1 * f64::from(part) / 2000.0);
            for strain in fine.chain([2.0, 10.0, 80.0].map(|level| level * onset)) {
                let f_new = along_x(strain);
                let increment = Increment {
                    f_old,
                    band,
                    ..Increment::to(f_new)
                };
                let response = law.update(&increment, &state)?;
                assert!(response.dissipated >= 0.0);
                dissipated += response.dissipated;
                peak = peak.max(response.stress.xx());
                (state, f_old) = (response.state, f_new);
            }
            assert!((state.factor / expected - 1.0).abs() < 1e-12);
            assert!((peak / (expected * law.0.strength) - 1.0).abs() < 5e-3);
            let spent = dissipated * width / law.0.toughness;
            assert!((spent - 1.0).abs() < 1e-8, "{times}: {spent}");
        }
        Ok(())
    }
    ask(law(Linear))?;
    ask(law(Exponential))
}

#[test]
fn the_factor_stays_when_the_band_changes_after_the_crack_has_started() -> Result<(), MaterialError>
{
    let law = law(Linear);
    let at = |strain: f64, times: f64| Increment {
        band: Band::Uniform(times * limit(&law)),
        ..Increment::to(along_x(strain))
    };
    let started = law.update(&at(8e-5, 4.0), &law.initial())?;
    assert!(started.state.factor > 0.0 && started.state.factor < 0.5);
    let later = law.update(&at(8.1e-5, 0.1), &started.state)?;
    assert_eq!(later.state.factor, started.state.factor);
    let ratio = |state| {
        law.cracks(&state)
            .first()
            .map_or(1.0, |crack| crack.strength_ratio)
    };
    assert!(ratio(started.state) <= started.state.factor);
    Ok(())
}

#[test]
fn other_bands_are_refused_as_ever() {
    let law = law(Linear);
    for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = law.check_band(&Band::Uniform(width), &Scale::default());
        assert!(
            matches!(refused, Err(MaterialError::Band { .. })),
            "{width}"
        );
    }
}

/// The cracking part of the battery takes a strength out of reach for an undamaged twin, which is
/// lowered here; below the limit the law is the one inside bit by bit, which passes that part.
#[test]
fn the_battery_passes_below_and_above_the_limit() {
    let law = law(Linear);
    for times in [0.5, 1.5, 20.0] {
        let contract = Contract {
            band: Some(Band::Uniform(times * limit(&law))),
            step_error_steps: 100,
            samples: 128,
            ..Contract::default()
        };
        let message = contract.check(&law).err().map(|v| v.to_string());
        assert_eq!(message.unwrap_or_default(), "");
    }
}

#[test]
fn the_limit_of_plane_stress_counts() -> Result<(), MaterialError> {
    let inside = law(Linear).0;
    let law = LoweredStrength(PlaneStress(inside));
    let width = inside.band_limit(&Scale::default());
    let band = Band::Uniform(0.999 * width);
    assert_eq!(inside.check_band(&band, &Scale::default()), Ok(()));
    let notice = law.notice(&band, &Scale::default())?;
    assert!(notice.is_some_and(|n| n.limit < 0.999 * width && n.factor < 1.0));
    Ok(())
}

/// A law that does not crack, and whose threshold is a strain.
#[test]
fn scalar_damage_is_lowered_too() -> Result<(), MaterialError> {
    let inside = ScalarDamage {
        elastic: law(Linear).0.elastic,
        evolution: MazarsDamage {
            threshold_strain: 8.5e-5,
            softening: MazarsSoftening::Toughness(61.35),
        },
    };
    let width = 4.0 * inside.band_limit(&Scale::default());
    let law = LoweredStrength(inside);
    let (mut state, mut f_old, mut dissipated) = (law.initial(), Matrix3::identity(), 0.0);
    for strain in [0.0, 3e-5, 4.2e-5, 4.3e-5, 1e-3, 1e-2] {
        let increment = Increment {
            f_old,
            band: Band::Uniform(width),
            ..Increment::to(along_x(strain))
        };
        let response = law.update(&increment, &state)?;
        assert_eq!(
            response.state.inner.damage > 0.0,
            strain > 4.25e-5,
            "{strain}"
        );
        dissipated += response.dissipated;
        (state, f_old) = (response.state, increment.f_new);
    }
    assert!((dissipated * width / 61.35 - 1.0).abs() < 1e-8);
    Ok(())
}
