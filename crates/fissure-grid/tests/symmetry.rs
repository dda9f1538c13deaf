//! Whole-cell translations give the same bits, quarter turns the same numbers.

mod support;

use fissure_grid::{Grid, Shape};
use nalgebra::{SMatrix, SVector};
use support::{deformation, nodes, spread};

const H: f64 = 1.0 / 16.0;

/// A box centred on zero whose width is a whole number of cells.
fn centred<const D: usize>() -> Grid<D> {
    Grid::over([-1.0; D], [1.0; D], H).expect("grid")
}

/// Rounded to a multiple of 2^-30, so that whole cells can be added exactly.
fn dyadic<const D: usize>(x: SVector<f64, D>) -> SVector<f64, D> {
    let unit = f64::from(1 << 30);
    x.map(|c| (c * unit).round() / unit)
}

fn domain_of<const D: usize>(shape: &impl Shape<D>, seed: usize) -> SMatrix<f64, D, D> {
    shape.domain(
        &SMatrix::from_diagonal_element(0.25 * H),
        &deformation(seed, 0.3),
    )
}

fn moves_by_cells<const D: usize, S: Shape<D>>(shape: S) {
    let grid = centred::<D>();
    for (k, x) in spread::<D>(200).enumerate() {
        let x = dyadic(x * 0.5);
        let domain = domain_of(&shape, k);
        let here = nodes(&shape, &grid, &x, &domain).expect("inside");
        for shift in [[1, 2, 3], [4, -5, 7], [-6, 0, -1]] {
            let by = SVector::<f64, D>::from_fn(|axis, _| f64::from(shift[axis]) * H);
            let there = nodes(&shape, &grid, &(x + by), &domain).expect("inside");
            let back: support::Nodes<D> = there
                .into_iter()
                .map(|(index, node)| (std::array::from_fn(|axis| index[axis] - shift[axis]), node))
                .collect();
            assert_eq!(back, here, "{} at {x}", shape.name());
        }
    }
}

#[test]
fn translation_by_cells_keeps_the_bits() {
    each_shape!(moves_by_cells);
}

fn moves_the_grid<const D: usize, S: Shape<D>>(shape: S) {
    let here = centred::<D>();
    let offset = SVector::<f64, D>::from_element(1024.25);
    let there = Grid::over([1023.25; D], [1025.25; D], H).expect("grid");
    for (k, x) in spread::<D>(100).enumerate() {
        let x = dyadic(x);
        let domain = domain_of(&shape, k);
        assert_eq!(
            nodes(&shape, &here, &x, &domain),
            nodes(&shape, &there, &(x + offset), &domain)
        );
    }
}

#[test]
fn moving_grid_and_particle_keeps_the_bits() {
    each_shape!(moves_the_grid);
}

/// Compares with the particle turned by an orthogonal matrix that maps the grid on itself.
fn turned<const D: usize>(shape: &impl Shape<D>, turn: SMatrix<f64, D, D>) {
    let grid = centred::<D>();
    let to_node = |p: SVector<f64, D>| -> [i32; D] {
        std::array::from_fn(|axis| ((p[axis] + 1.0) / H).round() as i32)
    };
    for (k, x) in spread::<D>(200).enumerate() {
        let x = x.map(|c| 1.8 * c - 0.9);
        let domain = domain_of(shape, k);
        let here = nodes(shape, &grid, &x, &domain).expect("inside");
        let there = nodes(shape, &grid, &(turn * x), &(turn * domain)).expect("inside");
        for (index, (value, gradient)) in here {
            let (value_there, gradient_there) = there
                .get(&to_node(turn * grid.node(index)))
                .copied()
                .unwrap_or((0.0, SVector::zeros()));
            assert!(
                (value_there - value).abs() <= 1e-14,
                "{} at {x}: {value_there} {value}",
                shape.name()
            );
            assert!(
                (gradient_there - turn * gradient).amax() <= 3e-14 / H,
                "{} at {x}",
                shape.name()
            );
        }
    }
}

fn turns<const D: usize, S: Shape<D>>(shape: S) {
    // A quarter turn in the plane of axes 0 and 1, and a cyclic exchange of axes (a turn about the diagonal).
    let mut quarter = SMatrix::<f64, D, D>::identity();
    quarter[(0, 0)] = 0.0;
    quarter[(1, 1)] = 0.0;
    quarter[(0, 1)] = -1.0;
    quarter[(1, 0)] = 1.0;
    let cycle = SMatrix::<f64, D, D>::from_fn(|i, j| if i == (j + 1) % D { 1.0 } else { 0.0 });
    turned(&shape, quarter);
    turned(&shape, cycle);
    turned(&shape, -SMatrix::identity());
}

#[test]
fn quarter_turns_and_mirrors_turn_the_weights() {
    each_shape!(turns);
}
