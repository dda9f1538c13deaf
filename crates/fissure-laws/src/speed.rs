//! Time of an update, against neo-Hookean elasticity on the same deformations in the same run.

use std::hint::black_box;
use std::time::Instant;

use fissure_materials::contract::Random;
use fissure_materials::*;
use fissure_tensor::{Band, Matrix3, Sym};

use super::subject::{State, Subject};

/// Times of an update over that of neo-Hookean elasticity.
#[derive(Clone, Copy, Debug)]
pub struct Speed {
    /// From the virgin state, 95 % of the strains below 0.7 of the natural one.
    pub undamaged: f64,
    /// From three times the natural strain further on: cracks soften, metals flow.
    pub damaging: f64,
    /// The same with strains in a plane (plane strain, or plane stress).
    pub damaging_plane: f64,
}

/// Updates of a batch: their data stay in the cache.
const BATCH: usize = 512;
/// Batches of each law, in turns; the fastest counts.
const ROUNDS: usize = 200;

const RUBBER: NeoHookean = NeoHookean {
    density: 1100.0,
    young: 1e6,
    poisson: 0.45,
};

/// Measures a law.
pub(super) fn speed<S: Subject>(subject: &S, band: f64, seed: u64) -> Speed {
    let law = subject.law();
    let damaging = |plane| ratio(law, &damaging(subject, band, seed, plane));
    Speed {
        undamaged: ratio(law, &undamaged(subject, band, seed)),
        damaging: damaging(S::M::PLANE),
        damaging_plane: damaging(true),
    }
}

type Case<S> = (Increment, State<S>);

/// From rest, most of the way below 0.7 of the natural strain.
fn undamaged<S: Subject>(subject: &S, band: f64, seed: u64) -> Vec<Case<S>> {
    let mut random = Random::new(seed).in_plane(S::M::PLANE);
    let (law, natural) = (subject.law(), subject.strain());
    let case = |_| {
        let direction = random.strain_direction(false);
        let size = if random.chance(0.95) { 0.7 } else { 0.95 };
        let end = direction * (natural * size * random.uniform(0.1, 1.0));
        (step(Sym::ZERO, end, band), law.initial())
    };
    (0..BATCH).map(case).collect()
}

/// Further on in tension, so that a law that cracks does, in any direction or in those of a plane.
fn damaging<S: Subject>(subject: &S, band: f64, seed: u64, plane: bool) -> Vec<Case<S>> {
    let mut random = Random::new(seed).in_plane(plane);
    let (law, natural) = (subject.law(), subject.strain());
    let case = |_| {
        let pull = Sym::dyad(&random.direction()) * natural;
        let start = step(Sym::ZERO, pull * 3.0, band);
        let response = law.update(&start, &law.initial()).ok()?;
        Some((step(pull * 3.0, pull * 3.5, band), response.state))
    };
    (0..10 * BATCH).filter_map(case).take(BATCH).collect()
}

fn step(from: Sym, to: Sym, band: f64) -> Increment {
    let gradient = |strain: Sym| Matrix3::identity() + strain.to_matrix();
    let mut step = Increment::to(gradient(to));
    step.f_old = gradient(from);
    step.band = Band::Uniform(band);
    step
}

/// Fastest batch of a law over the fastest of neo-Hookean elasticity.
fn ratio<M: Material>(law: &M, cases: &[(Increment, M::State)]) -> f64 {
    let elastic: Vec<_> = cases
        .iter()
        .map(|(increment, _)| (*increment, ()))
        .collect();
    let (mut own, mut reference) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..ROUNDS {
        own = own.min(batch(law, cases));
        reference = reference.min(batch(&RUBBER, &elastic));
    }
    own / reference
}

/// Seconds for all updates once.
fn batch<M: Material>(law: &M, cases: &[(Increment, M::State)]) -> f64 {
    let start = Instant::now();
    for (increment, state) in cases {
        black_box(&law.update(black_box(increment), black_box(state)));
    }
    start.elapsed().as_secs_f64()
}
