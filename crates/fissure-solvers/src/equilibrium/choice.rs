//! How the linear systems of a step are solved.

use fissure_scene::SolveError;

/// How the linear system of a Newton iteration is solved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LinearSolver {
    /// The assembled tangent is factorised.
    #[default]
    Direct,
    /// Krylov iterations, as accurate as Newton's method can use ([Eisenstat and Walker 1996],
    /// choice 2).
    Iterative(Iterative),
}

/// A Krylov method and what it is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iterative {
    /// Which method.
    pub method: Method,
    /// What multiplies vectors.
    pub product: Product,
    /// What stands for the inverse.
    pub preconditioner: Preconditioning,
    /// Directions GMRES keeps; ≥ 1.
    pub restart: usize,
    /// Products at most in a Newton iteration; ≥ 1.
    pub max_iterations: usize,
}

impl Default for Iterative {
    fn default() -> Self {
        Self {
            method: Method::Gmres,
            product: Product::Tangent,
            preconditioner: Preconditioning::NodeBlocks,
            restart: 60,
            max_iterations: 2000,
        }
    }
}

/// A Krylov method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Conjugate gradients: for symmetric positive tangents.
    ConjugateGradients,
    /// GMRES with restarts: for any.
    Gmres,
}

/// What multiplies a vector by the tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Product {
    /// A difference of residuals along the vector [Sanchez 2010, eq. A.1.5], over the step of Brown and
    /// Saad (1990) with the spacing as typical displacement. The law's tangent is not called.
    Differences,
    /// The law's tangent, particle by particle, without a matrix.
    Tangent,
    /// The assembled matrix.
    Assembled,
}

/// What stands for the inverse of the tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preconditioning {
    /// Nothing.
    None,
    /// The nodal masses.
    Mass,
    /// The diagonal blocks of the tangent, a block per node (block-Jacobi); needs the law's tangent.
    NodeBlocks,
    /// An incomplete factorisation on the tangent's own pattern, IC(0) for conjugate gradients and
    /// ILU(0) for GMRES; needs the assembled matrix.
    Incomplete,
}

impl LinearSolver {
    /// Refuses settings outside their range and pairs that do not go together.
    pub(crate) fn check(&self) -> Result<(), SolveError> {
        let Self::Iterative(iterative) = self else {
            return Ok(());
        };
        let refuse = |setting, permitted| {
            Err(SolveError::Setting {
                setting,
                value: 0.0,
                permitted,
            })
        };
        if iterative.restart == 0 {
            return refuse("restart", ">= 1");
        }
        if iterative.max_iterations == 0 {
            return refuse("max_iterations of the linear solver", ">= 1");
        }
        match (iterative.product, iterative.preconditioner) {
            (Product::Differences, Preconditioning::NodeBlocks) => {
                refuse("preconditioner", "None or Mass with differences")
            }
            (Product::Differences | Product::Tangent, Preconditioning::Incomplete) => refuse(
                "preconditioner",
                "Incomplete with the assembled product only",
            ),
            _ => Ok(()),
        }
    }
}
