//! P4 symmetry, P11 slope bound and P13 positive unloading stiffness.

use fissure_tensor::{Matrix3, Tangent};

use super::{gauge::Gauge, runner::Property, subject::Subject};
use crate::{Cracking, Scale};

/// The tangent has the major symmetry while the crack's direction is fixed, for laws that call
/// themselves associated ([`Cracking::associated`]); for others the departure is only reported in
/// [`Summary::asymmetry`](super::Summary::asymmetry). Left out: the step in which a crack starts,
/// where its band turns with the normal, and the
/// default tangent of the trait, which is symmetric to its own error only. Bound: `1e-9` of the largest entry or the stiffness.
pub(super) fn symmetry<M: Cracking>() -> Property<M> {
    Property {
        name: "P4 symmetry of the tangent",
        hint: "If the flow is meant not to follow from the failure function, override \
               Cracking::associated",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, true),
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            let Some((increment, old)) = subject.last_step(case)? else {
                return Ok(gauge);
            };
            let (response, tangent) = subject.law.update_with_tangent(&increment, &old)?;
            let started =
                subject.law.cracks(&old).len() != subject.law.cracks(&response.state).len();
            if started || subject.is_default_tangent(&increment, &old, &tangent) {
                return Ok(gauge);
            }
            let difference = (tangent - Tangent(tangent.0.transpose())).max_abs();
            gauge.asymmetry = difference / subject.stiffness;
            let bound = if subject.law.associated() {
                1e-9 * subject.stiffness.max(tangent.max_abs())
            } else {
                f64::INFINITY
            };
            gauge.check(difference, bound, "the tangent is not symmetric, Pa");
            Ok(gauge)
        },
        must_apply: false,
    }
}

/// With the crack's direction fixed, the stress changes by at most `|C|/(1 − r)` per strain, `r`
/// the band over its limit. Bound: that, times `1 + 20 |strain|` for what finite strain adds, plus
/// `1e-13 |C|/(1 − r)` of round-off. Laws that say they jump ([`Material::continuous`](crate::Material::continuous)) are exempt.
pub(super) fn slope<M: Cracking>() -> Property<M> {
    Property {
        name: "P11 slope bound",
        hint: "A jump or a snap-back between two branches of the update",
        share: 1.0,
        draw: |subject, random| {
            let mut case = subject.draw_path(random, false);
            let spin = Default::default();
            let size = subject.natural * random.log_uniform(1e-4, 1.0);
            let strain = random.strain_direction(false) * size;
            case.steps.push(super::Step { strain, spin });
            case
        },
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            if !subject.law.continuous() {
                return Ok(gauge);
            }
            let gradients = case.gradients();
            let [history @ .., from, to] = gradients.as_slice() else {
                return Ok(gauge);
            };
            let responses = subject.drive(history, &case.band, &Scale::default())?;
            let (Some(last), Some(at)) = (responses.last(), history.last()) else {
                return Ok(gauge);
            };
            let cracks = subject.law.cracks(&last.state);
            let Some(width) = cracks.iter().map(|c| c.width).reduce(f64::max) else {
                return Ok(gauge);
            };
            let first = subject.increment(*at, *from, &case.band);
            let second = first.with_end(*to);
            let here = subject.law.update(&first, &last.state)?;
            let there = subject.law.update(&second, &last.state)?;
            let steepest = largest_eigenvalue(subject) / subject.reserve(width);
            let change = case.steps.last().map_or(0.0, |step| step.strain.norm());
            let geometry = 1.0 + 20.0 * case.max_strain();
            gauge.check(
                (there.stress - here.stress).norm(),
                steepest * (geometry * change + 1e-13),
                "the stress changes faster than stiffness over 1 - band/limit, Pa",
            );
            Ok(gauge)
        },
        must_apply: false,
    }
}

/// Seen through the interface: the stored energy is not negative, and the tangent on unloading a
/// cracked state by a thousandth of its strain, which is the secant or elastic stiffness, has
/// eigenvalues between zero and the largest one of the virgin law. Bounds: `1e-8 + 10 |strain|` of
/// that largest one on either side, since the spatial tangent holds the stress; for the energy
/// `-1e-14` of stiffness times strain squared.
pub(super) fn unloading<M: Cracking>() -> Property<M> {
    Property {
        name: "P13 positive unloading stiffness",
        hint: "A secant stiffness that is indefinite or stiffer than the virgin law creates \
               energy in a cycle",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, false),
        judge: |subject, case| {
            let mut gauge = Gauge::default();
            let gradients = case.gradients();
            let responses = subject.drive(&gradients, &case.band, &Scale::default())?;
            let strain = case.max_strain();
            let energy = 1e-14 * subject.stiffness * (strain * strain + 1e-14);
            for response in &responses {
                gauge.check(-response.stored, energy, "negative energy is stored, J/m³");
            }
            let (Some(last), Some((rotation, reached)), Some(f_old)) = (
                responses.last(),
                case.points().last().copied(),
                gradients.last(),
            ) else {
                return Ok(gauge);
            };
            if subject.law.cracks(&last.state).is_empty() {
                return Ok(gauge);
            }
            let f_new = rotation * (Matrix3::identity() + (reached * 0.999).to_matrix());
            let increment = subject.increment(*f_old, f_new, &case.band);
            let tangent = subject.law.tangent(&increment, &last.state)?;
            let eigenvalues = tangent.symmetric_part().0.symmetric_eigenvalues();
            let largest = largest_eigenvalue(subject);
            let slack = largest * (1e-8 + 10.0 * strain);
            gauge.check(
                -eigenvalues.min(),
                slack,
                "the unloading stiffness has a negative eigenvalue, Pa",
            );
            gauge.check(
                eigenvalues.max() - largest,
                slack,
                "the unloading stiffness is over that of the virgin law, Pa",
            );
            Ok(gauge)
        },
        must_apply: true,
    }
}

/// Largest eigenvalue of the virgin tangent, Pa.
fn largest_eigenvalue<M: Cracking>(subject: &Subject<M>) -> f64 {
    let symmetric = subject.modulus.symmetric_part().0;
    symmetric.symmetric_eigenvalues().max()
}
