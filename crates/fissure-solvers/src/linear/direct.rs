//! Direct solution of sparse systems: `L Lᵀ`, `L D Lᵀ` or `L U`.
//!
//! The matrix is scaled symmetrically to a diagonal of ±1, to which a damping may be added. What
//! depends on the pattern alone, the order of elimination and the places of the factor's entries,
//! is found once. Every solution is checked against the matrix and, where that helps, refined
//! with its residual.
//!
//! One thread, whatever the pool: a parallel factorisation would change the last bits.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, LltRef, SymbolicCholesky, SymbolicCholeskyRaw,
    SymmetricOrdering, factorize_symbolic_cholesky, supernodal::SupernodalLdltRef,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

use super::blocks::{BlockMatrix, BlockPattern};
use super::dissection::nested_dissection;
use super::krylov::norm;
use super::unsymmetric::Unsymmetric;
use super::{Factor, LinearError};

/// A scaled matrix whose mirrored entries differ by less than this is taken for symmetric; refinement
/// mends what is neglected.
const SYMMETRIC: f64 = 1e-9;
/// A relative residual below this is a solution.
const SOLVED: f64 = 1e-6;
/// Refinement stops below this relative residual.
const REFINED: f64 = 1e-8;
/// Most steps of refinement.
const REFINEMENTS: usize = 4;

/// What a solution is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solved {
    /// `|A x − b| / |b|` of the scaled system, damping included.
    pub residual: f64,
    /// Steps of refinement taken.
    pub refinements: usize,
}

/// A direct solver for matrices of one pattern.
pub struct Direct<const D: usize> {
    pattern: BlockPattern,
    /// Order of elimination of the unknowns, and its inverse.
    order: Vec<u32>,
    inverse: Vec<u32>,
    /// The lower triangle by columns.
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
    symbolic: SymbolicCholesky<u32>,
    factor_values: Vec<f64>,
    memory: MemBuffer,
    unsymmetric: Option<Unsymmetric<D>>,
    scale: Vec<f64>,
    damping: f64,
    factor: Option<Factor>,
    negative_pivots: usize,
}

impl<const D: usize> std::fmt::Debug for Direct<D> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Direct")
            .field("size", &self.order.len())
            .field("factor", &self.factor)
            .field("entries", &self.factor_values.len())
            .finish_non_exhaustive()
    }
}

impl<const D: usize> Direct<D> {
    /// Finds the order of elimination of a pattern from where its nodes are, and the places of
    /// the factor's entries.
    ///
    /// # Errors
    /// [`LinearError::Memory`].
    pub fn new(pattern: &BlockPattern, positions: &[[f64; D]]) -> Result<Self, LinearError> {
        let nodes = nested_dissection(pattern, positions);
        let components = |&node: &u32| (0..D as u32).map(move |axis| D as u32 * node + axis);
        let order: Vec<u32> = nodes.iter().flat_map(components).collect();
        let mut inverse = vec![0; order.len()];
        for (place, &unknown) in order.iter().enumerate() {
            inverse[unknown as usize] = place as u32;
        }
        let (starts, rows) = lower_triangle::<D>(pattern);
        let size = order.len();
        let lower = SymbolicSparseColMatRef::new_checked(size, size, &starts, None, &rows);
        let symbolic = factorize_symbolic_cholesky(
            lower,
            Side::Lower,
            SymmetricOrdering::Custom(PermRef::new_checked(&order, &inverse, size)),
            CholeskySymbolicParams {
                supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
                ..Default::default()
            },
        )
        .map_err(|_| LinearError::Memory)?;
        let request = StackReq::any_of(&[
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        ]);
        Ok(Self {
            pattern: pattern.clone(),
            values: vec![0.0; rows.len()],
            order,
            inverse,
            starts,
            rows,
            factor_values: Vec::new(),
            memory: MemBuffer::try_new(request).map_err(|_| LinearError::Memory)?,
            symbolic,
            unsymmetric: None,
            scale: Vec::new(),
            damping: 0.0,
            factor: None,
            negative_pivots: 0,
        })
    }

    /// Whether it is for matrices of this pattern.
    pub fn fits(&self, pattern: &BlockPattern) -> bool {
        self.pattern == *pattern
    }

    /// Which factorisation is held.
    pub fn factor(&self) -> Option<Factor> {
        self.factor
    }

    /// Negative pivots of the last symmetric factorisation; 0 after an unsymmetric one.
    pub fn negative_pivots(&self) -> usize {
        self.negative_pivots
    }

    /// Numbers in the factor of a symmetric matrix.
    pub fn factor_entries(&self) -> usize {
        self.symbolic.len_val()
    }

    /// Factorises a matrix, scaled and with `damping` added to its scaled diagonal: by Cholesky
    /// where it is symmetric and positive, else by `L D Lᵀ` where symmetric, else by `L U`.
    ///
    /// # Errors
    /// [`LinearError::Pattern`] for a matrix of another pattern, [`LinearError::Singular`] for one
    /// that no factorisation was found of.
    pub fn factorise(&mut self, matrix: &BlockMatrix<D>, damping: f64) -> Result<(), LinearError> {
        if !self.fits(matrix.pattern()) {
            return Err(LinearError::Pattern);
        }
        self.factor = None;
        self.negative_pivots = 0;
        self.damping = damping;
        self.scale = matrix.unit_scale();
        let asymmetry = matrix.asymmetry(&self.scale);
        if !asymmetry.is_finite() {
            return Err(LinearError::NotFinite);
        }
        if asymmetry > SYMMETRIC {
            return self.factorise_unsymmetric(matrix);
        }
        self.fill(matrix);
        self.factor_values.resize(self.symbolic.len_val(), 0.0);
        if self.cholesky() {
            self.factor = Some(Factor::Cholesky);
            return Ok(());
        }
        if self.signed_cholesky() {
            self.factor = Some(Factor::SignedCholesky);
            return Ok(());
        }
        self.factorise_unsymmetric(matrix)
    }

    fn factorise_unsymmetric(&mut self, matrix: &BlockMatrix<D>) -> Result<(), LinearError> {
        let columns = PermRef::new_checked(&self.order, &self.inverse, self.order.len());
        let unsymmetric = match &mut self.unsymmetric {
            Some(unsymmetric) => unsymmetric,
            none => none.insert(Unsymmetric::new(&self.pattern, columns)?),
        };
        unsymmetric.factorise(matrix, &self.scale, self.damping, columns)?;
        self.factor = Some(Factor::Lu);
        Ok(())
    }

    /// The lower triangle of the scaled and damped matrix.
    fn fill(&mut self, matrix: &BlockMatrix<D>) {
        let mut next = 0;
        for node in 0..self.pattern.nodes() {
            for axis in 0..D {
                let column = D * node + axis;
                for k in self.pattern.row(node) {
                    let other = self.pattern.column(k);
                    if other < node {
                        continue;
                    }
                    // Row `other` of this column is the mirror of the row's entry.
                    let block = &matrix.blocks[self.pattern.mirror(k)];
                    let first = if other == node { axis } else { 0 };
                    for a in first..D {
                        let row = D * other + a;
                        let mut value = block[(a, axis)] * self.scale[row] * self.scale[column];
                        if row == column {
                            value += self.damping;
                        }
                        self.values[next] = value;
                        next += 1;
                    }
                }
            }
        }
    }

    /// `L Lᵀ`; false where a pivot is not positive.
    fn cholesky(&mut self) -> bool {
        let size = self.order.len();
        let lower =
            SymbolicSparseColMatRef::new_checked(size, size, &self.starts, None, &self.rows);
        let done = self.symbolic.factorize_numeric_llt(
            &mut self.factor_values,
            SparseColMatRef::new(lower, &self.values),
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        done.is_ok()
    }

    /// `L D Lᵀ` without pivoting; false where a pivot is zero.
    fn signed_cholesky(&mut self) -> bool {
        let size = self.order.len();
        let lower =
            SymbolicSparseColMatRef::new_checked(size, size, &self.starts, None, &self.rows);
        let done = self.symbolic.factorize_numeric_ldlt(
            &mut self.factor_values,
            SparseColMatRef::new(lower, &self.values),
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        if done.is_err() {
            return false;
        }
        if let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() {
            let factor = SupernodalLdltRef::new(symbolic, &self.factor_values);
            for supernode in 0..symbolic.n_supernodes() {
                let block = factor.supernode(supernode).val();
                let negative = (0..block.ncols()).filter(|&k| block[(k, k)] < 0.0);
                self.negative_pivots += negative.count();
            }
        }
        true
    }

    /// Solves in place of the right side with the held factorisation of `matrix`.
    ///
    /// # Errors
    /// [`LinearError::Singular`] if there is no factorisation or the residual of the solution, refined
    /// as far as may be, is over 1e-6 of the right side (NaN included).
    pub fn solve(
        &mut self,
        matrix: &BlockMatrix<D>,
        right: &mut [f64],
    ) -> Result<Solved, LinearError> {
        if self.factor.is_none() {
            return Err(LinearError::Singular);
        }
        let scaled = |v: &[f64], scale: &[f64]| -> Vec<f64> {
            v.iter().zip(scale).map(|(v, s)| v * s).collect()
        };
        let wanted = scaled(right, &self.scale);
        let size = norm(&wanted);
        if size == 0.0 {
            right.fill(0.0);
            return Ok(Solved {
                residual: 0.0,
                refinements: 0,
            });
        }
        let mut x = wanted.clone();
        self.back_substitute(&mut x)?;
        let mut product = vec![0.0; x.len()];
        let (mut best, mut last) = (x.clone(), f64::INFINITY);
        let mut refinements = 0;
        loop {
            // Residual of the scaled and damped system.
            matrix.multiply(&scaled(&x, &self.scale), &mut product);
            let rest: Vec<f64> = (0..x.len())
                .map(|i| wanted[i] - product[i] * self.scale[i] - self.damping * x[i])
                .collect();
            let residual = norm(&rest) / size;
            if !(residual < last) {
                break;
            }
            best.clone_from(&x);
            last = residual;
            if residual <= REFINED || refinements == REFINEMENTS {
                break;
            }
            let mut correction = rest;
            self.back_substitute(&mut correction)?;
            x.iter_mut().zip(&correction).for_each(|(x, c)| *x += c);
            refinements += 1;
        }
        if !(last <= SOLVED) {
            return Err(LinearError::Singular);
        }
        for ((r, x), s) in right.iter_mut().zip(&best).zip(&self.scale) {
            *r = x * s;
        }
        Ok(Solved {
            residual: last,
            refinements,
        })
    }

    fn back_substitute(&mut self, x: &mut [f64]) -> Result<(), LinearError> {
        let rows = x.len();
        let column = MatMut::from_column_major_slice_mut(x, rows, 1);
        let stack = MemStack::new(&mut self.memory);
        match (self.factor, &mut self.unsymmetric) {
            (Some(Factor::Cholesky), _) => LltRef::new(&self.symbolic, &self.factor_values)
                .solve_in_place_with_conj(Conj::No, column, Par::Seq, stack),
            (Some(Factor::SignedCholesky), _) => LdltRef::new(&self.symbolic, &self.factor_values)
                .solve_in_place_with_conj(Conj::No, column, Par::Seq, stack),
            (Some(Factor::Lu), Some(lu)) => {
                lu.back_substitute(
                    PermRef::new_checked(&self.order, &self.inverse, rows),
                    column,
                );
            }
            _ => return Err(LinearError::Singular),
        }
        Ok(())
    }
}

/// Columns of the lower triangle: where each begins, and the rows of its entries.
fn lower_triangle<const D: usize>(pattern: &BlockPattern) -> (Vec<u32>, Vec<u32>) {
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for node in 0..pattern.nodes() {
        for axis in 0..D {
            for &other in pattern.neighbours(node) {
                let other = other as usize;
                let first = match other.cmp(&node) {
                    std::cmp::Ordering::Less => continue,
                    std::cmp::Ordering::Equal => axis,
                    std::cmp::Ordering::Greater => 0,
                };
                rows.extend((first..D).map(|a| (D * other + a) as u32));
            }
            starts.push(rows.len() as u32);
        }
    }
    (starts, rows)
}
