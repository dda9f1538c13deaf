//! Linear systems: sparse matrices of blocks, direct and iterative solvers, preconditioners.
//!
//! A tangent couples nodes, and a node has a component per dimension, so everything here works on
//! `D×D` blocks. [`Direct`] factorises a [`BlockMatrix`]; [`conjugate_gradients`] and [`gmres`] need
//! only an [`Operator`], which may be a matrix or a function, and take a [`Preconditioner`].
//!
//! Every sum has one order: results do not depend on the number of threads.

mod blocks;
mod direct;
mod dissection;
mod elimination;
mod krylov;
mod preconditioner;
mod unsymmetric;

pub use blocks::{BlockMatrix, BlockPattern};
pub use direct::{Direct, Solved};
pub use dissection::nested_dissection;
pub use elimination::Elimination;
pub use krylov::{KrylovSettings, Operator, Outcome, Stop, conjugate_gradients, gmres};
pub use preconditioner::{Diagonal, Identity, Incomplete, NodeBlocks, Preconditioner};

pub(crate) use krylov::norm;

/// How a matrix was factorised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    /// `L Lᵀ`: symmetric and positive definite.
    Cholesky,
    /// `L D Lᵀ` with pivots of either sign: symmetric.
    SignedCholesky,
    /// `L U` with partial pivoting.
    Lu,
}

/// Why a linear system was not solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinearError {
    /// No solution within the tolerance.
    #[error("the matrix is singular, or too near to it")]
    Singular,
    /// An entry is NaN or infinite.
    #[error("the matrix has an entry that is not finite")]
    NotFinite,
    /// A matrix of another pattern than the solver was made for.
    #[error("the matrix has another pattern than the solver was made for")]
    Pattern,
    /// Memory or the range of indices does not suffice.
    #[error("not enough memory, or more entries than indices can count")]
    Memory,
}

#[cfg(test)]
mod tests;
