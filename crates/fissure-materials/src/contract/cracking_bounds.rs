//! P5 consistency, P7 irreversibility and P16 traction bounds.

use fissure_tensor::Sym;

use super::{gauge::Gauge, runner::Property, subject::Subject};
use crate::{Crack, Cracking, MaterialError, Scale};

/// Round-off of a traction recovered from the Cauchy stress, over the strength.
fn round_off<M: Cracking>(subject: &Subject<M>, strain: f64) -> f64 {
    1e-10 + (1e-14 + 1e-13 * strain) / subject.natural
}

/// In pure opening: without a crack the failure function is not positive; a crack that softened
/// in a step and still carries something is on its failure function, in opening `strength × ratio`
/// ([`Cracking::failure_of`] vanishes where the multiplier does not). Bound: `1e-10` of the strength plus round-off, over
/// `1 − band/limit`.
pub(super) fn consistency<M: Cracking>() -> Property<M> {
    Property {
        name: "P5 consistency",
        hint: "The return to the softening curve did not reach it, or a crack starts late; if the \
               law judges another stress than Biot's, override Cracking::driving_stress",
        share: 0.25,
        draw: |subject, random| subject.draw_opening(random),
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            let (law, scale) = (subject.law, Scale::default());
            let gradients = case.gradients();
            let responses = subject.drive(&gradients, &case.band, &scale)?;
            let tolerance = round_off(subject, case.max_strain());
            let mut before = law.irreversible(&law.initial());
            for (response, f) in responses.iter().zip(&gradients[1..]) {
                let f = subject.whole(f, &response.state);
                let stress = law.driving_stress(&f, &response.stress)?;
                let now = law.irreversible(&response.state);
                match law.cracks(&response.state).as_slice() {
                    [] => gauge.check(
                        law.initiation(&stress, &scale).value,
                        tolerance,
                        "the failure function is positive and there is no crack",
                    ),
                    [crack] if !crack.failed && now != before => gauge.check(
                        law.failure_of(&stress, crack, &scale).abs(),
                        tolerance / subject.reserve(crack.width),
                        "a softening crack is off its failure function",
                    ),
                    _ => {}
                }
                before = now;
            }
            Ok(gauge)
        },
        must_apply: true,
    }
}

/// What the law lists as irreversible never falls, by not one bit; a failed crack stays failed and
/// no crack heals; strength ratio and dissipated fraction stay in 0 to 1 and are monotone.
pub(super) fn irreversibility<M: Cracking>() -> Property<M> {
    Property {
        name: "P7 irreversibility",
        hint: "Take the larger of old and new where the state is written",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, true),
        judge: judge_irreversibility,
        must_apply: true,
    }
}

fn judge_irreversibility<M: Cracking>(
    subject: &Subject<M>,
    case: &super::Case,
) -> Result<Gauge, MaterialError> {
    let mut gauge = Gauge::default();
    let law = subject.law;
    let responses = subject.drive(&case.gradients(), &case.band, &Scale::default())?;
    let mut before = law.irreversible(&law.initial());
    let mut cracks_before = Vec::new();
    for response in responses {
        let now = law.irreversible(&response.state);
        let rises = now.len() == before.len() && before.iter().zip(&now).all(|(b, n)| n >= b);
        gauge.require(rises, "an irreversible quantity fell");
        let cracks = law.cracks(&response.state);
        gauge.require(cracks.len() >= cracks_before.len(), "a crack healed");
        for (index, crack) in cracks.iter().enumerate() {
            let unit = 0.0..=1.0;
            let inside =
                unit.contains(&crack.strength_ratio) && unit.contains(&crack.dissipated_fraction);
            gauge.require(inside, "a ratio of strength or energy is outside 0 to 1");
            gauge.require(crack.opening >= 0.0, "a crack is open by less than nothing");
            gauge.softened |= crack.dissipated_fraction > 0.0;
            gauge.failed |= crack.failed;
            let Some(old): Option<&Crack> = cracks_before.get(index) else {
                continue;
            };
            let monotone = crack.failed >= old.failed
                && crack.strength_ratio <= old.strength_ratio
                && crack.dissipated_fraction >= old.dissipated_fraction;
            gauge.require(monotone, "a crack recovered strength or energy");
        }
        (before, cracks_before) = (now, cracks);
    }
    Ok(gauge)
}

/// On any path, the normal traction of every crack is at most its remaining strength, for failed
/// ones nothing. Bound: `strength × ratio`, with `1e-10` of the strength plus round-off, over
/// `1 − band/limit`.
pub(super) fn traction_bound<M: Cracking>() -> Property<M> {
    Property {
        name: "P16 traction bound",
        hint: "A crack carries more than Crack::strength_ratio says it has left",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, true),
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            let gradients = case.gradients();
            let responses = subject.drive(&gradients, &case.band, &Scale::default())?;
            let tolerance = round_off(subject, case.max_strain());
            for (response, f) in responses.iter().zip(&gradients[1..]) {
                let f = subject.whole(f, &response.state);
                let stress = subject.law.driving_stress(&f, &response.stress)?;
                for crack in subject.law.cracks(&response.state) {
                    gauge.check(
                        traction(subject, &stress, &crack) - crack.strength_ratio,
                        tolerance / subject.reserve(crack.width),
                        "normal traction less remaining strength, over the strength",
                    );
                }
            }
            Ok(gauge)
        },
        must_apply: true,
    }
}

/// Normal traction over strength.
fn traction<M: Cracking>(subject: &Subject<M>, stress: &Sym, crack: &Crack) -> f64 {
    stress.normal_component(&crack.normal) / subject.law.strength(&Scale::default())
}
