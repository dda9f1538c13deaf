//! Partition of unity, linear completeness, gradients, reach: what every shape function owes.

mod support;

use fissure_grid::{Grid, Shape, Window};
use nalgebra::{SMatrix, SVector};
use support::{deformation, nodes, spread};

const H: f64 = 0.05;

fn unit_grid<const D: usize>() -> Grid<D> {
    Grid::over([0.0; D], [1.0; D], H).expect("grid")
}

fn seeded<const D: usize>() -> SMatrix<f64, D, D> {
    SMatrix::from_diagonal_element(0.25 * H)
}

/// Particles all over the box, its faces and corners included, with deformed domains.
fn particles<const D: usize>(shape: &impl Shape<D>) -> Vec<(SVector<f64, D>, SMatrix<f64, D, D>)> {
    let corners = (0..1 << D).map(|c| SVector::from_fn(|axis, _| f64::from(c >> axis & 1)));
    let faces = spread(20).enumerate().map(|(k, mut x)| {
        x[k % D] = H * (k as f64);
        x
    });
    corners
        .chain(faces)
        .chain(spread(400))
        .enumerate()
        .map(|(k, x)| (x, shape.domain(&seeded(), &deformation(k, 0.3))))
        .collect()
}

fn is_complete<const D: usize, S: Shape<D>>(shape: S) {
    let grid = unit_grid::<D>();
    for (x, domain) in particles(&shape) {
        let nodes = nodes(&shape, &grid, &x, &domain).expect("inside");
        let mut unity = 0.0;
        let mut flat = SVector::<f64, D>::zeros();
        let mut position = SVector::<f64, D>::zeros();
        let mut identity = SMatrix::<f64, D, D>::zeros();
        for (index, (value, gradient)) in nodes {
            assert!(value >= -1e-15, "{} {value}", shape.name());
            unity += value;
            flat += gradient;
            position += value * grid.node(index);
            // Relative to the particle, as it should not matter and rounds less.
            identity += (grid.node(index) - x) * gradient.transpose();
        }
        let name = shape.name();
        assert!(
            (unity - 1.0).abs() <= 1e-13,
            "{name} at {x}: sum of N {unity}"
        );
        assert!(
            flat.amax() <= 1e-13 / H,
            "{name} at {x}: sum of gradients {flat}"
        );
        assert!(
            (position - x).amax() <= 1e-13,
            "{name} at {x}: linear field {position}"
        );
        assert!(
            (identity - SMatrix::identity()).amax() <= 1e-13,
            "{name} at {x}: gradient of linear field {identity}"
        );
    }
}

#[test]
fn linear_fields_are_exact() {
    each_shape!(is_complete);
}

fn differentiates<const D: usize, S: Shape<D>>(shape: S) {
    let grid = unit_grid::<D>();
    let step = 1e-6 * H;
    for x in spread::<D>(300).map(|x| x.map(|c| 0.1 + 0.8 * c)) {
        let here = nodes(&shape, &grid, &x, &seeded()).expect("inside");
        for axis in 0..D {
            let moved = |by: f64| {
                let mut x = x;
                x[axis] += by;
                nodes(&shape, &grid, &x, &seeded()).expect("inside")
            };
            let (forward, back) = (moved(step), moved(-step));
            for (index, (_, gradient)) in &here {
                let value = |nodes: &support::Nodes<D>| nodes.get(index).map_or(0.0, |node| node.0);
                let slope = (value(&forward) - value(&back)) / (2.0 * step);
                assert!(
                    (slope - gradient[axis]).abs() <= 1e-5 / H,
                    "{} at {x}",
                    shape.name()
                );
            }
        }
    }
}

/// CPDI is left out: its gradient is the average over the domain, not the derivative of N.
#[test]
fn gradients_are_derivatives() {
    each_shape!(differentiates: Linear, Gimp, Bspline2, Bspline3);
}

fn reaches<const D: usize, S: Shape<D>>(shape: S) {
    let grid = unit_grid::<D>();
    let large = shape.domain(&seeded(), &SMatrix::from_diagonal_element(9.0));
    let (mut below, mut above) = (0, 0);
    for domain in [seeded(), large] {
        for x in spread::<D>(2000) {
            let cell = grid.cell(&x).expect("inside");
            for (index, (value, gradient)) in nodes(&shape, &grid, &x, &domain).expect("inside") {
                if value != 0.0 || gradient.amax() != 0.0 {
                    for axis in 0..D {
                        below = below.max(cell[axis] - index[axis]);
                        above = above.max(index[axis] - cell[axis]);
                    }
                }
            }
        }
    }
    assert_eq!((below, above), shape.reach(), "{}", shape.name());
}

#[test]
fn reach_is_as_declared() {
    each_shape!(reaches);
}

fn fits_the_window<const D: usize, S: Shape<D>>(shape: S) {
    let grid = unit_grid::<D>();
    let domain = shape.domain(&seeded(), &SMatrix::identity());
    let stencil = |tile: [i32; D], x: &SVector<f64, D>| {
        shape.stencil(&grid, &Window::of_tile(tile, 4), x, &domain)
    };
    // Centres of cells and points of theirs far to one side: all particles of a tile are served.
    for cell in 8..12 {
        for t in [0.0, 1e-12, 0.49, 0.5, 0.51, 0.99] {
            let x = SVector::from_element((f64::from(cell) + t) * H);
            assert!(stencil([2; D], &x).is_some(), "{} {cell} {t}", shape.name());
        }
    }
    // Two cells below and one above still are for linear functions; three and two are not for any.
    for (cell, served) in [(6, true), (5, false), (12, true), (13, false)] {
        let x = SVector::from_element((f64::from(cell) + 0.5) * H);
        let found = stencil([2; D], &x);
        assert!(found.is_none() || served);
        assert!(found.is_some() || !(served && shape.name() == "linear"));
    }
    for bad in [-1e-9, 1.0 + 1e-9, f64::NAN, f64::INFINITY] {
        let mut x = SVector::from_element(0.5);
        x[D - 1] = bad;
        for tile in [[2; D], [0; D], [i32::MIN; D], [i32::MAX; D]] {
            assert!(stencil(tile, &x).is_none());
        }
    }
    for far in [i32::MIN, i32::MAX] {
        assert!(stencil([far; D], &SVector::from_element(0.5)).is_none());
    }
}

#[test]
fn windows_hold_the_particles_of_their_tile_and_refuse_others() {
    each_shape!(fits_the_window);
}
