//! P6: the second law, and stored plus dissipated energy against work.

use fissure_tensor::{Matrix3, Sym};

use super::case::gradient;
use super::{Case, gauge::Gauge, runner::Property, subject::Subject};
use crate::{Material, MaterialError};

/// `dissipated ≥ 0` in every step, and stored plus dissipated energy equal to the work of the
/// stress.
///
/// The work is a trapezoid over sub-steps, `∫ Rᵀ·P : dU` with the rotation of the path left out
/// (it does no work), and the bound its own error estimate, half the sum of second differences of
/// the stress times the strain of a sub-step, which goes to zero with the sub-steps; 64 of them
/// per step, 1024 where these do not suffice. Plus round-off: `1e-11` of the work and `1e-15` of
/// stiffness times strain per sub-step. Laws that are not hyperelastic: plus 20 times strain times
/// work, first order in the strain. Lower bound of `dissipated`: `-1e-12` of work plus energy.
pub(super) fn dissipation<M: Material>() -> Property<M> {
    Property {
        name: "P6 dissipation",
        hint: "Response::stored is the total, Response::dissipated that of this increment, both \
               per reference volume",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, true),
        judge: |subject, case| {
            let coarse = ledger(subject, case, 64)?;
            if coarse.failure.is_none() {
                return Ok(coarse);
            }
            ledger(subject, case, 1024)
        },
        must_apply: true,
    }
}

fn ledger<M: Material>(
    subject: &Subject<M>,
    case: &Case,
    substeps: usize,
) -> Result<Gauge, MaterialError> {
    let mut gauge = Gauge::default();
    let rest = subject
        .law
        .update(&subject.rest(), &subject.law.initial())?;
    let mut state = subject.law.initial();
    let (mut work, mut gross, mut error, mut dissipated) = (0.0, 0.0, 0.0, 0.0);
    let (mut point, mut stored) = ((Matrix3::identity(), Sym::ZERO), rest.stored);
    let mut stress = rest.stress;
    let mut strain_so_far: f64 = 0.0;
    for step in &case.steps {
        let mut change = Sym::ZERO;
        let strain = step.strain / substeps as f64;
        let start = point;
        let mut f_old = gradient(&point);
        for part in 1..=substeps {
            point = step.apply(&start, part as f64 / substeps as f64);
            let f_new = gradient(&point);
            let mut increment = subject.increment(f_old, f_new, &case.band);
            increment.dt /= substeps as f64;
            let response = subject.law.update(&increment, &state)?;
            let whole = subject.whole(&f_new, &response.state);
            let next = conjugate(&whole, &point.0, &response.stress);
            let work_here = (stress + next).dot(&strain) * 0.5;
            let next_change = next - stress;
            // The first second difference of a step spans its corner and is as good a scale.
            error += 0.5 * (next_change - change).norm() * strain.norm();
            work += work_here;
            gross += work_here.abs();
            dissipated += response.dissipated;
            strain_so_far = strain_so_far.max(point.1.norm());
            let energy =
                1e-12 * (work_here.abs() + response.stored.abs()) + 1e-28 * subject.stiffness;
            gauge.check(
                -response.dissipated,
                energy,
                "a step dissipated negative energy, J/m³",
            );
            (stored, state) = (response.stored, response.state);
            (stress, change, f_old) = (next, next_change, f_new);
        }
        let count = (substeps * case.steps.len()) as f64;
        let mut bound = error
            + 1e-11 * gross
            + 1e-15 * count * subject.stiffness * strain_so_far
            // An energy from invariants of FᵀF is a difference of numbers near 1.
            + 1e-15 * subject.stiffness;
        if !M::HYPERELASTIC {
            bound += 20.0 * strain_so_far * gross;
        }
        let imbalance = (stored - rest.stored + dissipated - work).abs();
        gauge.check(
            imbalance,
            bound,
            "stored plus dissipated energy is not the work, J/m³",
        );
    }
    Ok(gauge)
}

/// Symmetric part of `Rᵀ·P`, `P = J σ F⁻ᵀ`: what does work on the rate of `U`.
fn conjugate(f: &Matrix3<f64>, rotation: &Matrix3<f64>, stress: &Sym) -> Sym {
    // The paths keep U positive definite; a singular F was refused by the law before.
    let inverse = f.try_inverse().unwrap_or_else(Matrix3::zeros);
    let first = stress.to_matrix() * inverse.transpose() * f.determinant();
    Sym::from_matrix(&(rotation.transpose() * first))
}
