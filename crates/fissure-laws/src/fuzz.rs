//! Millions of updates along random walks, and what must not happen in any of them.

use std::fmt::Debug;
use std::panic::{AssertUnwindSafe, catch_unwind};

use fissure_materials::contract::{Random, is_difference_quotient, tangent_error};
use fissure_materials::*;
use fissure_tensor::{Matrix3, Sym};

use super::subject::{State, Subject, stiffness};
use super::walk::{Kind, Proposal, STEPS, Walk};

/// Counts of a fuzz.
#[derive(Clone, Debug)]
pub struct Fuzzed {
    /// Updates asked for.
    pub updates: u64,
    /// Updates at which `det F` was in [0.2, 5], in units of common size; in plane stress those for which a thickness exists.
    pub sound: u64,
    /// Typed errors among these.
    pub typed_errors: u64,
    /// Typed errors among the others: `det F` or the units are out of range.
    pub typed_errors_elsewhere: u64,
    /// Accepted updates with a stress, an energy or a value that is not finite.
    pub not_finite: u64,
    /// Walks that panicked.
    pub panics: u64,
    /// Updates that dissipated less than zero by more than round-off.
    pub negative_dissipation: u64,
    /// Updates in which something that only grows fell.
    pub irreversibility_violations: u64,
    /// Updates from a state with a crack, and from one with a failed crack.
    pub cracked: u64,
    /// Updates from a state with a failed crack.
    pub failed: u64,
    /// Most cracks of a state.
    pub most_cracks: usize,
    /// Largest error of the tangent, over the stiffness or the column; NaN if none was taken.
    pub tangent_error: f64,
    /// Where it was: the update, the increment and the state it started from, in words.
    pub worst_tangent: Option<String>,
    /// Tangents compared.
    pub tangents: u64,
    /// Of these such as were difference quotients themselves: compared were two quotients then.
    pub numerical_tangents: u64,
    /// The first update that did what must not happen, in words.
    pub first: Option<String>,
}

impl Default for Fuzzed {
    fn default() -> Self {
        Self {
            updates: 0,
            sound: 0,
            typed_errors: 0,
            typed_errors_elsewhere: 0,
            not_finite: 0,
            panics: 0,
            negative_dissipation: 0,
            irreversibility_violations: 0,
            cracked: 0,
            failed: 0,
            most_cracks: 0,
            tangent_error: f64::NAN,
            worst_tangent: None,
            tangents: 0,
            numerical_tangents: 0,
            first: None,
        }
    }
}

impl Fuzzed {
    /// What the tangents compared were: `analytic`, `numerical`, or `both`, analytic but where no closed form is known.
    pub fn tangent(&self) -> &'static str {
        match self.numerical_tangents {
            0 => "analytic",
            all if all == self.tangents => "numerical",
            _ => "both",
        }
    }

    /// This update, and what was wrong with it, in words.
    fn words<S: Debug>(&self, what: &str, walk: &Walk, increment: &Increment, old: &S) -> String {
        let (number, kind) = (self.updates, walk.kind);
        format!(
            "update {number}, of a walk of the kind {kind:?}, {what}: {increment:?} from {old:?}"
        )
    }

    /// Keeps the first offence.
    fn tell<S: Debug>(&mut self, what: &str, walk: &Walk, increment: &Increment, old: &S) {
        if self.first.is_none() {
            self.first = Some(self.words(what, walk, increment, old));
        }
    }
}

/// Whether there is no thickness at which a sheet stretched so has no stress across: with a stress that is linear in the
/// strain the thickness is used up at an in-plane trace of `(1 − ν)/ν`, or 1 for a small strain. Then there is no `det F`.
fn is_too_thin(error: &MaterialError) -> bool {
    matches!(error, MaterialError::Deformation { determinant } if *determinant <= 0.0)
}

/// Every so many updates a tangent is compared.
const TANGENT_EVERY: u64 = 256;

/// Difference steps of tangents, over the strain at failure; the best counts.
const TANGENT_STEPS: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];

/// The least difference step, which leaves some 1e-6 of round-off: between kinks that are nearer no quotient says more.
const LEAST: f64 = 1e-10;

/// What a fuzz knows of its law.
struct Target<'a, S> {
    subject: &'a S,
    stiffness: f64,
    opening: Option<f64>,
}

/// Asks for `updates` updates along walks of a seed.
pub(super) fn fuzz<S: Subject>(subject: &S, updates: u64, seed: u64) -> Fuzzed {
    let fracture = subject.fracture();
    let target = Target {
        subject,
        stiffness: stiffness(subject.law()),
        opening: fracture.map(|f| f.opening),
    };
    let limit = subject.band_limit();
    let widest = if limit.is_finite() { limit } else { 1.0 };
    let ways = (S::M::OBJECTIVE, S::M::PLANE);
    let mut counts = Fuzzed::default();
    let mut random = Random::new(seed).in_plane(S::M::PLANE);
    while counts.updates < updates {
        let mut walk = Walk::new(&mut random, subject.strain(), target.opening, widest, ways);
        let before = counts.updates;
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            target.walk(&mut walk, &mut random, &mut counts, updates);
        }));
        if outcome.is_err() {
            // The walk ends with its panic, and the next one starts.
            counts.updates = counts.updates.max(before + 1);
            counts.panics += 1;
            let first = format!(
                "update {} of the {:?} walk panicked",
                counts.updates, walk.kind
            );
            counts.first.get_or_insert(first);
        }
    }
    counts
}

impl<S: Subject> Target<'_, S> {
    /// One walk from the virgin law, of at most `updates` in all.
    fn walk(&self, walk: &mut Walk, random: &mut Random, counts: &mut Fuzzed, updates: u64) {
        let law = self.subject.law();
        let mut increment = Increment::to(Matrix3::identity());
        increment.band = walk.band;
        increment.external.scale = walk.scale;
        increment.external.temperature = walk.temperature;
        let mut state = law.initial();
        let mut listed = self.subject.irreversible(&state);
        let mut spare = listed.clone();
        let mut values = vec![0.0; S::M::NAMES.len()];
        for _ in 0..STEPS {
            if counts.updates >= updates {
                return;
            }
            let proposal = walk.propose(random);
            increment.f_new = proposal.f;
            counts.updates += 1;
            let common = proposal.sound && walk.kind != Kind::Units;
            let response = match law.update(&increment, &state) {
                Ok(response) => response,
                Err(error) => {
                    let there = common && !(S::M::PLANE && is_too_thin(&error));
                    counts.sound += u64::from(there);
                    if there {
                        counts.typed_errors += 1;
                    } else {
                        counts.typed_errors_elsewhere += 1;
                    }
                    continue;
                }
            };
            counts.sound += u64::from(common);
            law.values(&response.state, &mut values);
            let finite = response.stress.is_finite()
                && response.stored.is_finite()
                && response.dissipated.is_finite()
                && values.iter().all(|value| value.is_finite());
            counts.not_finite += u64::from(!finite);
            if !finite {
                counts.tell("gave numbers not finite", walk, &increment, &state);
            }
            if !proposal.sound {
                continue; // Judged, but not gone to: what follows would be of no use.
            }
            let strain = walk.accept(&proposal);
            let energy = response.stress.norm() * strain.norm() + response.stored.abs();
            let floor = -1e-12 * energy;
            if response.dissipated < floor {
                counts.negative_dissipation += 1;
                counts.tell("dissipated less than nothing", walk, &increment, &state);
            }
            spare.clear();
            spare.extend(self.subject.irreversible(&response.state));
            let kept =
                spare.len() >= listed.len() && spare.iter().zip(&listed).all(|(n, o)| n >= o);
            if !kept {
                counts.irreversibility_violations += 1;
                counts.tell("let fall what only grows", walk, &increment, &state);
            }
            std::mem::swap(&mut listed, &mut spare);
            self.look(&state, counts);
            if counts.updates.is_multiple_of(TANGENT_EVERY) {
                self.tangent(walk, &proposal, &increment, &state, counts);
            }
            state = response.state;
            increment.f_old = increment.f_new;
        }
    }

    /// Counts the cracks of a state.
    fn look(&self, state: &State<S>, counts: &mut Fuzzed) {
        let cracks = self.subject.cracks(state);
        counts.cracked += u64::from(!cracks.is_empty());
        counts.failed += u64::from(cracks.iter().any(|crack| crack.failed));
        counts.most_cracks = counts.most_cracks.max(cracks.len());
    }

    /// Compares a tangent, at strains at which a difference quotient resolves it.
    fn tangent(
        &self,
        walk: &Walk,
        proposal: &Proposal,
        increment: &Increment,
        old: &State<S>,
        counts: &mut Fuzzed,
    ) {
        let strain = Sym::from_matrix(&(proposal.f.transpose() * proposal.f - Matrix3::identity()));
        let [first, second, third] = strain.spectrum().values;
        let strain = strain.norm();
        if walk.kind == Kind::Units || !(strain < 0.5) {
            return;
        }
        let natural = self.subject.strain();
        let opening = self.opening.map_or(20.0 * natural, |opening| {
            opening / increment.band.max_width()
        });
        let failure = (natural + opening).min(0.1);
        let [a, b, c, d] = TANGENT_STEPS.map(|step| step * failure);
        // A failed crack that follows the strain turns over strains of its size, and where the last step ended cracks have
        // their kinks, of several planes many: where there is one on either side no quotient across them is the derivative.
        let near = 1e-2 * strain.min(failure);
        let moved = (increment.f_new - increment.f_old).norm().min(failure);
        let [within, well_within] = [0.1 * moved, 0.01 * moved];
        // A plane across a principal direction turns over strains of the size of what that is ahead of the next.
        let apart = (1e-2 * (first - second).min(second - third)).clamp(1e-6 * c, a);
        let steps = [a, b, c, d, near, within, well_within, apart, LEAST];
        let law = self.subject.law();
        if let Ok(error) = tangent_error(law, increment, old, self.stiffness, &steps) {
            counts.tangents += 1;
            let numerical = is_difference_quotient(law, increment, old);
            counts.numerical_tangents += u64::from(numerical == Ok(true));
            if !(error <= counts.tangent_error) {
                let what = format!("has a tangent {error:.2e} off");
                counts.tangent_error = error;
                counts.worst_tangent = Some(counts.words(&what, walk, increment, old));
            }
        }
    }
}
