//! The stretch that leaves no out-of-plane stress.
//!
//! The unknown is `x = ln F₃₃`; the derivative of the residual is `dσ₃₃/dx = c₃₃₃₃ + σ₃₃` with the
//! spatial tangent `c` (Truesdell rate). Newton's method starts from where the tangent at the
//! start of the step points, and stays inside the bracket that the signs of `σ₃₃` have shown.

use fissure_tensor::{Matrix3, Sym};

use super::{NAME, PlaneStress, PlaneStressState};
use crate::{Increment, Material, MaterialError, Response, Scale};

/// Newton steps and bisections before giving up; bisection alone needs about 60.
const ITERATIONS: i32 = 100;

/// A step of the law inside, at the stretch that leaves no out-of-plane stress.
pub(super) struct Solved<S> {
    pub increment: Increment,
    pub response: Response<S>,
    pub thickening: f64,
}

impl<M: Material> PlaneStress<M> {
    /// P-wave modulus of the undeformed law, Pa: sets what counts as round-off. Without its last digits:
    /// the root in a wave speed rounds by the unit, and the answer is not to.
    pub(super) fn modulus(&self, scale: &Scale) -> f64 {
        let speed = self
            .0
            .wave_speed(&Matrix3::identity(), &self.0.initial(), scale);
        let modulus = self.0.density() * speed * speed;
        f64::from_bits(modulus.to_bits() & !0xffff)
    }

    /// The law's answer at the stretch that leaves no out-of-plane stress.
    pub(super) fn solve(
        &self,
        increment: &Increment,
        old: &PlaneStressState<M::State>,
    ) -> Result<Solved<M::State>, MaterialError> {
        let modulus = self.modulus(&increment.external.scale);
        let mut trial = Increment {
            f_old: with_thickness(&increment.f_old, old.thickening),
            ..*increment
        };
        let (mut low, mut high) = (-1.0, f64::INFINITY);
        let mut thickening = self.predicted(increment, &trial, old)?;
        let mut residual = f64::NAN;
        for iteration in 0..ITERATIONS {
            trial.f_new = with_thickness(&increment.f_new, thickening);
            let response = self.0.update(&trial, &old.inner)?;
            residual = response.stress.zz();
            let round_off = 4.0 * f64::EPSILON * (modulus + response.stress.max_abs());
            // Accepting the old stretch at round-off keeps a zero increment from moving anything.
            if residual.abs() <= round_off {
                return Ok(Solved {
                    increment: trial,
                    response,
                    thickening,
                });
            }
            if !residual.is_finite() {
                return Err(MaterialError::NotFinite { law: NAME });
            }
            if residual > 0.0 {
                high = thickening;
            } else {
                low = thickening;
            }
            let slope = self.0.tangent(&trial, &old.inner)?.0[(2, 2)] + residual;
            // Softening makes the slope nearly vanish or negative; a full step would then leap over
            // the balance to where the thickness cracks. The first steps are short, each later one
            // may be twice as long.
            let slope = slope.max(modulus * 0.5_f64.powi(iteration + 1));
            let next = next_thickening(thickening, residual, slope, low, high);
            // No closer number: one ulp of F₃₃ is more than the bound. A jump of the stress across
            // the bracket is not a solution.
            let exhausted = next == thickening || residual.abs() <= 4.0 * f64::EPSILON * slope;
            if exhausted && residual.abs() <= 1e6 * round_off {
                return Ok(Solved {
                    increment: trial,
                    response,
                    thickening,
                });
            }
            if next == thickening {
                break;
            }
            thickening = next;
        }
        Err(MaterialError::NoConvergence {
            law: NAME,
            iterations: ITERATIONS as usize,
            residual: residual.abs() / modulus,
        })
    }

    /// Where the tangent at the start of the step says the stretch goes; the old one to the last
    /// bit if the plane does not move.
    ///
    /// Without it a large reversal would be tried at a stretch that stands far out of plane, where
    /// a law may crack across the thickness and find a balance that no path leads to.
    fn predicted(
        &self,
        increment: &Increment,
        start: &Increment,
        old: &PlaneStressState<M::State>,
    ) -> Result<f64, MaterialError> {
        let f_old = start.f_old;
        let change = with_thickness(&increment.f_new, old.thickening) - f_old;
        let inverse = match f_old.try_inverse() {
            Some(inverse) if change != Matrix3::zeros() => inverse,
            _ => return Ok(old.thickening),
        };
        let rest = Increment {
            f_new: f_old,
            ..*start
        };
        let c = self.0.tangent(&rest, &old.inner)?;
        // Relative Green strain, l + lᵀ + lᵀl over two: blind to a rotation in the step.
        let l = change * inverse;
        let strain = Sym::from_matrix(&l) + Sym::from_matrix(&(l.transpose() * l)) * 0.5;
        let modulus = self.modulus(&increment.external.scale);
        let rate = c.apply(&strain).zz();
        let slope = c.0[(2, 2)].max(0.5 * modulus);
        Ok(next_thickening(
            old.thickening,
            rate,
            slope,
            -1.0,
            f64::INFINITY,
        ))
    }
}

/// The in-plane part of a deformation gradient, and `F₃₃ = 1 + thickening`.
pub(crate) fn with_thickness(f: &Matrix3<f64>, thickening: f64) -> Matrix3<f64> {
    Matrix3::new(
        f.m11,
        f.m12,
        0.0,
        f.m21,
        f.m22,
        0.0,
        0.0,
        0.0,
        1.0 + thickening,
    )
}

/// Newton's step in `ln F₃₃`, at most half a unit long, or the middle of the bracket.
fn next_thickening(thickening: f64, residual: f64, slope: f64, low: f64, high: f64) -> f64 {
    let step = (-residual / slope).clamp(-0.5, 0.5);
    let newton = thickening + (1.0 + thickening) * step.exp_m1();
    if newton > low && newton < high {
        newton
    } else {
        0.5 * (low + high)
    }
}
