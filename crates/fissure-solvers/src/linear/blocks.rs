//! Sparse matrices of `D×D` blocks, a row and a column of blocks per node.

use nalgebra::{SMatrix, SVector};

use super::krylov::Operator;

/// Which pairs of nodes have a block: with `(i, j)` also `(j, i)`, and every `(i, i)`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BlockPattern {
    starts: Vec<u32>,
    columns: Vec<u32>,
    /// Where the transposed block stands.
    mirror: Vec<u32>,
    /// Where the diagonal blocks stand.
    diagonal: Vec<u32>,
}

impl BlockPattern {
    /// Couples the nodes of every element with one another; `elements` lists node numbers below
    /// `nodes`, element by element.
    pub fn of_elements<'a>(
        nodes: usize,
        elements: impl Iterator<Item = &'a [u32]> + Clone,
    ) -> Self {
        // The elements around every node, by counting.
        let mut starts = vec![0_u32; nodes + 1];
        for &node in elements.clone().flatten() {
            starts[node as usize + 1] += 1;
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let listed: Vec<&[u32]> = elements.collect();
        let mut around = vec![0_u32; starts[nodes] as usize];
        let mut next = starts.clone();
        for (element, members) in listed.iter().enumerate() {
            for &node in *members {
                around[next[node as usize] as usize] = element as u32;
                next[node as usize] += 1;
            }
        }
        let mut pattern = Self {
            starts: vec![0],
            ..Self::default()
        };
        let mut seen = vec![u32::MAX; nodes];
        for node in 0..nodes as u32 {
            let first = pattern.columns.len();
            seen[node as usize] = node;
            pattern.columns.push(node);
            let (start, end) = (starts[node as usize], starts[node as usize + 1]);
            for &element in &around[start as usize..end as usize] {
                for &other in listed[element as usize] {
                    if std::mem::replace(&mut seen[other as usize], node) != node {
                        pattern.columns.push(other);
                    }
                }
            }
            pattern.columns[first..].sort_unstable();
            pattern.starts.push(pattern.columns.len() as u32);
        }
        pattern.find_mirrors();
        pattern
    }

    fn find_mirrors(&mut self) {
        let nodes = self.nodes();
        self.mirror = vec![0; self.columns.len()];
        self.diagonal = vec![0; nodes];
        // Rows are gone through in order, so the entries of a column turn up in its order too.
        let mut next: Vec<u32> = self.starts[..nodes].to_vec();
        for row in 0..nodes {
            for k in self.row(row) {
                let column = self.columns[k] as usize;
                self.mirror[k] = next[column];
                next[column] += 1;
                if column == row {
                    self.diagonal[row] = k as u32;
                }
            }
        }
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Number of blocks.
    pub fn len(&self) -> usize {
        self.columns.len()
    }

    /// Whether there is no block.
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// Places of the blocks of a row.
    #[inline]
    pub fn row(&self, node: usize) -> std::ops::Range<usize> {
        self.starts[node] as usize..self.starts[node + 1] as usize
    }

    /// Nodes of the columns in which a row has blocks, ascending.
    #[inline]
    pub fn neighbours(&self, node: usize) -> &[u32] {
        &self.columns[self.row(node)]
    }

    /// The node of a block's column, by the block's place.
    #[inline]
    pub fn column(&self, place: usize) -> usize {
        self.columns[place] as usize
    }

    /// Place of the block `(j, i)` of the block `(i, j)` at a place.
    #[inline]
    pub fn mirror(&self, place: usize) -> usize {
        self.mirror[place] as usize
    }

    /// Place of a node's diagonal block.
    #[inline]
    pub fn diagonal(&self, node: usize) -> usize {
        self.diagonal[node] as usize
    }

    /// Place of the block of a row and a column, if there is one.
    pub fn place(&self, row: usize, column: usize) -> Option<usize> {
        let found = self.neighbours(row).binary_search(&(column as u32)).ok()?;
        Some(self.starts[row] as usize + found)
    }
}

/// A matrix of `D×D` blocks on a [`BlockPattern`]; unknown `D·i + a` is component `a` of node `i`.
#[derive(Clone, Debug, Default)]
pub struct BlockMatrix<const D: usize> {
    pattern: BlockPattern,
    /// The blocks, row by row.
    pub blocks: Vec<SMatrix<f64, D, D>>,
}

impl<const D: usize> BlockMatrix<D> {
    /// Zero on a pattern.
    pub fn zeros(pattern: BlockPattern) -> Self {
        let blocks = vec![SMatrix::zeros(); pattern.len()];
        Self { pattern, blocks }
    }

    /// Where its blocks are.
    pub fn pattern(&self) -> &BlockPattern {
        &self.pattern
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        D * self.pattern.nodes()
    }

    /// Sets every block to zero.
    pub fn clear(&mut self) {
        self.blocks.fill(SMatrix::zeros());
    }

    /// Adds a number to the diagonal of a node's block.
    pub fn add_to_diagonal(&mut self, node: usize, number: f64) {
        let block = &mut self.blocks[self.pattern.diagonal(node)];
        for axis in 0..D {
            block[(axis, axis)] += number;
        }
    }

    /// The product with a field, node by node.
    pub fn times(&self, x: &[SVector<f64, D>]) -> Vec<SVector<f64, D>> {
        let row = |node| {
            let mut sum = SVector::zeros();
            for k in self.pattern.row(node) {
                sum += self.blocks[k] * x[self.pattern.column(k)];
            }
            sum
        };
        (0..self.pattern.nodes()).map(row).collect()
    }

    /// Turns a node's components into those along orthonormal `directions` (as columns) and takes
    /// the first `held` of them out: their rows and columns become those of the unit matrix.
    pub fn hold(&mut self, node: usize, directions: &SMatrix<f64, D, D>, held: usize) {
        for k in self.pattern.row(node) {
            let mirror = self.pattern.mirror(k);
            self.blocks[k] = directions.tr_mul(&self.blocks[k]);
            for axis in 0..held {
                self.blocks[k].row_mut(axis).fill(0.0);
            }
            self.blocks[mirror] *= directions;
            for axis in 0..held {
                self.blocks[mirror].column_mut(axis).fill(0.0);
            }
        }
        let diagonal = &mut self.blocks[self.pattern.diagonal(node)];
        for axis in 0..held {
            diagonal[(axis, axis)] = 1.0;
        }
    }

    /// Factors `1/√|a_ii|` that scale the diagonal to ±1; 1 where it is zero.
    pub fn unit_scale(&self) -> Vec<f64> {
        let mut scale = Vec::with_capacity(self.size());
        for node in 0..self.pattern.nodes() {
            let block = &self.blocks[self.pattern.diagonal(node)];
            for axis in 0..D {
                let size = block[(axis, axis)].abs();
                scale.push(if size > 0.0 { size.sqrt().recip() } else { 1.0 });
            }
        }
        scale
    }

    /// Largest difference of an entry and its mirror image, when both are scaled by `scale` on
    /// either side; NaN if any entry is.
    pub fn asymmetry(&self, scale: &[f64]) -> f64 {
        let mut largest: f64 = 0.0;
        for row in 0..self.pattern.nodes() {
            for k in self.pattern.row(row) {
                let column = self.pattern.column(k);
                if column > row {
                    continue;
                }
                let (block, other) = (&self.blocks[k], &self.blocks[self.pattern.mirror(k)]);
                for a in 0..D {
                    for b in 0..D {
                        let difference = (block[(a, b)] - other[(b, a)]).abs();
                        let scaled = difference * scale[D * row + a] * scale[D * column + b];
                        if scaled.is_nan() {
                            return f64::NAN;
                        }
                        largest = largest.max(scaled);
                    }
                }
            }
        }
        largest
    }
}

impl<const D: usize> Operator for BlockMatrix<D> {
    type Error = std::convert::Infallible;

    fn size(&self) -> usize {
        BlockMatrix::size(self)
    }

    fn apply(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Self::Error> {
        self.multiply(x, y);
        Ok(())
    }
}

impl<const D: usize> BlockMatrix<D> {
    /// `y = A x`.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        for (node, y) in y.chunks_exact_mut(D).enumerate() {
            let mut sum = SVector::<f64, D>::zeros();
            for k in self.pattern.row(node) {
                let column = D * self.pattern.column(k);
                let x = SVector::<f64, D>::from_column_slice(&x[column..column + D]);
                sum += self.blocks[k] * x;
            }
            y.copy_from_slice(sum.as_slice());
        }
    }
}
