//! Energy to failure of pure opening, whatever the way there (P8).

use fissure_materials::contract::Random;
use fissure_materials::*;
use fissure_tensor::{Band, Matrix3, Sym, Vector3};

use super::subject::{Fracture, Subject};

/// Largest `|Σ dissipated × band / G − 1|` over random paths of loading, unloading and contact
/// along one normal, in 1 to 1000 steps, with bands up to 0.99 of the limit. NaN for a law that
/// does not crack; infinite if it refuses a step or does not fail.
pub(super) fn error<S: Subject>(subject: &S, paths: usize, random: &mut Random) -> f64 {
    let Some(fracture) = subject.fracture() else {
        return f64::NAN;
    };
    (0..paths)
        .map(|_| path_error(subject, &fracture, random))
        .fold(0.0, f64::max)
}

fn path_error<S: Subject>(subject: &S, fracture: &Fracture, random: &mut Random) -> f64 {
    let law = subject.law();
    let widest = fracture.band_limit.min(1e3);
    // A thinner band would need strains that are not small.
    let thinnest = (1e-3 * widest)
        .max(10.0 * fracture.opening)
        .min(0.99 * widest);
    let width = if random.chance(0.3) {
        random.uniform(0.9, 0.99) * widest
    } else {
        random.log_uniform(thinnest, 0.99 * widest)
    };
    let normal = normal_of(subject, random);
    let top = 1.2 * subject.strain() + 1.1 * fracture.opening / width;
    let mut increment = Increment::to(Matrix3::identity());
    increment.band = Band::Uniform(width);
    let (mut state, mut dissipated) = (law.initial(), 0.0);
    let mut from = 0.0;
    // Not shut before it has started: crushing may start a crack in shear.
    for level in levels(random, 1.05 * subject.strain() / top) {
        let steps = random.log_uniform(1.0, 300.0) as usize;
        for step in 1..=steps {
            let part = step as f64 / steps as f64;
            let strain = Sym::dyad(&normal) * (top * (from + (level - from) * part));
            increment.f_new = Matrix3::identity() + strain.to_matrix();
            let Ok(response) = law.update(&increment, &state) else {
                return f64::INFINITY;
            };
            dissipated += response.dissipated;
            state = response.state;
            increment.f_old = increment.f_new;
        }
        from = level;
    }
    let failed = !fracture.fails || subject.cracks(&state).iter().any(|crack| crack.failed);
    if failed {
        (dissipated * width / fracture.toughness - 1.0).abs()
    } else {
        f64::INFINITY
    }
}

/// A direction in which the law lets a crack start.
fn normal_of<S: Subject>(subject: &S, random: &mut Random) -> Vector3<f64> {
    // A pull in a random direction shows it: a law with a prescribed normal has only that one.
    let mut increment = Increment::to(Matrix3::identity());
    let limit = subject.fracture().map_or(1.0, |f| f.band_limit.min(1e3));
    increment.band = Band::Uniform(0.5 * limit);
    let direction = random.direction();
    let law = subject.law();
    let mut size = 2.0 * subject.strain();
    for _ in 0..20 {
        let pull = Sym::dyad(&direction) * size;
        increment.f_new = Matrix3::identity() + pull.to_matrix();
        let cracks = law
            .update(&increment, &law.initial())
            .map(|response| subject.cracks(&response.state));
        if let Some(crack) = cracks.unwrap_or_default().first() {
            return crack.normal;
        }
        size *= 1.5;
    }
    direction
}

/// Up to three times up and down again, into compression too, and then all the way.
fn levels(random: &mut Random, started: f64) -> Vec<f64> {
    let mut levels = Vec::new();
    for _ in 0..random.integer(0, 3) {
        let high = random.uniform(started.min(1.0), 1.0);
        levels.extend([high, random.uniform(-0.2, high)]);
    }
    levels.push(1.0);
    levels
}
