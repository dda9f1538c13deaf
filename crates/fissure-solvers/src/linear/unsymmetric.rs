//! `L U` with partial pivoting, columns eliminated in a given order.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::simplicial::EliminationTreeRef;
use faer::sparse::linalg::lu::supernodal::{
    SupernodalLu, SymbolicSupernodalLu, factorize_supernodal_numeric_lu,
    factorize_supernodal_numeric_lu_scratch, factorize_supernodal_symbolic_lu,
    factorize_supernodal_symbolic_lu_scratch, solve_in_place_scratch,
};
use faer::sparse::linalg::qr;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};

use super::LinearError;
use super::blocks::{BlockMatrix, BlockPattern};

pub(super) struct Unsymmetric<const D: usize> {
    pattern: BlockPattern,
    /// Entries by columns; since the pattern is symmetric, also by rows.
    starts: Vec<u32>,
    rows: Vec<u32>,
    by_columns: Vec<f64>,
    by_rows: Vec<f64>,
    symbolic: SymbolicSupernodalLu<u32>,
    numeric: SupernodalLu<u32, f64>,
    row_order: Vec<u32>,
    row_inverse: Vec<u32>,
    memory: MemBuffer,
}

impl<const D: usize> Unsymmetric<D> {
    pub(super) fn new(
        pattern: &BlockPattern,
        columns: PermRef<'_, u32>,
    ) -> Result<Self, LinearError> {
        let size = columns.len();
        let (mut starts, mut rows) = (vec![0_u32], Vec::new());
        for node in 0..pattern.nodes() {
            for _ in 0..D {
                for &other in pattern.neighbours(node) {
                    rows.extend((0..D as u32).map(|a| D as u32 * other + a));
                }
                starts.push(rows.len() as u32);
            }
        }
        let whole = SymbolicSparseColMatRef::new_checked(size, size, &starts, None, &rows);
        let request = StackReq::any_of(&[
            qr::col_etree_scratch::<u32>(size, size),
            qr::postorder_scratch::<u32>(size),
            qr::column_counts_aat_scratch::<u32>(size, size),
            factorize_supernodal_symbolic_lu_scratch::<u32>(size, size),
        ]);
        let mut memory = MemBuffer::try_new(request).map_err(|_| LinearError::Memory)?;
        let stack = MemStack::new(&mut memory);
        let (mut tree, mut post) = (vec![0_u32; size], vec![0_u32; size]);
        let (mut counts, mut first) = (vec![0_u32; size], vec![0_u32; size]);
        let tree: EliminationTreeRef<'_, u32> =
            qr::col_etree(whole, Some(columns), &mut tree, stack);
        qr::postorder(&mut post, tree, stack);
        // The transposed pattern is the pattern.
        qr::column_counts_ata(
            &mut counts,
            &mut first,
            whole,
            Some(columns),
            tree,
            &post,
            stack,
        );
        let symbolic = factorize_supernodal_symbolic_lu(
            whole,
            Some(columns),
            &first,
            tree,
            &counts,
            stack,
            Default::default(),
        )
        .map_err(|_| LinearError::Memory)?;
        let request =
            factorize_supernodal_numeric_lu_scratch::<u32, f64>(&symbolic, Default::default());
        Ok(Self {
            pattern: pattern.clone(),
            by_columns: vec![0.0; rows.len()],
            by_rows: vec![0.0; rows.len()],
            starts,
            rows,
            symbolic,
            numeric: SupernodalLu::new(),
            row_order: vec![0; size],
            row_inverse: vec![0; size],
            memory: MemBuffer::try_new(request).map_err(|_| LinearError::Memory)?,
        })
    }

    pub(super) fn factorise(
        &mut self,
        matrix: &BlockMatrix<D>,
        scale: &[f64],
        damping: f64,
        columns: PermRef<'_, u32>,
    ) -> Result<(), LinearError> {
        let mut next = 0;
        for node in 0..self.pattern.nodes() {
            for axis in 0..D {
                let own = D * node + axis;
                for k in self.pattern.row(node) {
                    let (row, column) = (&matrix.blocks[k], &matrix.blocks[self.pattern.mirror(k)]);
                    for a in 0..D {
                        let other = D * self.pattern.column(k) + a;
                        let factor = scale[own] * scale[other];
                        let damping = if own == other { damping } else { 0.0 };
                        self.by_rows[next] = row[(axis, a)] * factor + damping;
                        self.by_columns[next] = column[(a, axis)] * factor + damping;
                        next += 1;
                    }
                }
            }
        }
        let size = scale.len();
        let whole =
            SymbolicSparseColMatRef::new_checked(size, size, &self.starts, None, &self.rows);
        factorize_supernodal_numeric_lu(
            &mut self.row_order,
            &mut self.row_inverse,
            &mut self.numeric,
            SparseColMatRef::new(whole, &self.by_columns),
            SparseColMatRef::new(whole, &self.by_rows),
            columns,
            &self.symbolic,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        )
        .map_err(|_| LinearError::Singular)
    }

    pub(super) fn back_substitute(
        &self,
        columns: PermRef<'_, u32>,
        right: MatMut<'_, f64>,
    ) -> Result<(), LinearError> {
        let size = self.row_order.len();
        let request = solve_in_place_scratch::<u32, f64>(size, 1, Par::Seq);
        let mut memory = MemBuffer::try_new(request).map_err(|_| LinearError::Memory)?;
        self.numeric.solve_in_place_with_conj(
            PermRef::new_checked(&self.row_order, &self.row_inverse, size),
            columns,
            Conj::No,
            right,
            Par::Seq,
            MemStack::new(&mut memory),
        );
        Ok(())
    }
}
