//! The deformation at which the stress-controlled components of a material point have their targets.
//!
//! Newton's method with backtracking. Each unknown `x` moves the deformation gradient along a fixed
//! tensor, `δF = D δx`: a component of the symmetric stretch under a given rotation, `D = R e`, or
//! an entry of `F` itself. With `l = D F⁻¹ δx` the Cauchy stress of an objective law changes by
//! `δσ = c : sym(l) + l σ + σ lᵀ − tr(l) σ` with the spatial tangent `c`. For a small-strain law
//! this is right to first order in the strain, which costs iterations, not accuracy.

use fissure_tensor::{Matrix3, Matrix6, Sym, Tangent, Vector6};

use crate::{Increment, Material, MaterialError, Response};

const ITERATIONS: usize = 60;
const HALVINGS: usize = 30;

/// What the numbers that a step seeks are; slot `i` of them belongs to the stress component `i`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Unknowns {
    /// Components of `U − 1`, with `F = R U`.
    Stretch {
        /// `R`; the stresses are those of the frame that it turns.
        rotation: Matrix3<f64>,
    },
    /// Entries of `F`, in the fixed axes.
    Entries {
        /// `F` but for the unknown entries.
        known: Matrix3<f64>,
        /// Row and column of the unknown entry of each slot that has one.
        place: [Option<(usize, usize)>; 6],
    },
}

impl Unknowns {
    /// Rotation of the frame whose stresses are asked for.
    fn frame(&self) -> Matrix3<f64> {
        match self {
            Self::Stretch { rotation } => *rotation,
            Self::Entries { .. } => Matrix3::identity(),
        }
    }

    /// The deformation gradient of some numbers.
    fn gradient(&self, x: &[f64; 6]) -> Matrix3<f64> {
        match self {
            Self::Stretch { rotation } => rotation * (Matrix3::identity() + tensor(x).to_matrix()),
            Self::Entries { known, place } => {
                let mut f = *known;
                for (place, x) in place.iter().zip(x) {
                    if let Some(place) = place {
                        f[*place] = *x;
                    }
                }
                f
            }
        }
    }

    /// How the deformation gradient moves with one number.
    fn direction(&self, slot: usize) -> Matrix3<f64> {
        let mut unit = [0.0; 6];
        unit[slot] = 1.0;
        match self {
            Self::Stretch { rotation } => rotation * tensor(&unit).to_matrix(),
            Self::Entries { place, .. } => {
                let mut direction = Matrix3::zeros();
                if let Some(place) = place[slot] {
                    direction[place] = 1.0;
                }
                direction
            }
        }
    }
}

/// A step whose end is partly unknown.
pub(crate) struct Problem<'a, M: Material> {
    pub law: &'a M,
    pub old: &'a M::State,
    /// Everything but the end of the step.
    pub increment: Increment,
    pub unknowns: Unknowns,
    /// Stress that a component shall have, Pa; `None` where its number is given.
    pub stress: [Option<f64>; 6],
    /// Stiffness that says what counts as round-off, Pa.
    pub modulus: f64,
}

/// Some numbers and the law's answer to them.
pub(crate) struct Trial<S> {
    pub x: [f64; 6],
    pub increment: Increment,
    pub response: Response<S>,
    /// Cauchy stress in the frame of the unknowns, Pa.
    pub stress: Sym,
}

/// Why no end was found.
pub(crate) enum Failure {
    Law(MaterialError),
    /// Largest unbalanced stress, Pa.
    Unbalanced(f64),
}

impl<M: Material> Problem<'_, M> {
    /// Finds the numbers, starting from `guess`, whose slots without a stress are kept.
    pub fn solve(&self, guess: [f64; 6]) -> Result<Trial<M::State>, Failure> {
        let mut trial = self.evaluate(guess).map_err(Failure::Law)?;
        if self.stress.iter().all(Option::is_none) {
            return Ok(trial);
        }
        for _ in 0..ITERATIONS {
            let residual = self.residual(&trial);
            let tangent = self
                .law
                .tangent(&trial.increment, self.old)
                .map_err(Failure::Law)?;
            let stiffness = self.modulus + tangent.max_abs() + trial.stress.max_abs();
            let round_off = 16.0 * f64::EPSILON * stiffness;
            if residual.amax() <= round_off {
                return Ok(trial);
            }
            let better = self
                .jacobian(&trial, &tangent)
                .lu()
                .solve(&-residual)
                .and_then(|step| self.backtrack(&trial, &step, residual.norm()));
            match better {
                Some(next) => trial = next,
                // Round-off of the law itself, which may be above the plain bound.
                None if residual.amax() <= 100.0 * round_off => return Ok(trial),
                None => return Err(Failure::Unbalanced(residual.amax())),
            }
        }
        Err(Failure::Unbalanced(self.residual(&trial).amax()))
    }

    fn evaluate(&self, x: [f64; 6]) -> Result<Trial<M::State>, MaterialError> {
        let increment = self.increment.with_end(self.unknowns.gradient(&x));
        let response = self.law.update(&increment, self.old)?;
        let stress = response
            .stress
            .congruence(&self.unknowns.frame().transpose());
        Ok(Trial {
            x,
            increment,
            response,
            stress,
        })
    }

    /// Unbalanced stress, tensor components; zero where the number is given.
    fn residual(&self, trial: &Trial<M::State>) -> Vector6<f64> {
        let stress = components(&trial.stress);
        Vector6::from_fn(|i, _| self.stress[i].map_or(0.0, |target| stress[i] - target))
    }

    /// Derivative of the residual with the numbers; identity where they are given.
    fn jacobian(&self, trial: &Trial<M::State>, tangent: &Tangent) -> Matrix6<f64> {
        let inverse = trial.increment.f_new.try_inverse().unwrap_or_default();
        let sigma = trial.response.stress.to_matrix();
        let back = self.unknowns.frame().transpose();
        let mut jacobian = Matrix6::identity();
        for column in 0..6 {
            if self.stress[column].is_none() {
                continue;
            }
            let gradient = self.unknowns.direction(column) * inverse;
            let rate = tangent.apply(&Sym::from_matrix(&gradient))
                + Sym::from_matrix(&(gradient * sigma)) * 2.0
                - trial.response.stress * gradient.trace();
            let rate = components(&rate.congruence(&back));
            for row in 0..6 {
                if self.stress[row].is_some() {
                    jacobian[(row, column)] = rate[row];
                }
            }
        }
        jacobian
    }

    /// The longest of the halved steps that lowers the residual, if one does.
    fn backtrack(
        &self,
        trial: &Trial<M::State>,
        step: &Vector6<f64>,
        norm: f64,
    ) -> Option<Trial<M::State>> {
        let mut length = 1.0;
        for _ in 0..HALVINGS {
            let mut x = trial.x;
            for (x, step) in x.iter_mut().zip(step.iter()) {
                *x += step * length;
            }
            // An end that the law refuses is too far.
            if let Ok(next) = self.evaluate(x)
                && self.residual(&next).norm() <= (1.0 - 1e-4 * length) * norm
            {
                return Some(next);
            }
            length *= 0.5;
        }
        None
    }
}

/// Tensor components xx, yy, zz, yz, xz, xy.
pub(crate) fn components(tensor: &Sym) -> [f64; 6] {
    [
        tensor.xx(),
        tensor.yy(),
        tensor.zz(),
        tensor.yz(),
        tensor.xz(),
        tensor.xy(),
    ]
}

/// The tensor with these components.
pub(crate) fn tensor(components: &[f64; 6]) -> Sym {
    let [xx, yy, zz, yz, xz, xy] = *components;
    Sym::new(xx, yy, zz, yz, xz, xy)
}
