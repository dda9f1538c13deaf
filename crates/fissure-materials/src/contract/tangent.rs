//! P3: the tangent is the derivative of the update.

use fissure_tensor::{Matrix3, Sym, Tangent};

use super::{Case, gauge::Gauge, runner::Property, subject::Subject};
use crate::material::{DIFFERENCE_STEP, columns, completed, difference_tangent};
use crate::{Increment, Material, MaterialError, Response};

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
    for &column in columns::<M>() {
        let slope = Slope::new(subject.law, &increment, &old, &tangent, &alone, column);
        let scale = subject.stiffness.max(slope.claimed.max_abs());
        let mut best = (f64::INFINITY, 0.0);
        for step in STEPS {
            let h = step * subject.natural;
            let error = slope.error(h)?;
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

/// Largest error of a column of the law's tangent against Richardson-extrapolated differences of
/// its update, over the `stiffness` or the column, whichever is larger. Central differences count,
/// or at a kink the better one-sided ones, with the best of `steps` (relative changes of `F`).
///
/// # Errors
/// As [`Material::update`].
pub fn tangent_error<M: Material>(
    law: &M,
    increment: &Increment,
    old: &M::State,
    stiffness: f64,
    steps: &[f64],
) -> Result<f64, MaterialError> {
    let (here, tangent) = law.update_with_tangent(increment, old)?;
    let mut largest: f64 = 0.0;
    for &column in columns::<M>() {
        let slope = Slope::new(law, increment, old, &tangent, &here, column);
        let mut best = f64::INFINITY;
        for &step in steps {
            best = best.min(slope.error(step)?);
        }
        largest = largest.max(best / stiffness.max(slope.claimed.max_abs()));
    }
    Ok(largest)
}

/// Whether a law's tangent in this step is the difference quotient that [`Material::tangent`] takes by default, to the last
/// bit. [`tangent_error`] then compares two quotients of the same update, with different steps. Where nothing is carried both
/// are zero, and that counts as no quotient.
///
/// # Errors
/// As [`Material::update`].
pub fn is_difference_quotient<M: Material>(
    law: &M,
    increment: &Increment,
    old: &M::State,
) -> Result<bool, MaterialError> {
    let tangent = law.tangent(increment, old)?;
    let quotient = difference_tangent(law, increment, old, DIFFERENCE_STEP)?;
    Ok(quotient == tangent && tangent.max_abs() > 0.0)
}

/// How the Kirchhoff stress changes with one Mandel component of a change of `F`.
struct Slope<'a, M: Material> {
    law: &'a M,
    increment: &'a Increment,
    old: &'a M::State,
    direction: Sym,
    /// Kirchhoff stress, Pa.
    here: Sym,
    /// What the tangent says, Pa.
    claimed: Sym,
}

impl<'a, M: Material> Slope<'a, M> {
    fn new(
        law: &'a M,
        increment: &'a Increment,
        old: &'a M::State,
        tangent: &Tangent,
        response: &Response<M::State>,
        column: usize,
    ) -> Self {
        let mut direction = Sym::ZERO;
        direction.mandel[column] = 1.0;
        let jacobian = completed(law, &increment.f_new, &response.state).determinant();
        let stress = response.stress;
        let convected = Sym::from_matrix(&(direction.to_matrix() * stress.to_matrix())) * 2.0;
        Self {
            law,
            increment,
            old,
            direction,
            here: stress * jacobian,
            claimed: (tangent.apply(&direction) + convected) * jacobian,
        }
    }

    fn kirchhoff(&self, size: f64) -> Result<Sym, MaterialError> {
        let change = Matrix3::identity() + self.direction.to_matrix() * size;
        let f = change * self.increment.f_new;
        let response = self.law.update(&self.increment.with_end(f), self.old)?;
        Ok(response.stress * completed(self.law, &f, &response.state).determinant())
    }

    /// Smallest difference to the central, the forward and the backward quotient of step `h`, Pa.
    fn error(&self, h: f64) -> Result<f64, MaterialError> {
        let (far, near) = (self.kirchhoff(h)?, self.kirchhoff(0.5 * h)?);
        let (far_back, near_back) = (self.kirchhoff(-h)?, self.kirchhoff(-0.5 * h)?);
        let central = ((near - near_back) * 8.0 - (far - far_back)) / (6.0 * h);
        let forward = (near * 4.0 - far - self.here * 3.0) / h;
        let backward = (self.here * 3.0 + far_back - near_back * 4.0) / h;
        let errors = [central, forward, backward].map(|slope| (slope - self.claimed).max_abs());
        Ok(errors.into_iter().fold(f64::INFINITY, f64::min))
    }
}

const COLUMNS: [&str; 6] = [
    "the xx column differs from the difference quotient, Pa",
    "the yy column differs from the difference quotient, Pa",
    "the zz column differs from the difference quotient, Pa",
    "the yz column differs from the difference quotient, Pa",
    "the xz column differs from the difference quotient, Pa",
    "the xy column differs from the difference quotient, Pa",
];
