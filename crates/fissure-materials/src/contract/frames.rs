//! P9 objectivity and P10 isotropy: the same path seen in other frames.

use fissure_tensor::{Band, Matrix3, Sym, rotation};

use super::{Case, gauge::Gauge, runner::Property, subject::Subject};
use crate::{Material, MaterialError, Scale};

/// `F → Q·F` with another `Q` at every point of the path, the first one included: the stress turns
/// with `Q`, energies do not change, and so to the end of the path, which shows that the states
/// agree whatever frame they are kept in. Bound: see [`compare`]. Laws with
/// `OBJECTIVE = false` are exempt.
pub(super) fn objectivity<M: Material>() -> Property<M> {
    Property {
        name: "P9 objectivity",
        hint: "A rotation on top of a deformation must only rotate the stress: use U of F = R·U, \
               not the symmetric part of F, and keep directions in the reference configuration",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, false),
        judge: |subject, case| {
            if !M::OBJECTIVE {
                return Ok(Gauge::default());
            }
            let turn = |index: usize| {
                // Another rotation at every point: the angles are multiples with no pattern.
                let angle = case.turn.norm() * (1.0 + 0.7 * index as f64);
                rotation(&case.turn, angle)
            };
            let rotations: Vec<_> = (0..=case.steps.len()).map(turn).collect();
            let transform = |index: usize, f: &Matrix3<f64>| rotations[index] * f;
            compare(subject, case, transform, |index, stress| {
                stress.congruence(&rotations[index])
            })
        },
        must_apply: M::OBJECTIVE,
    }
}

/// `F → Q·F·Qᵀ` with one `Q` from the virgin material on: the stress turns with `Q`. Together with
/// objectivity that is isotropy in the reference configuration. Bound: see [`compare`]. Laws that
/// say they are not isotropic ([`Material::isotropic`]) are exempt.
pub(super) fn isotropy<M: Material>() -> Property<M> {
    Property {
        name: "P10 isotropy",
        hint: "A virgin isotropic law has no preferred axes; if it is meant to have, override \
               Material::isotropic",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, false),
        judge: |subject, case| {
            if !subject.law.isotropic() {
                return Ok(Gauge::default());
            }
            let q = rotation(&case.turn, case.turn.norm());
            let transform = |_: usize, f: &Matrix3<f64>| q * f * q.transpose();
            compare(subject, case, transform, |_, stress| stress.congruence(&q))
        },
        must_apply: false,
    }
}

/// Drives the path and the transformed one and compares.
///
/// Bound: `1e-11` of stiffness times strain, `1e-14` of the stiffness, and twenty times what the
/// law itself makes of a perturbation of `F` by round-off, measured on two perturbed twins. From
/// where these differ by more than `1e-6` the comparison is left out: near repeated principal
/// values no choice of a crack's direction is equivariant. Bands are made uniform, since a band
/// belongs to the discretisation, which does not turn.
fn compare<M: Material>(
    subject: &Subject<M>,
    case: &Case,
    transform: impl Fn(usize, &Matrix3<f64>) -> Matrix3<f64>,
    expect: impl Fn(usize, &Sym) -> Sym,
) -> Result<Gauge, MaterialError> {
    let mut gauge = Gauge::default();
    let band = Band::Uniform(case.band.max_width());
    let scale = Scale::default();
    let gradients = case.gradients();
    let base = subject.drive(&gradients, &band, &scale)?;
    let twins = [1.0, -1.0].map(|sign| {
        let twin: Vec<_> = gradients.iter().map(|f| perturbed(f, sign)).collect();
        subject.drive(&twin, &band, &scale)
    });
    let turned: Vec<_> = gradients
        .iter()
        .enumerate()
        .map(|(index, f)| transform(index, f))
        .collect();
    let turned = subject.drive(&turned, &band, &scale)?;
    let [plus, minus] = twins;
    let (plus, minus) = (plus?, minus?);
    let strain = case.max_strain();
    for (index, (here, there)) in base.iter().zip(&turned).enumerate() {
        let (mut stress_twins, mut energy_twins): (f64, f64) = (0.0, 0.0);
        for twin in [&plus[index], &minus[index]] {
            stress_twins = stress_twins.max((twin.stress - here.stress).max_abs());
            energy_twins = energy_twins
                .max((twin.stored - here.stored).abs())
                .max((twin.dissipated - here.dissipated).abs());
        }
        if stress_twins > 1e-6 * subject.stiffness * (strain + 1e-7) {
            break;
        }
        let bound = subject.stiffness * (1e-11 * strain + 1e-14) + 20.0 * stress_twins;
        let difference = (there.stress - expect(index + 1, &here.stress)).max_abs();
        gauge.check(difference, bound, "the stress differs between frames, Pa");
        let energy = subject.stiffness * strain * (1e-11 * strain + 1e-14)
            // An energy from invariants of FᵀF is a difference of numbers near 1.
            + 1e-15 * subject.stiffness
            + 20.0 * energy_twins;
        let stored = (there.stored - here.stored).abs();
        gauge.check(stored, energy, "the stored energy differs between frames");
        let dissipated = (there.dissipated - here.dissipated).abs();
        gauge.check(dissipated, energy, "the dissipation differs between frames");
    }
    Ok(gauge)
}

/// `F` with every entry moved by a few units in the last place of 1.
pub(super) fn perturbed(f: &Matrix3<f64>, sign: f64) -> Matrix3<f64> {
    const PATTERN: [f64; 9] = [1.0, -0.6, 0.3, 0.8, -1.0, 0.5, -0.4, 0.7, 0.9];
    f + Matrix3::from_column_slice(&PATTERN) * (sign * 1e-15)
}
