//! Two cracks with the stress that does the work, at large stretch and rotation.

use fissure_tensor::rotation;

use super::*;
use crate::ConjugateDamage;

/// A crack of this band fails at a stretch of about 2.3.
const NARROW: f64 = 5e-4;

fn law(mixed: MixedMode) -> TwoCrackDamage {
    let mut law = super::law();
    law.0.mixed = mixed;
    law
}

/// A rotation vector and a strain.
type Place = (Vector3<f64>, Sym);

fn gradient((turn, strain): Place) -> Matrix3<f64> {
    rotation(&turn, turn.norm()) * (Matrix3::identity() + strain.to_matrix())
}

/// What becomes of a point along a way; energies over the toughness of the band.
struct Way<S> {
    state: S,
    stored: f64,
    dissipated: f64,
    /// Of the nominal stress.
    work: f64,
    /// The largest stored energy on the way.
    most_stored: f64,
    least_dissipation: f64,
}

impl<S> Way<S> {
    /// Work that is neither stored nor dissipated, over the most energy there was.
    fn imbalance(&self) -> f64 {
        let error = self.work - self.stored - self.dissipated;
        error.abs() / (self.most_stored + self.dissipated)
    }
}

/// Straight legs between places, each in equal parts.
fn along<M: Material>(
    law: &M,
    corners: &[Place],
    parts: usize,
) -> Result<Way<M::State>, MaterialError> {
    let unit = TOUGHNESS / NARROW;
    let nominal = |f: &Matrix3<f64>, stress: &Sym| {
        let inverse = f.try_inverse().unwrap_or_else(Matrix3::zeros);
        stress.to_matrix() * inverse.transpose() * f.determinant()
    };
    let (mut f_old, mut state) = (Matrix3::identity(), law.initial());
    let (mut old_stress, mut from) = (Matrix3::zeros(), (Vector3::zeros(), Sym::ZERO));
    let (mut dissipated, mut work, mut least) = (0.0, 0.0, f64::INFINITY);
    let (mut stored, mut most_stored) = (0.0, 0.0_f64);
    for &to in corners {
        for part in 1..=parts {
            let share = part as f64 / parts as f64;
            let turn = from.0 + (to.0 - from.0) * share;
            let f_new = gradient((turn, from.1 + (to.1 - from.1) * share));
            let increment = Increment {
                f_old,
                band: Band::Uniform(NARROW),
                ..Increment::to(f_new)
            };
            let response = law.update(&increment, &state)?;
            let stress = nominal(&f_new, &response.stress);
            work += 0.5 * (old_stress + stress).dot(&(f_new - f_old));
            dissipated += response.dissipated;
            least = least.min(response.dissipated / unit);
            stored = response.stored;
            most_stored = most_stored.max(stored);
            (f_old, old_stress, state) = (f_new, stress, response.state);
        }
        from = to;
    }
    Ok(Way {
        state,
        stored: stored / unit,
        dissipated: dissipated / unit,
        work: work / unit,
        most_stored: most_stored / unit,
        least_dissipation: least,
    })
}

/// Corners of a random way: stretches of up to 3.5 that leave the volume positive, rotations of up to π.
fn corners(random: &mut Random) -> Vec<Place> {
    let corner = |random: &mut Random| loop {
        let strain = random.strain_direction(true) * random.uniform(0.0, 3.0);
        if strain.spectrum().values.iter().all(|&value| value > -0.7) {
            return (random.turn() * random.uniform(0.0, 3.0), strain);
        }
    };
    (0..3).map(|_| corner(random)).collect()
}

/// P6: work is stored or dissipated, and nothing comes back of what is dissipated; at stretches of 3 as at small ones.
#[test]
fn the_ledger_closes_at_any_stretch() -> Result<(), MaterialError> {
    let mut random = Random::new(23);
    let (mut seconds, mut turned_worst, mut longest) = (0, 0.0_f64, 0.0_f64);
    for round in 0..24 {
        let mixed = [MixedMode::Uncoupled, MixedMode::default()][round % 2];
        let law = law(mixed);
        let corners = corners(&mut random);
        let end = along(&ConjugateDamage(law), &corners, 4_000)?;
        let error = end.imbalance();
        seconds += usize::from(end.state.second.width > 0.0);
        for (_, strain) in &corners {
            longest = longest.max(1.0 + strain.spectrum().values[0]);
        }
        assert!(error <= 2e-5, "round {round}: {error:e}");
        let least = end.least_dissipation;
        assert!(least >= -1e-13, "round {round}: {least:e}");
        let turned = along(&law, &corners, 500)?;
        turned_worst = turned_worst.max(turned.imbalance());
    }
    assert!(seconds >= 15 && longest > 2.5, "{seconds}, {longest}");
    // What the rotated stress is off by.
    assert!(turned_worst > 0.3, "{turned_worst}");
    Ok(())
}

/// The error of the ledger above is that of the sum over the way.
#[test]
fn its_error_falls_with_the_square_of_the_step() -> Result<(), MaterialError> {
    let mut law = law(MixedMode::Uncoupled);
    law.0.onset = Onset::Tension;
    let turn = Vector3::new(0.4, -1.1, 2.0);
    let corners = [
        (turn * 0.3, stretched(1.5, 0.3, -0.1)),
        (turn, Sym::new(1.8, 1.9, -0.2, 0.1, 0.2, -0.1)),
    ];
    let error = |parts| -> Result<f64, MaterialError> {
        let end = along(&ConjugateDamage(law), &corners, parts)?;
        assert!(end.state.second.width > 0.0);
        Ok(end.imbalance())
    };
    let (coarse, fine) = (error(1_000)?, error(8_000)?);
    let order = (coarse / fine).log2() / 3.0;
    assert!(fine <= 1e-5 && order > 1.0, "{coarse:e}, {fine:e}: {order}");
    Ok(())
}

/// P3 with the conjugate stress, and P4, the symmetry that the rotated stress has not.
#[test]
fn tangents_agree_with_differences_and_are_symmetric() -> Result<(), MaterialError> {
    let mut random = Random::new(29);
    let (mut worst, mut unsymmetric, mut tried) = (0.0_f64, 0.0_f64, 0);
    for round in 0..200 {
        let law = ConjugateDamage(law([MixedMode::Uncoupled, MixedMode::default()][round % 2]));
        let places = corners(&mut random);
        let Ok(begun) = along(&law, &places[..2], 40) else {
            continue;
        };
        let (turn, strain) = places[1];
        let change = random.strain_direction(true) * random.log_uniform(1e-3, 0.2);
        let f_old = gradient(places[1]);
        let step = Increment {
            f_old,
            band: Band::Uniform(NARROW),
            ..Increment::to(gradient((turn, strain + change)))
        };
        let Ok(next) = law.update(&step, &begun.state) else {
            continue;
        };
        if begun.state.second.width == 0.0 || next.state.second.width == 0.0 {
            continue;
        }
        let differences = difference_tangent(&law, &step, &begun.state, 1e-6)?;
        let coarse = difference_tangent(&law, &step, &begun.state, 1e-5)?;
        // Where the quotient has not settled there is a kink.
        if (coarse - differences).max_abs() > 1e-4 * 1.5e9 {
            continue;
        }
        assert!(law.has_own_tangent(&begun.state, &next.state));
        let own = law.tangent(&step, &begun.state)?;
        worst = worst.max((own - differences).max_abs() / 1.5e9);
        let skew = own.0 - own.0.transpose();
        unsymmetric = unsymmetric.max(skew.amax() / 1.5e9);
        tried += 1;
    }
    assert!(worst <= 1e-5 && tried > 100, "{worst:e} in {tried}");
    assert!(unsymmetric <= 1e-11, "{unsymmetric:e}");
    Ok(())
}

/// An open crack carries no wave across: with both open the stretch along neither counts.
#[test]
fn only_what_no_crack_opens_by_quickens_waves() -> Result<(), MaterialError> {
    let mut law = law(MixedMode::Uncoupled);
    law.0.onset = Onset::Tension;
    let open = (Vector3::zeros(), stretched(2.4, 0.0, 0.0));
    let both = (Vector3::zeros(), stretched(2.5, 2.6, 0.2));
    let end = along(&ConjugateDamage(law), &[open, both], 50)?;
    let scale = Scale::default();
    let f = gradient(both);
    let at_rest = law.0.elastic.p_wave_speed();
    let conjugate = ConjugateDamage(law).wave_speed(&f, &end.state, &scale) / at_rest;
    assert!((1.2..1.25).contains(&conjugate), "{conjugate}");
    let turned = law.wave_speed(&f, &end.state, &scale) / at_rest;
    assert!(turned > 3.6 * 3.6, "{turned}");
    Ok(())
}
