mod conjugate;

use super::*;
use crate::Cracking;
use crate::contract::Random;
use crate::{MixedMode, Mode, PlaneStress, Point};

const WIDTH: f64 = 0.005;
const TOUGHNESS: f64 = 1e3;

fn law() -> TwoCrackDamage {
    let elastic = crate::Isotropic {
        density: 1000.0,
        young: 1e9,
        poisson: 0.33,
    };
    let mode = |strength, toughness| Mode {
        strength,
        toughness,
        softening: Linear,
    };
    TwoCrackDamage(AnisotropicDamage::new(
        elastic,
        mode(3e6, TOUGHNESS),
        mode(2e6, 1.5e3),
    ))
}

/// Failure strain in pure opening.
const OPEN: f64 = 2.0 * TOUGHNESS / 3e6 / WIDTH;

fn increment(from: Sym, to: Sym) -> Increment {
    let gradient = |strain: Sym| Matrix3::identity() + strain.to_matrix();
    Increment {
        f_old: gradient(from),
        band: Band::Uniform(WIDTH),
        ..Increment::to(gradient(to))
    }
}

/// The end of a way through strains, each leg in equal parts; all that was dissipated and the work of the stress.
fn through<M: Material>(
    law: &M,
    corners: &[Sym],
    parts: usize,
) -> Result<(Response<M::State>, f64, f64), MaterialError> {
    let mut old = Sym::ZERO;
    let mut last = law.update(&increment(old, old), &law.initial())?;
    let (mut dissipated, mut work) = (0.0, 0.0);
    for corner in corners {
        let from = old;
        for part in 1..=parts {
            let strain = from + (*corner - from) * (part as f64 / parts as f64);
            let next = law.update(&increment(old, strain), &last.state)?;
            work += 0.5 * (last.stress + next.stress).dot(&(strain - old));
            dissipated += next.dissipated;
            (last, old) = (next, strain);
        }
    }
    Ok((last, dissipated, work))
}

/// Normal strains along the axes.
fn stretched(xx: f64, yy: f64, zz: f64) -> Sym {
    Sym::new(xx, yy, zz, 0.0, 0.0, 0.0)
}

#[test]
fn both_ways_to_failure_cost_the_toughness_each() -> Result<(), MaterialError> {
    let pulled_x = stretched(1.1 * OPEN, 0.0, 0.0);
    let relaxed = stretched(0.0, 0.0, 0.0);
    let pulled_y = stretched(0.0, 1.1 * OPEN, 0.0);
    let both = stretched(1.1 * OPEN, 1.1 * OPEN, 0.0);
    for path in [&[pulled_x, relaxed, pulled_y][..], &[pulled_x, both]] {
        let (last, dissipated, _) = through(&law(), path, 100)?;
        let cracks = law().cracks(&last.state);
        assert_eq!(cracks.len(), 2);
        assert!(cracks.iter().all(|crack| crack.failed));
        let (first, second) = (cracks[0].normal, cracks[1].normal);
        assert!(first.x.abs() == 1.0 && (second.y.abs() - 1.0).abs() <= 1e-15);
        let error = dissipated * WIDTH / (2.0 * TOUGHNESS) - 1.0;
        assert!(error.abs() <= 1e-12, "{error:e}");
        assert!(last.stress.yy().abs() <= 1e-9 * 3e6, "{:?}", last.stress);
        if path.len() == 2 {
            assert!(last.stress.xx().abs() <= 1e-9 * 3e6, "{:?}", last.stress);
        }
    }
    Ok(())
}

/// The law of one crack carries any tension along its crack.
#[test]
fn one_crack_carries_what_two_do_not() -> Result<(), MaterialError> {
    let path = [
        stretched(1.1 * OPEN, 0.0, 0.0),
        stretched(1.1 * OPEN, 0.02, 0.0),
    ];
    let (one, ..) = through(&law().0, &path, 50)?;
    let (two, ..) = through(&law(), &path, 50)?;
    assert!(one.stress.yy() > 1.9e7, "{:?}", one.stress);
    assert!(two.stress.yy() < 3e6, "{:?}", two.stress);
    Ok(())
}

/// Once there, both cracks soften at once, in one step as in a thousand.
#[test]
fn cracks_that_open_together_do_not_see_the_size_of_the_step() -> Result<(), MaterialError> {
    let mut law = law();
    law.0.mixed = MixedMode::Uncoupled;
    let start = [stretched(5e-3, 0.0, 0.0), stretched(5e-3, 5e-3, 0.0)];
    let mut random = Random::new(3);
    for _ in 0..200 {
        let (begun, ..) = through(&law, &start, 20)?;
        // The opening of either rises all the way: else the largest on the way is what counts.
        let (most, ratio) = (random.uniform(0.02, OPEN), random.uniform(0.9, 1.0));
        let to = stretched(most, most * ratio, 0.0);
        let path = [start[0], start[1], to];
        let (many, fine, _) = through(&law, &path, 400)?;
        let coarse = law.update(&increment(start[1], to), &begun.state)?;
        let (_, before, _) = through(&law, &start, 20)?;
        let error = (coarse.stress - many.stress).norm() / 3e6;
        // The way there differs by its own steps; the openings only rise.
        assert!(error <= 1e-9, "{error:e} at {to:?}");
        let energy = (coarse.dissipated + before - fine) * WIDTH / TOUGHNESS;
        assert!(energy.abs() <= 1e-9, "{energy:e} at {to:?}");
    }
    Ok(())
}

/// Work is stored or dissipated, whatever starts, fails and shuts on the way.
#[test]
fn the_ledger_closes() -> Result<(), MaterialError> {
    let mut random = Random::new(11);
    for mixed in [MixedMode::Uncoupled, MixedMode::default()] {
        let mut law = law();
        law.0.mixed = mixed;
        let mut seconds = 0;
        for _ in 0..20 {
            let corners: Vec<_> = (0..4)
                .map(|_| random.strain_direction(true) * random.uniform(0.0, 0.7 * OPEN))
                .collect();
            let balance = |parts| -> Result<(f64, bool), MaterialError> {
                let (last, dissipated, work) = through(&law, &corners, parts)?;
                let error = (work - last.stored - dissipated) * WIDTH / TOUGHNESS;
                Ok((error.abs(), last.state.second.width > 0.0))
            };
            let (error, second) = balance(2_000)?;
            seconds += usize::from(second);
            assert!(error <= 1e-5, "{mixed:?}: {error:e}");
        }
        assert!(seconds >= 10, "{seconds}");
    }
    Ok(())
}

#[test]
fn tangents_agree_with_differences() -> Result<(), MaterialError> {
    let mut random = Random::new(5);
    let (mut worst, mut tried) = (0.0_f64, 0);
    for round in 0..400 {
        let mut law = law();
        if round % 2 == 0 {
            law.0.mixed = MixedMode::Uncoupled;
        }
        let start = [stretched(5e-3, 0.0, 0.0), stretched(5e-3, 6e-3, 0.0)];
        let (begun, ..) = through(&law, &start, 20)?;
        let to = start[1] + random.strain_direction(true) * random.log_uniform(1e-4, 0.5);
        let step = increment(start[1], to);
        let Ok(next) = law.update(&step, &begun.state) else {
            continue;
        };
        let Ok(differences) = difference_tangent(&law, &step, &begun.state, 1e-7) else {
            continue;
        };
        let coarse = difference_tangent(&law, &step, &begun.state, 1e-6);
        // Where the quotient has not settled there is a kink.
        if !coarse.is_ok_and(|coarse| (coarse - differences).max_abs() <= 1e-4 * 1.5e9) {
            continue;
        }
        assert!(law.has_own_tangent(&begun.state, &next.state));
        let own = law.tangent(&step, &begun.state)?;
        worst = worst.max((own - differences).max_abs() / 1.5e9);
        tried += 1;
    }
    assert!(worst <= 1e-5 && tried > 250, "{worst:e} in {tried}");
    Ok(())
}

/// A sheet pulled both ways, stress-free across it.
#[test]
fn a_sheet_cracks_both_ways() -> Result<(), MaterialError> {
    let sheet = PlaneStress(law());
    let flat = |xx, yy| stretched(xx, yy, 0.0);
    let path = [flat(1.1 * OPEN, 0.0), flat(1.1 * OPEN, 1.1 * OPEN)];
    let (last, dissipated, _) = through(&sheet, &path, 100)?;
    assert!(last.stress.norm() <= 1e-9 * 3e6, "{:?}", last.stress);
    let error = dissipated * WIDTH / (2.0 * TOUGHNESS) - 1.0;
    assert!(error.abs() <= 1e-12, "{error:e}");
    assert!(Point::new(&sheet).is_ok());
    Ok(())
}

#[test]
fn friction_and_wide_bands_are_refused() {
    let mut rough = law();
    rough.0.friction = 0.3;
    assert!(rough.check().is_err());
    let limit = law().band_limit(&Scale::default());
    let shear = law().0.elastic.shear_modulus();
    let expected = 2.0 * shear * TOUGHNESS / (3e6 * 3e6 * 0.5);
    assert!(
        (limit / expected - 1.0).abs() <= 1e-12,
        "{limit} {expected}"
    );
    let check = |width| law().check_band(&Band::Uniform(width), &Scale::default());
    assert!(check(0.99 * limit).is_ok() && check(1.01 * limit).is_err());
}
