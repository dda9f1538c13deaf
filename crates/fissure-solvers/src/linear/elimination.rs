//! In which order unknowns are eliminated, and where the entries of the factor are then.

use faer::perm::PermRef;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};

use super::LinearError;
use super::blocks::BlockPattern;
use super::dissection::nested_dissection;

/// In which order unknowns are eliminated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Elimination {
    /// The halves of the body first, then what separates them, and so on within each, by where nodes are
    /// ([`nested_dissection`]).
    #[default]
    NestedDissection,
    /// The unknown with the fewest neighbours left first (faer's approximate minimum degree): knows no positions, and fills in
    /// more.
    MinimumDegree,
}

/// What of a factorisation depends on the pattern alone.
pub(super) struct Plan {
    /// Order of elimination of the unknowns, and its inverse.
    pub order: Vec<u32>,
    inverse: Vec<u32>,
    /// The lower triangle by columns.
    starts: Vec<u32>,
    pub rows: Vec<u32>,
    pub symbolic: SymbolicCholesky<u32>,
}

impl Plan {
    pub(super) fn new<const D: usize>(
        pattern: &BlockPattern,
        positions: &[[f64; D]],
        elimination: Elimination,
    ) -> Result<Self, LinearError> {
        let (starts, rows) = lower_triangle::<D>(pattern);
        let symbolic = match elimination {
            Elimination::NestedDissection => {
                let nodes = nested_dissection(pattern, positions);
                let components =
                    |&node: &u32| (0..D as u32).map(move |axis| D as u32 * node + axis);
                let order: Vec<u32> = nodes.iter().flat_map(components).collect();
                let mut inverse = vec![0; order.len()];
                for (place, &unknown) in order.iter().enumerate() {
                    inverse[unknown as usize] = place as u32;
                }
                let order = PermRef::new_checked(&order, &inverse, order.len());
                analysed(&starts, &rows, SymmetricOrdering::Custom(order))
            }
            Elimination::MinimumDegree => analysed(&starts, &rows, SymmetricOrdering::Amd),
        }?;
        let (order, inverse) = symbolic.perm().ok_or(LinearError::Memory)?.arrays();
        Ok(Self {
            order: order.to_vec(),
            inverse: inverse.to_vec(),
            starts,
            rows,
            symbolic,
        })
    }

    pub(super) fn permutation(&self) -> PermRef<'_, u32> {
        PermRef::new_checked(&self.order, &self.inverse, self.order.len())
    }

    /// The lower triangle.
    pub(super) fn lower(&self) -> SymbolicSparseColMatRef<'_, u32> {
        lower(&self.starts, &self.rows)
    }
}

fn lower<'a>(starts: &'a [u32], rows: &'a [u32]) -> SymbolicSparseColMatRef<'a, u32> {
    let size = starts.len() - 1;
    SymbolicSparseColMatRef::new_checked(size, size, starts, None, rows)
}

fn analysed(
    starts: &[u32],
    rows: &[u32],
    ordering: SymmetricOrdering<'_, u32>,
) -> Result<SymbolicCholesky<u32>, LinearError> {
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    let lower = lower(starts, rows);
    factorize_symbolic_cholesky(lower, faer::Side::Lower, ordering, params)
        .map_err(|_| LinearError::Memory)
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

#[cfg(test)]
mod tests {
    use super::super::Direct;
    use super::super::tests::elastic;
    use super::*;

    /// Either order gives the solution; separators fill in far less in space.
    #[test]
    fn orders_of_elimination() {
        let (matrix, positions) = elastic([12, 12, 12]);
        let mut entries = Vec::new();
        let mut solutions = Vec::new();
        for elimination in [Elimination::NestedDissection, Elimination::MinimumDegree] {
            let pattern = matrix.pattern();
            let mut direct = Direct::with_elimination(pattern, &positions, elimination).unwrap();
            direct.factorise(&matrix, 0.0).unwrap();
            let mut x = vec![1.0; matrix.size()];
            let solved = direct.solve(&matrix, &mut x).unwrap();
            assert!(solved.residual <= 1e-10, "{elimination:?}: {solved:?}");
            entries.push(direct.factor_entries() as f64);
            solutions.push(x);
        }
        let largest = solutions[0]
            .iter()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let pairs = solutions[0].iter().zip(&solutions[1]);
        let apart = pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        assert!(apart <= 1e-9 * largest, "{apart:e} {largest:e}");
        assert!(entries[1] >= 1.2 * entries[0], "{entries:?}");
    }
}
