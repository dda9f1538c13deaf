//! Direct solution of sparse systems: `L Lᵀ`, `L D Lᵀ` or `L U`.
//!
//! The matrix is scaled symmetrically to a diagonal of ±1, to which a damping may be added. What
//! depends on the pattern alone, the order of elimination and the places of the factor's entries,
//! is found once. Every solution is checked against the matrix and, where that helps, refined
//! with its residual.
//!
//! `L U` with pivots sought across rows is slow (its columns fill as those of `Aᵀ A` would): a tangent
//! that is not symmetric is solved by GMRES with the factor of its symmetric part, and factorised itself
//! only where that does not converge.
//!
//! One thread, whatever the pool: a parallel factorisation would change the last bits.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::cholesky::{
    LdltRef, LltRef, SymbolicCholeskyRaw, supernodal::SupernodalLdltRef,
};
use faer::{Conj, MatMut, Par, Side};

use super::blocks::{BlockMatrix, BlockPattern};
use super::elimination::{Elimination, Plan};
use super::krylov::{KrylovSettings, Operator, gmres, norm};
use super::preconditioner::Preconditioner;
use super::unsymmetric::Unsymmetric;
use super::{Factor, LinearError};

/// A scaled matrix whose mirrored entries differ by less than this is taken for symmetric; refinement
/// mends what is neglected.
const SYMMETRIC: f64 = 1e-9;
/// A relative residual below this is a solution.
const SOLVED: f64 = 1e-6;
/// Refinement stops below this relative residual.
const REFINED: f64 = 1e-10;
/// Most steps of refinement.
const REFINEMENTS: usize = 4;
/// By how much a solution by the factor of the symmetric part has to lower the residual, or GMRES does it with fewer.
const PAYS: f64 = 1e-2;

/// Most products of GMRES with the factor of a symmetric part, before the matrix is factorised itself.
const MOST_PRODUCTS: usize = 60;

/// What a solution is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solved {
    /// `|A x − b| / |b|` of the scaled system, damping included.
    pub residual: f64,
    /// Steps of refinement taken, or products of GMRES.
    pub refinements: usize,
}

/// A direct solver for matrices of one pattern.
pub struct Direct<const D: usize> {
    pattern: BlockPattern,
    plan: Plan,
    /// Of the lower triangle.
    values: Vec<f64>,
    factor_values: Vec<f64>,
    memory: MemBuffer,
    unsymmetric: Option<Unsymmetric<D>>,
    scale: Vec<f64>,
    damping: f64,
    factor: Option<Factor>,
    symmetric: bool,
    negative_pivots: Option<usize>,
}

impl<const D: usize> std::fmt::Debug for Direct<D> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Direct")
            .field("size", &self.plan.order.len())
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
        Self::with_elimination(pattern, positions, Elimination::default())
    }

    /// The same in another order of elimination.
    ///
    /// # Errors
    /// [`LinearError::Memory`].
    pub fn with_elimination(
        pattern: &BlockPattern,
        positions: &[[f64; D]],
        elimination: Elimination,
    ) -> Result<Self, LinearError> {
        let plan = Plan::new(pattern, positions, elimination)?;
        let symbolic = &plan.symbolic;
        let request = StackReq::any_of(&[
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default()),
        ]);
        Ok(Self {
            pattern: pattern.clone(),
            values: vec![0.0; plan.rows.len()],
            factor_values: Vec::new(),
            memory: MemBuffer::try_new(request).map_err(|_| LinearError::Memory)?,
            plan,
            unsymmetric: None,
            scale: Vec::new(),
            damping: 0.0,
            factor: None,
            symmetric: true,
            negative_pivots: None,
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

    /// Negative pivots of the matrix last given to [`factorise`](Self::factorise), of its symmetric part if it is not
    /// symmetric; `None` where only `L U` was found.
    pub fn negative_pivots(&self) -> Option<usize> {
        self.negative_pivots
    }

    /// Numbers in the factor of a symmetric matrix.
    pub fn factor_entries(&self) -> usize {
        self.plan.symbolic.len_val()
    }

    /// Factorises a matrix, scaled and with `damping` added to its scaled diagonal: by `L Lᵀ` where it is
    /// positive, else by `L D Lᵀ`, else by `L U`. Of a matrix that is not symmetric this is the symmetric
    /// part, and [`solve`](Self::solve) iterates.
    ///
    /// # Errors
    /// [`LinearError::Pattern`] for a matrix of another pattern, [`LinearError::Singular`] for one
    /// that no factorisation was found of.
    pub fn factorise(&mut self, matrix: &BlockMatrix<D>, damping: f64) -> Result<(), LinearError> {
        if !self.fits(matrix.pattern()) {
            return Err(LinearError::Pattern);
        }
        self.factor = None;
        self.negative_pivots = None;
        self.damping = damping;
        self.scale = matrix.unit_scale();
        let asymmetry = matrix.asymmetry(&self.scale);
        if !asymmetry.is_finite() {
            return Err(LinearError::NotFinite);
        }
        self.fill(matrix);
        self.factor_values.resize(self.plan.symbolic.len_val(), 0.0);
        self.symmetric = asymmetry <= SYMMETRIC;
        if self.cholesky() {
            self.factor = Some(Factor::Cholesky);
            self.negative_pivots = Some(0);
        } else if self.signed_cholesky() {
            self.factor = Some(Factor::SignedCholesky);
            self.negative_pivots = self.negative_signs();
        } else {
            self.factorise_unsymmetric(matrix)?;
        }
        Ok(())
    }

    /// Whether the matrix is symmetric; of one that is not, the symmetric part is factorised unless
    /// [`factor`](Self::factor) says otherwise.
    pub fn is_symmetric(&self) -> bool {
        self.symmetric
    }

    fn factorise_unsymmetric(&mut self, matrix: &BlockMatrix<D>) -> Result<(), LinearError> {
        let columns = self.plan.permutation();
        let unsymmetric = match &mut self.unsymmetric {
            Some(unsymmetric) => unsymmetric,
            none => none.insert(Unsymmetric::new(&self.pattern, columns)?),
        };
        unsymmetric.factorise(matrix, &self.scale, self.damping, columns)?;
        self.factor = Some(Factor::Lu);
        Ok(())
    }

    /// The lower triangle of the symmetric part of the scaled and damped matrix.
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
                    let (upper, lower) =
                        (&matrix.blocks[k], &matrix.blocks[self.pattern.mirror(k)]);
                    let first = if other == node { axis } else { 0 };
                    for a in first..D {
                        let row = D * other + a;
                        let mean = 0.5 * (lower[(a, axis)] + upper[(axis, a)]);
                        let mut value = mean * self.scale[row] * self.scale[column];
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
        let lower = self.plan.lower();
        let done = self.plan.symbolic.factorize_numeric_llt(
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
        let lower = self.plan.lower();
        let done = self.plan.symbolic.factorize_numeric_ldlt(
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

    /// Negative entries of `D`.
    fn negative_signs(&self) -> Option<usize> {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.plan.symbolic.raw() else {
            return None;
        };
        let factor = SupernodalLdltRef::new(symbolic, &self.factor_values);
        let negative = |supernode: usize| {
            let block = factor.supernode(supernode).val();
            (0..block.ncols()).filter(|&k| block[(k, k)] < 0.0).count()
        };
        Some((0..symbolic.n_supernodes()).map(negative).sum())
    }

    /// Solves in place of the right side with the held factorisation of `matrix`.
    ///
    /// The residual is refined where that helps; with a factor of the symmetric part alone GMRES takes it
    /// for the preconditioner. Where that does not get there, the matrix is factorised by `L U` after all.
    ///
    /// # Errors
    /// [`LinearError::Singular`] if there is no factorisation or the residual of the solution is over
    /// 1e-6 of the right side (NaN included).
    pub fn solve(
        &mut self,
        matrix: &BlockMatrix<D>,
        right: &mut [f64],
    ) -> Result<Solved, LinearError> {
        if self.factor.is_none() {
            return Err(LinearError::Singular);
        }
        let wanted: Vec<f64> = right.iter().zip(&self.scale).map(|(r, s)| r * s).collect();
        let (mut x, mut solved) = self.solve_scaled(matrix, &wanted)?;
        if !(solved.residual <= SOLVED) && self.factor != Some(Factor::Lu) {
            self.factorise_unsymmetric(matrix)?;
            (x, solved) = self.solve_scaled(matrix, &wanted)?;
        }
        if !(solved.residual <= SOLVED) {
            return Err(LinearError::Singular);
        }
        for ((r, x), s) in right.iter_mut().zip(&x).zip(&self.scale) {
            *r = x * s;
        }
        Ok(solved)
    }

    fn solve_scaled(
        &self,
        matrix: &BlockMatrix<D>,
        wanted: &[f64],
    ) -> Result<(Vec<f64>, Solved), LinearError> {
        let mut operator = Scaled {
            matrix,
            scale: &self.scale,
            damping: self.damping,
        };
        let (mut x, mut solved) = self.refine(&mut operator, wanted)?;
        let of_symmetric_part = !self.symmetric && self.factor != Some(Factor::Lu);
        if of_symmetric_part && !(solved.residual <= REFINED) {
            let settings = KrylovSettings {
                tolerance: REFINED,
                max_iterations: MOST_PRODUCTS,
                restart: MOST_PRODUCTS,
            };
            let Ok(outcome) = gmres(&mut operator, self, wanted, &mut x, &settings);
            solved.residual = outcome.residual;
            solved.refinements += outcome.iterations;
        }
        Ok((x, solved))
    }

    /// Solves by the factor again and again, as long as it pays. Of a matrix that is nearly symmetric the factor of its
    /// symmetric part does in two solutions what takes GMRES three.
    fn refine(
        &self,
        operator: &mut Scaled<'_, D>,
        wanted: &[f64],
    ) -> Result<(Vec<f64>, Solved), LinearError> {
        let mut x = vec![0.0; wanted.len()];
        let size = norm(wanted);
        let mut solved = Solved {
            residual: 0.0,
            refinements: 0,
        };
        if size == 0.0 {
            return Ok((x, solved));
        }
        solved.residual = 1.0;
        let mut rest = wanted.to_vec();
        let mut refined = x.clone();
        for refinements in 0..=REFINEMENTS {
            self.back_substitute(&mut rest)?;
            refined.iter_mut().zip(&rest).for_each(|(x, c)| *x += c);
            operator.product(&refined, &mut rest);
            rest.iter_mut().zip(wanted).for_each(|(r, b)| *r = b - *r);
            let residual = norm(&rest) / size;
            if !(residual < solved.residual) {
                break;
            }
            let pays = self.symmetric || residual < PAYS * solved.residual;
            x.clone_from(&refined);
            solved = Solved {
                residual,
                refinements,
            };
            if residual <= REFINED || !pays {
                break;
            }
        }
        Ok((x, solved))
    }

    fn back_substitute(&self, x: &mut [f64]) -> Result<(), LinearError> {
        let rows = x.len();
        let column = MatMut::from_column_major_slice_mut(x, rows, 1);
        let request = self
            .plan
            .symbolic
            .solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut memory = MemBuffer::try_new(request).map_err(|_| LinearError::Memory)?;
        let stack = MemStack::new(&mut memory);
        match (self.factor, &self.unsymmetric) {
            (Some(Factor::Cholesky), _) => LltRef::new(&self.plan.symbolic, &self.factor_values)
                .solve_in_place_with_conj(Conj::No, column, Par::Seq, stack),
            (Some(Factor::SignedCholesky), _) => LdltRef::new(
                &self.plan.symbolic,
                &self.factor_values,
            )
            .solve_in_place_with_conj(Conj::No, column, Par::Seq, stack),
            (Some(Factor::Lu), Some(lu)) => {
                let columns = self.plan.permutation();
                lu.back_substitute(columns, column)?;
            }
            _ => return Err(LinearError::Singular),
        }
        Ok(())
    }
}

impl<const D: usize> Preconditioner for Direct<D> {
    fn apply(&self, r: &[f64], z: &mut [f64]) {
        z.copy_from_slice(r);
        if self.back_substitute(z).is_err() {
            z.fill(f64::NAN);
        }
    }
}

/// The scaled and damped matrix.
struct Scaled<'a, const D: usize> {
    matrix: &'a BlockMatrix<D>,
    scale: &'a [f64],
    damping: f64,
}

impl<const D: usize> Scaled<'_, D> {
    fn product(&self, x: &[f64], y: &mut [f64]) {
        let scaled: Vec<f64> = x.iter().zip(self.scale).map(|(x, s)| x * s).collect();
        self.matrix.multiply(&scaled, y);
        for ((y, x), s) in y.iter_mut().zip(x).zip(self.scale) {
            *y = *y * s + self.damping * x;
        }
    }
}

impl<const D: usize> Operator for Scaled<'_, D> {
    type Error = std::convert::Infallible;

    fn size(&self) -> usize {
        self.matrix.size()
    }

    fn apply(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Self::Error> {
        self.product(x, y);
        Ok(())
    }
}
