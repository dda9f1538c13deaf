//! What the tests of shapes share: a stencil written out by node, and a list of shapes to run through.
#![allow(dead_code)] // each test binary uses a part

use std::collections::BTreeMap;

use fissure_grid::{Grid, Shape, Stencil, Window, tile_of};
use nalgebra::{SMatrix, SVector};

/// Weight and gradient of each node, by its grid index.
pub type Nodes<const D: usize> = BTreeMap<[i32; D], (f64, SVector<f64, D>)>;

/// The stencil of a particle in the tile of its cell, repeated visits added up.
pub fn nodes<const D: usize>(
    shape: &impl Shape<D>,
    grid: &Grid<D>,
    x: &SVector<f64, D>,
    domain: &SMatrix<f64, D, D>,
) -> Option<Nodes<D>> {
    let window = Window::of_tile(tile_of(grid.cell(x)?, 4), 4);
    let stencil = shape.stencil(grid, &window, x, domain)?;
    let mut nodes = Nodes::new();
    let mut values = Vec::new();
    stencil.visit(|entry, value, gradient| {
        assert!(window.entries().any(|other| other == entry));
        let node = nodes
            .entry(window.node(entry))
            .or_insert((0.0, SVector::zeros()));
        node.0 += value;
        node.1 += gradient;
        values.push((entry, value));
    });
    let mut alone = Vec::new();
    stencil.visit_values(|entry, value| alone.push((entry, value)));
    assert_eq!(alone, values);
    Some(nodes)
}

/// Repeats a generic check for each shape in 2-D and 3-D: `each_shape!(check)` calls `check::<D, _>(shape)`.
#[macro_export]
macro_rules! each_shape {
    ($check:ident) => {
        $crate::each_shape!($check: Linear, Gimp, Cpdi, Bspline2, Bspline3)
    };
    ($check:ident: $($shape:ident),*) => {
        $(
            $check::<2, _>(fissure_grid::shape::$shape);
            $check::<3, _>(fissure_grid::shape::$shape);
        )*
    };
}

/// Points spread evenly over the unit box, none on a face: multiples of irrational numbers.
pub fn spread<const D: usize>(count: usize) -> impl Iterator<Item = SVector<f64, D>> {
    let steps = [
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_2,
        0.549_700_477_901_970_3,
    ];
    (1..=count).map(move |k| SVector::from_fn(|axis, _| (0.5 + k as f64 * steps[axis]).fract()))
}

/// A deformation gradient well away from singular: 1 plus up to `size` in each entry.
pub fn deformation<const D: usize>(seed: usize, size: f64) -> SMatrix<f64, D, D> {
    SMatrix::identity()
        + SMatrix::from_fn(|i, j| {
            size * (2.0 * (0.324_717_957 * (1 + seed * 9 + 3 * i + j) as f64).fract() - 1.0)
        })
}
