//! Direct solution of the sparse systems, with the symbolic work reused while the pattern stands.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::lu::{NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par};

/// A fixed pattern of entries, summed where they coincide.
pub(crate) struct SparseSystem {
    size: usize,
    pattern: SymbolicSparseColMat<usize>,
    order: Argsort<usize>,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
}

/// The system has no usable solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Singular;

impl SparseSystem {
    /// Analyses the pattern given by `(row, column)` pairs; every diagonal entry is added.
    pub(crate) fn new(
        size: usize,
        entries: impl Iterator<Item = (u32, u32)>,
    ) -> Result<Self, Singular> {
        let pair = |(row, col): (u32, u32)| Pair {
            row: row as usize,
            col: col as usize,
        };
        let diagonal = (0..size as u32).map(|i| (i, i));
        let pairs: Vec<Pair<usize, usize>> = entries.chain(diagonal).map(pair).collect();
        let (pattern, order) =
            SymbolicSparseColMat::try_new_from_indices(size, size, &pairs).map_err(|_| Singular)?;
        let symbolic =
            factorize_symbolic_lu(pattern.as_ref(), Default::default()).map_err(|_| Singular)?;
        Ok(Self {
            size,
            pattern,
            order,
            symbolic,
            numeric: NumericLu::new(),
        })
    }

    /// Solves the system whose entries have these values (in the order of the pairs) in place of
    /// the right side.
    ///
    /// One thread, whatever the pool: a parallel factorisation would change the last bits.
    pub(crate) fn solve(
        &mut self,
        mut values: Vec<f64>,
        damping: f64,
        right: &mut [f64],
    ) -> Result<(), Singular> {
        values.resize(values.len() + self.size, 0.0);
        let assembled = SparseColMat::new_from_argsort(self.pattern.clone(), &self.order, &values);
        let mut matrix = assembled.map_err(|_| Singular)?;
        let scale = self.scale(&mut matrix, damping);
        let scaled: Vec<f64> = right.iter().zip(&scale).map(|(r, s)| r * s).collect();
        let mut x = scaled.clone();
        let par = Par::Seq;
        let request = self
            .symbolic
            .factorize_numeric_lu_scratch::<f64>(par, Default::default());
        let mut memory = MemBuffer::try_new(request).map_err(|_| Singular)?;
        let lu = self
            .symbolic
            .factorize_numeric_lu(
                &mut self.numeric,
                matrix.as_ref(),
                par,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|_| Singular)?;
        let request = self.symbolic.solve_in_place_scratch::<f64>(1, par);
        let mut memory = MemBuffer::try_new(request).map_err(|_| Singular)?;
        let rows = x.len();
        let column = MatMut::from_column_major_slice_mut(&mut x, rows, 1);
        lu.solve_in_place_with_conj(Conj::No, column, par, MemStack::new(&mut memory));
        if !(residual(&matrix, &x, &scaled) <= 1e-6) {
            return Err(Singular);
        }
        for ((r, x), s) in right.iter_mut().zip(&x).zip(&scale) {
            *r = x * s;
        }
        Ok(())
    }

    /// Scales the matrix symmetrically to a diagonal of 1 plus `damping`; returns the factors.
    fn scale(&self, matrix: &mut SparseColMat<usize, f64>, damping: f64) -> Vec<f64> {
        let mut scale = vec![1.0; self.size];
        let (pattern, values) = matrix.parts_mut();
        let (starts, rows) = (pattern.col_ptr(), pattern.row_idx());
        for column in 0..self.size {
            for k in starts[column]..starts[column + 1] {
                if rows[k] == column && values[k] != 0.0 {
                    scale[column] = values[k].abs().sqrt().recip();
                }
            }
        }
        for column in 0..self.size {
            for k in starts[column]..starts[column + 1] {
                values[k] *= scale[rows[k]] * scale[column];
                if rows[k] == column {
                    values[k] += damping;
                }
            }
        }
        scale
    }
}

/// `|A x − b| / |b|` in the Euclidean norm; NaN if anything is.
fn residual(matrix: &SparseColMat<usize, f64>, x: &[f64], b: &[f64]) -> f64 {
    let mut rest: Vec<f64> = b.to_vec();
    let (starts, rows, values) = (matrix.col_ptr(), matrix.row_idx(), matrix.val());
    for (column, x) in x.iter().enumerate() {
        for k in starts[column]..starts[column + 1] {
            rest[rows[k]] -= values[k] * x;
        }
    }
    let norm = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let size = norm(b);
    if size == 0.0 {
        norm(&rest)
    } else {
        norm(&rest) / size
    }
}
