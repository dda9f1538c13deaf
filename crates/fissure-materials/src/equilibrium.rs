//! The strain at which the stress-controlled components of a material point have their targets.
//!
//! Newton's method with backtracking. The unknowns are components of the symmetric stretch
//! `U = 1 + ε` under a given rotation `R`; a change `δε` is `F → (1 + l) F` with
//! `l = R δε U⁻¹ Rᵀ`, and for an objective law the Cauchy stress changes by
//! `δσ = c : sym(l) + l σ + σ lᵀ − tr(l) σ` with the spatial tangent `c`. For a small-strain law
//! this is right to first order in the strain, which costs iterations, not accuracy.

use fissure_tensor::{Matrix3, Matrix6, Sym, Tangent, Vector6};

use crate::{Increment, Material, MaterialError, Response};

const ITERATIONS: usize = 60;
const HALVINGS: usize = 30;

/// A step whose strain is partly unknown.
pub(crate) struct Problem<'a, M: Material> {
    pub law: &'a M,
    pub old: &'a M::State,
    /// Everything but the end of the step.
    pub increment: Increment,
    /// Rotation at the end.
    pub rotation: Matrix3<f64>,
    /// Stress that a component shall have in the turning frame, Pa; `None` where its strain is given.
    pub stress: [Option<f64>; 6],
    /// Stiffness that says what counts as round-off, Pa.
    pub modulus: f64,
}

/// A strain and the law's answer to it.
pub(crate) struct Trial<S> {
    pub strain: Sym,
    pub increment: Increment,
    pub response: Response<S>,
    /// Cauchy stress in the turning frame, Pa.
    pub stress: Sym,
}

/// Why no strain was found.
pub(crate) enum Failure {
    Law(MaterialError),
    /// Largest unbalanced stress, Pa.
    Unbalanced(f64),
}

impl<M: Material> Problem<'_, M> {
    /// Finds the strain, starting from `guess`, whose strain-controlled components are kept.
    pub fn solve(&self, guess: Sym) -> Result<Trial<M::State>, Failure> {
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

    fn evaluate(&self, strain: Sym) -> Result<Trial<M::State>, MaterialError> {
        let stretch = Matrix3::identity() + strain.to_matrix();
        let increment = self.increment.with_end(self.rotation * stretch);
        let response = self.law.update(&increment, self.old)?;
        let stress = response.stress.congruence(&self.rotation.transpose());
        Ok(Trial {
            strain,
            increment,
            response,
            stress,
        })
    }

    /// Unbalanced stress, tensor components; zero where the strain is given.
    fn residual(&self, trial: &Trial<M::State>) -> Vector6<f64> {
        let stress = components(&trial.stress);
        Vector6::from_fn(|i, _| self.stress[i].map_or(0.0, |target| stress[i] - target))
    }

    /// Derivative of the residual with the tensor components of the strain; identity where the
    /// strain is given.
    fn jacobian(&self, trial: &Trial<M::State>, tangent: &Tangent) -> Matrix6<f64> {
        let inverse = trial.increment.f_new.try_inverse().unwrap_or_default();
        let sigma = trial.response.stress.to_matrix();
        let back = self.rotation.transpose();
        let mut jacobian = Matrix6::identity();
        for column in 0..6 {
            if self.stress[column].is_none() {
                continue;
            }
            let mut unit = [0.0; 6];
            unit[column] = 1.0;
            let gradient = self.rotation * tensor(&unit).to_matrix() * inverse;
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
        let step = tensor(&(*step).into());
        let mut length = 1.0;
        for _ in 0..HALVINGS {
            // A strain that the law refuses is too far.
            if let Ok(next) = self.evaluate(trial.strain + step * length)
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
