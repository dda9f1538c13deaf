//! Preconditioners: approximate inverses that an iteration is given.

use nalgebra::{SMatrix, SVector};

use super::LinearError;
use super::blocks::{BlockMatrix, BlockPattern};

/// Solves a system that is near the one in hand.
pub trait Preconditioner {
    /// `z = M⁻¹ r`.
    fn apply(&self, r: &[f64], z: &mut [f64]);
}

/// None: `M = 1`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Identity;

impl Preconditioner for Identity {
    fn apply(&self, r: &[f64], z: &mut [f64]) {
        z.copy_from_slice(r);
    }
}

/// A diagonal: the nodal masses, or that of the matrix.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagonal {
    inverse: Vec<f64>,
}

impl Diagonal {
    /// From the diagonal; an entry that is zero stands for 1.
    pub fn new(diagonal: impl Iterator<Item = f64>) -> Self {
        let inverse = diagonal.map(|d| if d == 0.0 { 1.0 } else { d.recip() });
        Self {
            inverse: inverse.collect(),
        }
    }
}

impl Preconditioner for Diagonal {
    fn apply(&self, r: &[f64], z: &mut [f64]) {
        for ((z, r), inverse) in z.iter_mut().zip(r).zip(&self.inverse) {
            *z = r * inverse;
        }
    }
}

/// The diagonal blocks (block-Jacobi), a block per node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeBlocks<const D: usize> {
    inverse: Vec<SMatrix<f64, D, D>>,
}

impl<const D: usize> NodeBlocks<D> {
    /// From the diagonal blocks of a matrix.
    ///
    /// # Errors
    /// [`LinearError::Singular`] for a block without an inverse.
    pub fn new(matrix: &BlockMatrix<D>) -> Result<Self, LinearError> {
        let nodes = 0..matrix.pattern().nodes();
        let block = |node| matrix.blocks[matrix.pattern().diagonal(node)];
        Self::of(nodes.map(block))
    }

    /// From the blocks themselves.
    ///
    /// # Errors
    /// [`LinearError::Singular`] for a block without an inverse.
    pub fn of(blocks: impl Iterator<Item = SMatrix<f64, D, D>>) -> Result<Self, LinearError> {
        let inverse = blocks.map(|block| inverse_of(&block).ok_or(LinearError::Singular));
        Ok(Self {
            inverse: inverse.collect::<Result<_, _>>()?,
        })
    }
}

impl<const D: usize> Preconditioner for NodeBlocks<D> {
    fn apply(&self, r: &[f64], z: &mut [f64]) {
        let pairs = z.chunks_exact_mut(D).zip(r.chunks_exact(D));
        for ((z, r), inverse) in pairs.zip(&self.inverse) {
            let solved = inverse * SVector::<f64, D>::from_column_slice(r);
            z.copy_from_slice(solved.as_slice());
        }
    }
}

/// An incomplete factorisation `L U` without entries beyond the pattern, by blocks.
///
/// Of a symmetric matrix it is the incomplete Cholesky factorisation `L D Lᵀ`: IC(0) else ILU(0).
#[derive(Clone, Debug, Default)]
pub struct Incomplete<const D: usize> {
    pattern: BlockPattern,
    /// `L` below the diagonal (its own is the unit matrix), `U` above it, and the inverse of its
    /// diagonal.
    blocks: Vec<SMatrix<f64, D, D>>,
    shift: f64,
}

/// First share of the diagonal that is added where a pivot is not positive; doubled until all are.
const FIRST_SHIFT: f64 = 1e-3;
/// Largest share.
const LAST_SHIFT: f64 = 1.1;

impl<const D: usize> Incomplete<D> {
    /// IC(0) of a symmetric matrix, for conjugate gradients. Where a pivot is not positive, the
    /// diagonal is raised by as small a share as will do (Manteuffel 1980).
    ///
    /// # Errors
    /// [`LinearError::Singular`] if a diagonal twice as large does not help.
    pub fn cholesky(matrix: &BlockMatrix<D>) -> Result<Self, LinearError> {
        Self::shifted(matrix, |pivot| pivot.cholesky().is_some())
    }

    /// ILU(0), for GMRES; the diagonal is raised where a pivot has no inverse.
    ///
    /// # Errors
    /// [`LinearError::Singular`] if a diagonal twice as large does not help.
    pub fn lu(matrix: &BlockMatrix<D>) -> Result<Self, LinearError> {
        Self::shifted(matrix, |_| true)
    }

    /// Share of the diagonal that was added to it.
    pub fn shift(&self) -> f64 {
        self.shift
    }

    fn shifted(
        matrix: &BlockMatrix<D>,
        accepts: impl Fn(&SMatrix<f64, D, D>) -> bool,
    ) -> Result<Self, LinearError> {
        let mut shift = 0.0;
        while shift <= LAST_SHIFT {
            if let Some(blocks) = eliminate(matrix, shift, &accepts) {
                return Ok(Self {
                    pattern: matrix.pattern().clone(),
                    blocks,
                    shift,
                });
            }
            shift = if shift == 0.0 {
                FIRST_SHIFT
            } else {
                2.0 * shift
            };
        }
        Err(LinearError::Singular)
    }
}

/// `L U` on the pattern, row by row; `None` where a pivot is not accepted.
fn eliminate<const D: usize>(
    matrix: &BlockMatrix<D>,
    shift: f64,
    accepts: &impl Fn(&SMatrix<f64, D, D>) -> bool,
) -> Option<Vec<SMatrix<f64, D, D>>> {
    const ABSENT: u32 = u32::MAX;
    let pattern = matrix.pattern();
    let mut blocks = matrix.blocks.clone();
    let mut places = vec![ABSENT; pattern.nodes()];
    for node in 0..pattern.nodes() {
        let diagonal = pattern.diagonal(node);
        for axis in 0..D {
            blocks[diagonal][(axis, axis)] *= 1.0 + shift;
        }
        for k in pattern.row(node) {
            places[pattern.column(k)] = k as u32;
        }
        for k in pattern.row(node).start..diagonal {
            let other = pattern.column(k);
            // The diagonal of the other row is inverted already.
            let factor = blocks[k] * blocks[pattern.diagonal(other)];
            blocks[k] = factor;
            for j in pattern.diagonal(other) + 1..pattern.row(other).end {
                let place = places[pattern.column(j)];
                if place != ABSENT {
                    let change = factor * blocks[j];
                    blocks[place as usize] -= change;
                }
            }
        }
        if !accepts(&blocks[diagonal]) {
            return None;
        }
        blocks[diagonal] = inverse_of(&blocks[diagonal])?;
        for k in pattern.row(node) {
            places[pattern.column(k)] = ABSENT;
        }
    }
    Some(blocks)
}

impl<const D: usize> Preconditioner for Incomplete<D> {
    fn apply(&self, r: &[f64], z: &mut [f64]) {
        let pattern = &self.pattern;
        let of = |z: &[f64], node: usize| {
            SVector::<f64, D>::from_column_slice(&z[D * node..D * (node + 1)])
        };
        for node in 0..pattern.nodes() {
            let mut rest = of(r, node);
            for k in pattern.row(node).start..pattern.diagonal(node) {
                rest -= self.blocks[k] * of(z, pattern.column(k));
            }
            z[D * node..D * (node + 1)].copy_from_slice(rest.as_slice());
        }
        for node in (0..pattern.nodes()).rev() {
            let mut rest = of(z, node);
            for k in pattern.diagonal(node) + 1..pattern.row(node).end {
                rest -= self.blocks[k] * of(z, pattern.column(k));
            }
            let solved = self.blocks[pattern.diagonal(node)] * rest;
            z[D * node..D * (node + 1)].copy_from_slice(solved.as_slice());
        }
    }
}

/// The inverse of a small block, if it has a finite one.
fn inverse_of<const D: usize>(block: &SMatrix<f64, D, D>) -> Option<SMatrix<f64, D, D>> {
    let inverse = block.try_inverse()?;
    inverse.iter().all(|c| c.is_finite()).then_some(inverse)
}
