//! Energy to failure of pure opening, whatever the way there (P8).

use fissure_materials::contract::Random;
use fissure_materials::*;
use fissure_tensor::{Band, Matrix3, Sym, Vector3};

use super::subject::{Fracture, State, Subject, virgin_compliance};

/// Largest `|Σ dissipated × band / G − 1|` over random paths of loading, unloading and contact
/// along one normal, in 1 to 1000 steps, with bands up to 0.99 of the limit. NaN for a law that
/// does not crack; infinite if it refuses a step or does not fail. The paths are uniaxial in strain, or in stress
/// where the stress along a plane would have its part in its failure.
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
    if subject.sees_along() {
        return UniaxialStress::new(subject, fracture, normal, width).path_error(random);
    }
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
    judged(subject, fracture, &state, dissipated * width)
}

/// The error of the energy to failure, if it has failed.
fn judged<S: Subject>(subject: &S, fracture: &Fracture, state: &State<S>, energy: f64) -> f64 {
    let failed = !fracture.fails || subject.cracks(state).iter().any(|crack| crack.failed);
    if failed {
        (energy / fracture.toughness - 1.0).abs()
    } else {
        f64::INFINITY
    }
}

/// A point without stress along the plane. Its strain is set by an opening `u` and a traction `t`, `C⁻¹:(t n⊗n) + (u/L) n⊗n`: that
/// goes past where the point would snap back, and has one answer for every band that the law takes.
struct UniaxialStress<'a, S: Subject> {
    subject: &'a S,
    fracture: &'a Fracture,
    /// `n⊗n` and `C⁻¹:(n⊗n)`, 1/Pa.
    across: Sym,
    compliance: Sym,
    increment: Increment,
    width: f64,
    state: State<S>,
    energy: f64,
}

impl<'a, S: Subject> UniaxialStress<'a, S> {
    fn new(subject: &'a S, fracture: &'a Fracture, normal: Vector3<f64>, width: f64) -> Self {
        let mut increment = Increment::to(Matrix3::identity());
        increment.band = Band::Uniform(width);
        let across = Sym::dyad(&normal);
        let compliance = virgin_compliance(subject.law());
        let compliance = compliance.map_or(Sym::ZERO * f64::NAN, |inverse| inverse.apply(&across));
        Self {
            subject,
            fracture,
            across,
            compliance,
            increment,
            width,
            state: subject.law().initial(),
            energy: 0.0,
        }
    }

    fn path_error(mut self, random: &mut Random) -> f64 {
        self.walk(random).map_or(f64::INFINITY, |()| {
            judged(self.subject, self.fracture, &self.state, self.energy)
        })
    }

    /// Up to openings, and down to shares of the traction that they leave. `None` if a step was refused.
    fn walk(&mut self, random: &mut Random) -> Option<()> {
        let top = 1.1 * self.fracture.opening;
        for level in levels(random, 0.0) {
            let steps = random.log_uniform(1.0, 300.0) as usize;
            let part = |step: usize| step as f64 / steps as f64;
            let cracks = self.subject.cracks(&self.state);
            let from = cracks.first().map_or(0.0, |crack| crack.opening);
            let (most, target) = (self.traction(from), level * top);
            if target > from {
                // A step across the point where it starts to move would have stress along the plane half-way.
                self.go(from, most)?;
                for step in 1..=steps {
                    let opening = from + (target - from) * part(step);
                    let traction = self.traction(opening);
                    self.go(opening, traction)?;
                }
            } else {
                for step in 1..=steps {
                    self.go(from, most * (1.0 + (level.min(0.5) - 1.0) * part(step)))?;
                }
            }
        }
        Some(())
    }

    /// The traction that goes with an opening not below that now: the largest whose answer is itself, Pa.
    fn traction(&self, opening: f64) -> f64 {
        let most = 4.0 * self.subject.strain() / self.compliance.dot(&self.across);
        let (mut low, mut high) = (0.0, most);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            // Round-off of the opening, times the stiffness, is not to count.
            let itself = |normal: f64| normal > middle - 1e-9 * most;
            let answer = self.answer(opening, middle);
            if answer.is_some_and(|(normal, _)| itself(normal)) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// Normal traction and response at an opening and a traction.
    fn answer(&self, opening: f64, traction: f64) -> Option<(f64, Response<State<S>>)> {
        let strain = self.compliance * traction + self.across * (opening / self.width);
        let f = Matrix3::identity() + strain.to_matrix();
        let increment = self.increment.with_end(f);
        let law = self.subject.law();
        let response = law.update(&increment, &self.state).ok()?;
        let mut whole = f;
        whole.m33 = law.out_of_plane_stretch(&response.state).unwrap_or(f.m33);
        let stress = Biot::new(&whole).ok()?.conjugate(&response.stress);
        Some((stress.dot(&self.across), response))
    }

    fn go(&mut self, opening: f64, traction: f64) -> Option<()> {
        let (_, response) = self.answer(opening, traction)?;
        let strain = self.compliance * traction + self.across * (opening / self.width);
        self.increment.f_old = Matrix3::identity() + strain.to_matrix();
        self.energy += response.dissipated * self.width;
        self.state = response.state;
        Some(())
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
