//! P3: the tangent is the derivative of the update.

use fissure_tensor::{Matrix3, Sym};

use super::{Case, gauge::Gauge, runner::Property, subject::Subject};
use crate::{Material, MaterialError, material::columns};

/// Difference steps tried, over the natural strain; a short one resolves sharp bends, a long one
/// keeps round-off small.
const STEPS: [f64; 3] = [1e-3, 1e-4, 1e-5];

/// Every column of the tangent against Richardson-extrapolated differences of the Kirchhoff
/// stress: the central one, or at a kink the one-sided ones, of which one side must agree (at
/// smooth points all three coincide, so that this choice loosens nothing). Bound: `1e-6` of the
/// stiffness or the column's largest entry, whichever is larger, plus the round-off of the
/// difference, `2e-14 / step` of it; the best of three steps counts.
/// The default tangent of the trait is left out: it is a difference quotient itself.
/// Also: `update_with_tangent` gives what `update` gives.
pub(super) fn tangent<M: Material>() -> Property<M> {
    Property {
        name: "P3 tangent",
        hint: "The tangent is the spatial one for the Truesdell rate, see Material::tangent; the \
               column is the Mandel component of the perturbation",
        share: 1.0,
        draw: |subject, random| subject.draw_path(random, false),
        judge,
        must_apply: true,
    }
}

fn judge<M: Material>(subject: &Subject<M>, case: &Case) -> Result<Gauge, MaterialError> {
    let mut gauge = Gauge::default();
    let Some((increment, old)) = subject.last_step(case)? else {
        return Ok(gauge);
    };
    let tangent = subject.law.tangent(&increment, &old)?;
    let (both, tangent_of_both) = subject.law.update_with_tangent(&increment, &old)?;
    let alone = subject.law.update(&increment, &old)?;
    gauge.require(both == alone, "update and update_with_tangent disagree");
    gauge.require(
        tangent == tangent_of_both,
        "tangent and update_with_tangent disagree",
    );
    if subject.is_default_tangent(&increment, &old, &tangent) {
        return Ok(gauge);
    }
    let jacobian = |f: &Matrix3<f64>, state: &M::State| subject.whole(f, state).determinant();
    let kirchhoff = |d: &Sym, size: f64| -> Result<Sym, MaterialError> {
        let f = (Matrix3::identity() + d.to_matrix() * size) * increment.f_new;
        let response = subject.law.update(&increment.with_end(f), &old)?;
        Ok(response.stress * jacobian(&f, &response.state))
    };
    let jacobian_here = jacobian(&increment.f_new, &alone.state);
    let here = alone.stress * jacobian_here;
    for &column in columns::<M>() {
        let mut d = Sym::ZERO;
        d.mandel[column] = 1.0;
        let convected = Sym::from_matrix(&(d.to_matrix() * alone.stress.to_matrix())) * 2.0;
        let claimed = (tangent.apply(&d) + convected) * jacobian_here;
        let scale = subject.stiffness.max(claimed.max_abs());
        let mut best = (f64::INFINITY, 0.0);
        for step in STEPS {
            let h = step * subject.natural;
            let (far, near) = (kirchhoff(&d, h)?, kirchhoff(&d, 0.5 * h)?);
            let (far_back, near_back) = (kirchhoff(&d, -h)?, kirchhoff(&d, -0.5 * h)?);
            let central = ((near - near_back) * 8.0 - (far - far_back)) / (6.0 * h);
            let forward = (near * 4.0 - far - here * 3.0) / h;
            let backward = (here * 3.0 + far_back - near_back * 4.0) / h;
            let error = [central, forward, backward]
                .map(|slope| (slope - claimed).max_abs())
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            let bound = scale * (1e-6 + 2e-14 / h);
            if best.1 == 0.0 || error / bound < best.0 / best.1 {
                best = (error, bound);
            }
            if error <= bound {
                break;
            }
        }
        gauge.check(best.0, best.1, COLUMNS[column]);
    }
    Ok(gauge)
}

const COLUMNS: [&str; 6] = [
    "the xx column differs from the difference quotient, Pa",
    "the yy column differs from the difference quotient, Pa",
    "the zz column differs from the difference quotient, Pa",
    "the yz column differs from the difference quotient, Pa",
    "the xz column differs from the difference quotient, Pa",
    "the xy column differs from the difference quotient, Pa",
];
